//! Readings one by one and in pairs, and what is left under each.

use std::f64::consts::PI;

use abbe::{Pose, VariableKind};
use abbe_spec::diagnostic::Diagnostics;

use super::change::Change;
use super::columns::Columns;
use super::kinematics::{Kinematics, Parts};
use super::reading::{Layout, Reading};
use super::registration::registered;
use super::residual::{Residual, squares};
use super::sets;
use super::zeros::{Form, least};
use crate::{Notes, mistake};

/// The lever of angles, as a share of the spread of the positions.
const LEVER: f64 = 0.3;

/// A residual beyond this share of the spread of the positions is no fit, if nobody says otherwise, and beyond that never.
pub(super) const WITHIN: f64 = 0.02;
const MOST: f64 = 0.1;

/// What leaves so many times what may be left is kept.
const NEAR: f64 = 2.0;

/// Of readings that do not fit, so many are kept.
const KEPT: usize = 30;

/// A reading and what is left under it.
#[derive(Clone, Debug)]
pub(super) struct Candidate {
    pub(super) reading: Reading,
    pub(super) residual: Residual,
    /// The poses that the spec has then.
    pub(super) predicted: Vec<Pose>,
    /// The tool as the one of the spec sees it, if it is fitted.
    pub(super) tool: Option<Pose>,
    /// How far the positions spread that were seen.
    pub(super) spread: f64,
}

impl Candidate {
    /// What is left, as a share of what may be left: units that make everything small are no better for it.
    pub(super) fn share(&self, within: Option<f64>) -> f64 {
        self.residual.both / limit(within, self.spread)
    }

    /// Whether it leaves as little as is asked for, and no more of the angles.
    pub(super) fn fits(&self, within: Option<f64>) -> bool {
        self.share(within) <= 1.0
    }
}

/// What may be left: as is asked for, and a small share of what was seen in any case.
pub(super) fn limit(within: Option<f64>, spread: f64) -> f64 {
    within.map_or(WITHIN * spread, |within| within.min(MOST * spread))
}

/// What was seen, in one way to read it.
struct Seen {
    layout: Layout,
    unit: &'static str,
    poses: Vec<Pose>,
    spread: f64,
}

/// Units of joints: what makes angles and travels coherent.
#[derive(Clone, Copy)]
struct Units {
    degrees: bool,
    slides: &'static str,
    factors: [f64; 2],
}

/// All that readings are tried on.
pub(super) struct Search<'a> {
    kinematics: &'a Kinematics,
    columns: &'a Columns,
    seen: Vec<Seen>,
    units: Vec<Units>,
    within: Option<f64>,
}

const LENGTHS: [(&str, f64); 2] = [("mm", 1e-3), ("m", 1.0)];

impl<'a> Search<'a> {
    pub(super) fn new(
        kinematics: &'a Kinematics,
        columns: &'a Columns,
        layouts: &[Layout],
        within: Option<f64>,
    ) -> Self {
        let units = units(kinematics, columns);
        let mut seen = Vec::new();
        for (unit, metres) in LENGTHS {
            for layout in layouts {
                let pose = |row: &Vec<f64>| layout.pose(row, metres / kinematics.metres);
                if let Some(poses) = columns.pose.iter().map(pose).collect::<Option<Vec<Pose>>>() {
                    let spread = spread(&poses);
                    seen.push(Seen { layout: *layout, unit, poses, spread });
                }
            }
        }
        Self { kinematics, columns, seen, units, within }
    }

    /// All readings that fit, and the nearest of the others.
    pub(super) fn run(&self, notes: &mut dyn Notes) -> Result<Vec<Candidate>, Diagnostics> {
        let mut candidates = Vec::new();
        let (of_joints, of_ends) = (sets::of_joints(self.kinematics), sets::of_ends(self.kinematics));
        self.try_all(&of_joints, &of_ends, &mut candidates, notes)?;
        if !candidates.iter().any(|candidate| candidate.fits(self.within)) {
            let of_ends: Vec<Vec<Change>> = vec![
                Vec::new(),
                vec![Change::PoseInverted],
                vec![Change::BaseElsewhere, Change::ToolElsewhere],
            ];
            self.try_all(&sets::further(self.kinematics.kinds.len()), &of_ends, &mut candidates, notes)?;
        }
        Ok(candidates)
    }

    fn try_all(
        &self,
        of_joints: &[Vec<Change>],
        of_ends: &[Vec<Change>],
        candidates: &mut Vec<Candidate>,
        notes: &mut dyn Notes,
    ) -> Result<(), Diagnostics> {
        let mut cut = f64::INFINITY;
        for (done, joints) in of_joints.iter().enumerate() {
            notes.progress(done, of_joints.len());
            if notes.stop() {
                return Err(mistake::with_help("doctor", "it was stopped", "begin again"));
            }
            for units in &self.units {
                let Some(nodes) = self.nodes(*units, joints) else { continue };
                for ends in of_ends.iter().filter(|ends| sets::are_tried(joints, ends)) {
                    self.try_seen(*units, joints, ends, &nodes, cut, candidates);
                }
            }
            cut = self.keep(candidates);
        }
        notes.progress(of_joints.len(), of_joints.len());
        Ok(())
    }

    /// The parts of the chain at every node of the zeros that are free.
    fn nodes(&self, units: Units, joints: &[Change]) -> Option<Vec<Vec<Parts>>> {
        let mut offsets = vec![Vec::new()];
        for (joint, form) in self.zeros(joints) {
            let with = |before: &Vec<(usize, f64)>| {
                form.nodes().map(|node| [&before[..], &[(joint, node)]].concat()).to_vec()
            };
            offsets = offsets.iter().flat_map(with).collect();
        }
        offsets.iter().map(|offsets| self.parts(units, joints, offsets)).collect()
    }

    fn zeros(&self, joints: &[Change]) -> Vec<(usize, Form)> {
        let zero = |change: &Change| match change {
            Change::Zero { joint, .. } => Some(match self.kinematics.kinds[*joint] {
                VariableKind::Revolute => (*joint, Form::Circle),
                VariableKind::Prismatic => (*joint, Form::Line(0.1 / self.kinematics.metres)),
            }),
            _ => None,
        };
        joints.iter().filter_map(zero).collect()
    }

    /// Row by row; none where the chain has no finite value.
    fn parts(&self, units: Units, joints: &[Change], offsets: &[(usize, f64)]) -> Option<Vec<Parts>> {
        let other = joints.contains(&Change::Convention);
        let row = |columns: &Vec<f64>| {
            let mut q = sets::joints(columns, &self.kinematics.kinds, units.factors, joints);
            offsets.iter().for_each(|(joint, offset)| q[*joint] += offset);
            self.kinematics.parts(&q, other).ok()
        };
        self.columns.joints.iter().map(row).collect()
    }

    fn try_seen(
        &self,
        units: Units,
        joints: &[Change],
        ends: &[Change],
        nodes: &[Vec<Parts>],
        cut: f64,
        candidates: &mut Vec<Candidate>,
    ) {
        let predicted: Vec<Vec<Pose>> = nodes.iter().map(|rows| self.with_ends(rows, ends)).collect();
        let of_machine = predicted.first().map_or(0.0, |poses| spread(poses));
        let zeros = self.zeros(joints);
        let forms: Vec<Form> = zeros.iter().map(|(_, form)| *form).collect();
        let free = [Change::BaseElsewhere, Change::ToolElsewhere].map(|change| ends.contains(&change));
        let rows = self.columns.joints.len();
        for seen in &self.seen {
            let (oriented, lever) = (seen.layout.is_oriented(), LEVER * seen.spread);
            let numbers = self.columns.configurations * if oriented { 6 } else { 3 };
            let fitted = joints.iter().chain(ends).map(|change| change.fitted(oriented)).sum::<usize>();
            // So few numbers fit anything.
            if numbers < 2 * fitted {
                continue;
            }
            // A position alone has no base that is seen from it.
            if !oriented && ends.contains(&Change::PoseInverted) {
                continue;
            }
            let limit = limit(self.within, seen.spread);
            let both = |[positions, angles]: [f64; 2]| positions + lever * lever * angles;
            let (changed, predicted, tool) = if !zeros.is_empty() {
                let values: Vec<f64> =
                    predicted.iter().map(|poses| both(squares(poses, &seen.poses, oriented))).collect();
                let far = |sum: f64, times: f64| (sum.max(0.0) / rows as f64).sqrt() > times * limit;
                // Few turns tell whether more of them are worth it.
                if far(least(&forms, &values, 15).1, 20.0) {
                    continue;
                }
                let (offsets, sum) = least(&forms, &values, 2000);
                if far(sum, 3.0) {
                    continue;
                }
                let offsets: Vec<(usize, f64)> = zeros.iter().map(|(joint, _)| *joint).zip(offsets).collect();
                let Some(parts) = self.parts(units, joints, &offsets) else { continue };
                let changed = joints.iter().map(|change| match change {
                    Change::Zero { joint, .. } => {
                        let offset =
                            offsets.iter().find(|(of, _)| of == joint).map_or(0.0, |(_, offset)| *offset);
                        Change::Zero { joint: *joint, offset }
                    }
                    change => change.clone(),
                });
                (changed.collect::<Vec<_>>(), self.with_ends(&parts, ends), None)
            } else if free.contains(&true) {
                if !can_be_fitted(&predicted[0], &seen.poses, oriented, free[1], limit) {
                    continue;
                }
                let Some((moved, tool)) = registered(&predicted[0], &seen.poses, oriented, lever, free)
                else {
                    continue;
                };
                (joints.to_vec(), moved, free[1].then_some(tool))
            } else {
                (joints.to_vec(), predicted[0].clone(), None)
            };
            let left = squares(&predicted, &seen.poses, oriented);
            let residual = Residual::new(left, rows, oriented, lever, [numbers, fitted]);
            let turns = self.kinematics.kinds.contains(&VariableKind::Revolute);
            let slides = self.kinematics.kinds.contains(&VariableKind::Prismatic);
            let reading = Reading {
                joints_in_degrees: turns.then_some(units.degrees),
                slides_in: slides.then_some(units.slides),
                lengths_in: seen.unit,
                layout: seen.layout,
                changes: [&changed[..], ends].concat(),
            };
            let candidate = Candidate { reading, residual, predicted, tool, spread: seen.spread };
            let share = candidate.share(self.within);
            // Nor is a unit that makes all that was seen far larger than the machine.
            let is_one = || share <= cut && residual.both <= 2.0 * of_machine;
            if share <= NEAR || is_one() {
                candidates.push(candidate);
            }
        }
    }

    /// Keeps those that may fit and the nearest of the others; what is farther than these is not needed.
    fn keep(&self, candidates: &mut Vec<Candidate>) -> f64 {
        let share = |candidate: &Candidate| candidate.share(self.within);
        candidates.sort_by(|a, b| share(a).total_cmp(&share(b)));
        let near = candidates.iter().take_while(|candidate| share(candidate) <= NEAR).count();
        candidates.truncate(near + KEPT);
        match candidates.len() {
            all if all == near + KEPT => candidates.last().map_or(f64::INFINITY, share),
            _ => f64::INFINITY,
        }
    }

    fn with_ends(&self, rows: &[Parts], ends: &[Change]) -> Vec<Pose> {
        let has = |change: Change| ends.contains(&change);
        let row = |[base, chain, tool]: &Parts| {
            let (mut base, mut tool) = match has(Change::EndsExchanged) {
                true => (*tool, *base),
                false => (*base, *tool),
            };
            if has(Change::BaseInverted) {
                base = base.inverse();
            }
            if has(Change::ToolInverted) {
                tool = tool.inverse();
            }
            if has(Change::BaseLeftOut) {
                base = Pose::IDENTITY;
            }
            if has(Change::ToolLeftOut) {
                tool = Pose::IDENTITY;
            }
            let pose = base.then(chain).then(&tool);
            if has(Change::PoseInverted) { pose.inverse() } else { pose }
        };
        rows.iter().map(row).collect()
    }
}

/// The root mean square distance of positions from their middle.
fn spread(poses: &[Pose]) -> f64 {
    let count = poses.len() as f64;
    let middle: [f64; 3] =
        std::array::from_fn(|i| poses.iter().map(|pose| pose.0[3][i]).sum::<f64>() / count);
    let square = |pose: &Pose| (0..3).map(|i| (pose.0[3][i] - middle[i]).powi(2)).sum::<f64>();
    (poses.iter().map(square).sum::<f64>() / count).sqrt()
}

/// Whether base or tool can be fitted: the angle of a turn between rows depends on neither, distances between positions not on
/// the base.
fn can_be_fitted(predicted: &[Pose], seen: &[Pose], oriented: bool, tool: bool, limit: f64) -> bool {
    let [mut turns, mut distances] = [0.0; 2];
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let trace = |a: &Pose, b: &Pose| dot(a.0[0], b.0[0]) + dot(a.0[1], b.0[1]) + dot(a.0[2], b.0[2]);
    let distance = |a: &Pose, b: &Pose| {
        let [a, b] = [a.0[3], b.0[3]];
        let off = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
        dot(off, off).sqrt()
    };
    for i in 1..seen.len() {
        let (a, b) = ([&predicted[i - 1], &predicted[i]], [&seen[i - 1], &seen[i]]);
        if oriented {
            turns += (trace(a[0], a[1]) - trace(b[0], b[1])).powi(2);
        }
        if !tool {
            distances += (distance(a[0], a[1]) - distance(b[0], b[1])).powi(2);
        }
    }
    let rows = seen.len() as f64;
    (turns / rows).sqrt() < 0.15 && (distances / rows).sqrt() < 4.0 * limit
}

/// Units that joints can be in: angles beyond two turns are no radians.
fn units(kinematics: &Kinematics, columns: &Columns) -> Vec<Units> {
    let has = |kind: VariableKind| kinematics.kinds.contains(&kind);
    let largest = columns.joints.iter().flatten().fold(0.0_f64, |most, value| most.max(value.abs()));
    let only_turns = !has(VariableKind::Prismatic);
    let angles: &[bool] = match has(VariableKind::Revolute) {
        true if only_turns && largest > 4.0 * PI => &[true],
        true => &[true, false],
        false => &[false],
    };
    let slides: &[(&str, f64)] = if only_turns { &LENGTHS[..1] } else { &LENGTHS };
    let mut all = Vec::new();
    for degrees in angles {
        for (unit, metres) in slides {
            let factors = [if *degrees { PI / 180.0 } else { 1.0 }, metres / kinematics.metres];
            all.push(Units { degrees: *degrees, slides: unit, factors });
        }
    }
    all
}
