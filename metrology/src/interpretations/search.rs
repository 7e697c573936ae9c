//! Evaluates interpretations and their residuals.

use abbe::{Error, Pose, VariableKind, analysis::sampling::norm};

use super::joints::{JointUnits, Length, configurations, joint_values};
use super::observed::{Observed, spread};
use super::pose_residual::{PoseResidual, squares};
use super::registration::registered;
use super::zeros::{ZeroForm, minimum};
use super::{Change, Interpretation};
use abbe_study::{Notes, Result, mistake};

/// Lever of angles, as a share of the spread of the positions.
const LEVER: f64 = 0.3;

/// Residual, as a share of the spread of the positions, above which nothing fits, whatever
/// tolerance is given.
pub(crate) const MOST: f64 = 0.1;

/// Ratio of the spread of the positions to that of the machine beyond which no base and no tool
/// explain them.
const UNLIKE: f64 = 8.0;

/// Residual, in tolerances, up to which interpretations are kept.
const NEAR: f64 = 2.0;

/// Number of interpretations kept beyond that.
const KEPT: usize = 30;

/// Base, chain and tool: the transform before all moving frames, the moving frames, and the tool.
pub(crate) type Parts = [Pose; 3];

/// Nominal manipulator as the search needs it.
pub(crate) trait Chain {
    /// Returns the kinds of the joints.
    fn kinds(&self) -> &[VariableKind];

    /// Returns the length unit in metres.
    fn metres(&self) -> f64;

    /// Evaluates base, chain and tool at `q`, with the other Denavit-Hartenberg convention if
    /// `other_convention` is set and there is one.
    fn parts(&self, q: &[f64], other_convention: bool) -> Result<Parts, Error>;
}

/// Interpretation and its residual.
#[derive(Clone, Debug)]
pub(crate) struct Candidate {
    pub(crate) interpretation: Interpretation,
    pub(crate) residual: PoseResidual,
    /// Poses predicted by the spec for this interpretation.
    pub(super) predicted: Vec<Pose>,
    /// Pose of `F_0` in the frame of the rows, if it is fitted.
    pub(crate) base: Option<Pose>,
    /// Pose of the fitted tool in the tool frame of the spec, if it is fitted.
    pub(crate) tool: Option<Pose>,
    /// Spread of the observed positions.
    pub(crate) spread: f64,
}

impl Candidate {
    /// Returns the residual as a share of the tolerance, which is invariant to the unit of the
    /// positions.
    pub(super) fn share(&self, tolerance: &Tolerance) -> f64 {
        self.residual.both / tolerance.limit(self.spread)
    }

    /// Returns true if positions and orientations are within the tolerance.
    pub(super) fn fits(&self, tolerance: &Tolerance) -> bool {
        self.share(tolerance) <= 1.0
    }
}

/// Largest residual of an interpretation that fits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tolerance {
    /// Largest residual in the length unit, if given.
    pub(crate) within: Option<f64>,
    /// Largest share of the spread of the positions otherwise.
    pub(crate) share: f64,
    /// Residual, as a share of the tolerance, at which no further stage is tried.
    pub(crate) enough: f64,
}

impl Tolerance {
    /// Returns the largest residual for positions with this spread.
    pub(crate) fn limit(&self, spread: f64) -> f64 {
        self.within.map_or(self.share * spread, |within| within.min(MOST * spread))
    }
}

/// Changes of the joints, with the changes of base, tool and poses to try with them.
pub(crate) struct Trial {
    pub(crate) joints: Vec<Change>,
    pub(crate) ends: Vec<Vec<Change>>,
}

/// Rows, and everything to try on them.
pub(crate) struct Search<'a> {
    chain: &'a dyn Chain,
    /// Columns of joints, row by row.
    joints: &'a [Vec<f64>],
    configurations: usize,
    units: Vec<JointUnits>,
    observed: Vec<Observed>,
    tolerance: Tolerance,
}

impl<'a> Search<'a> {
    /// Prepares a search. `lengths` are the units of travel to try.
    pub(crate) fn new(
        chain: &'a dyn Chain,
        joints: &'a [Vec<f64>],
        lengths: &[Length],
        observed: Vec<Observed>,
        tolerance: Tolerance,
    ) -> Self {
        let units = JointUnits::all(chain.kinds(), chain.metres(), joints, lengths);
        Self { chain, joints, configurations: configurations(joints), units, observed, tolerance }
    }

    /// Returns the interpretations that fit and the nearest of the others. A stage is tried only if
    /// no earlier one fits.
    pub(crate) fn run(
        &self,
        stages: impl IntoIterator<Item = Vec<Trial>>,
        notes: &mut dyn Notes,
    ) -> Result<Vec<Candidate>> {
        let mut candidates: Vec<Candidate> = Vec::new();
        for stage in stages {
            if candidates.iter().any(|one| one.share(&self.tolerance) <= self.tolerance.enough) {
                break;
            }
            self.try_all(&stage, &mut candidates, notes)?;
        }
        Ok(candidates)
    }

    fn try_all(
        &self,
        trials: &[Trial],
        candidates: &mut Vec<Candidate>,
        notes: &mut dyn Notes,
    ) -> Result<()> {
        let mut cut = f64::INFINITY;
        for (done, Trial { joints, ends }) in trials.iter().enumerate() {
            notes.progress(done, trials.len());
            if notes.stop() {
                let help = "run the command again";
                return Err(mistake::with_help("doctor", "interrupted before the end", help));
            }
            for units in &self.units {
                let Some(nodes) = self.nodes(*units, joints) else { continue };
                for ends in ends {
                    self.try_observed(*units, joints, ends, &nodes, cut, candidates);
                }
            }
            cut = self.keep(candidates);
        }
        notes.progress(trials.len(), trials.len());
        Ok(())
    }

    /// Evaluates the parts of the chain at every node of the free zeros.
    fn nodes(&self, units: JointUnits, joints: &[Change]) -> Option<Vec<Vec<Parts>>> {
        let mut offsets = vec![Vec::new()];
        for (joint, form) in self.zeros(joints) {
            let with = |before: &Vec<(usize, f64)>| {
                form.nodes().map(|node| [&before[..], &[(joint, node)]].concat()).to_vec()
            };
            offsets = offsets.iter().flat_map(with).collect();
        }
        offsets.iter().map(|offsets| self.parts(units, joints, offsets)).collect()
    }

    fn zeros(&self, joints: &[Change]) -> Vec<(usize, ZeroForm)> {
        let zero = |change: &Change| match change {
            Change::Zero { joint, .. } => Some(match self.chain.kinds()[*joint] {
                VariableKind::Revolute => (*joint, ZeroForm::Circle),
                VariableKind::Prismatic => (*joint, ZeroForm::Line(0.1 / self.chain.metres())),
            }),
            _ => None,
        };
        joints.iter().filter_map(zero).collect()
    }

    /// Evaluates the parts row by row; returns none if the chain has no finite value.
    fn parts(&self, units: JointUnits, joints: &[Change], offsets: &[(usize, f64)]) -> Option<Vec<Parts>> {
        let other = joints.contains(&Change::Convention);
        let row = |columns: &Vec<f64>| {
            let mut q = joint_values(columns, self.chain.kinds(), units.factors, joints);
            offsets.iter().for_each(|(joint, offset)| q[*joint] += offset);
            self.chain.parts(&q, other).ok()
        };
        self.joints.iter().map(row).collect()
    }

    fn try_observed(
        &self,
        units: JointUnits,
        joints: &[Change],
        ends: &[Change],
        nodes: &[Vec<Parts>],
        cut: f64,
        candidates: &mut Vec<Candidate>,
    ) {
        let predicted: Vec<Vec<Pose>> = nodes.iter().map(|rows| self.with_ends(rows, ends)).collect();
        let of_machine = predicted.first().map_or(0.0, |poses| spread(poses));
        let zeros = self.zeros(joints);
        let forms: Vec<ZeroForm> = zeros.iter().map(|(_, form)| *form).collect();
        let free = [Change::BaseElsewhere, Change::ToolElsewhere].map(|change| ends.contains(&change));
        let rows = self.joints.len();
        for seen in &self.observed {
            let (oriented, lever) = (seen.layout.is_oriented(), LEVER * seen.spread);
            let numbers = self.configurations * if oriented { 6 } else { 3 };
            let fitted = joints.iter().chain(ends).map(|change| change.fitted(oriented)).sum::<usize>();
            // So few values fit anything.
            if numbers < 2 * fitted {
                continue;
            }
            // A position alone cannot be inverted.
            if !oriented && ends.contains(&Change::PoseInverted) {
                continue;
            }
            let limit = self.tolerance.limit(seen.spread);
            let both = |[positions, angles]: [f64; 2]| positions + lever * lever * angles;
            let (changed, predicted, [base, tool]) = if !zeros.is_empty() {
                let values: Vec<f64> =
                    predicted.iter().map(|poses| both(squares(poses, &seen.poses, oriented))).collect();
                let far = |sum: f64, times: f64| (sum.max(0.0) / rows as f64).sqrt() > times * limit;
                // A few iterations tell whether more are worthwhile.
                if far(minimum(&forms, &values, 15).1, 20.0) {
                    continue;
                }
                let (offsets, sum) = minimum(&forms, &values, 2000);
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
                (changed.collect::<Vec<_>>(), self.with_ends(&parts, ends), [None; 2])
            } else if free.contains(&true) {
                // No tool makes the motion of a machine that much larger or smaller.
                if !(seen.spread / UNLIKE..=seen.spread * UNLIKE).contains(&of_machine) {
                    continue;
                }
                if !can_be_fitted(&predicted[0], &seen.poses, oriented, free[1], limit) {
                    continue;
                }
                let Some((moved, [base, tool])) =
                    registered(&predicted[0], &seen.poses, oriented, lever, free)
                else {
                    continue;
                };
                (joints.to_vec(), moved, [free[0].then_some(base), free[1].then_some(tool)])
            } else {
                (joints.to_vec(), predicted[0].clone(), [None; 2])
            };
            let left = squares(&predicted, &seen.poses, oriented);
            let residual = PoseResidual::new(left, rows, oriented, lever, [numbers, fitted]);
            let turns = self.chain.kinds().contains(&VariableKind::Revolute);
            let slides = self.chain.kinds().contains(&VariableKind::Prismatic);
            let interpretation = Interpretation {
                joints_in_degrees: turns.then_some(units.degrees),
                slides_in: slides.then_some(units.slides),
                lengths_in: seen.unit,
                layout: seen.layout,
                changes: [&changed[..], ends, &seen.changes].concat(),
            };
            let candidate =
                Candidate { interpretation, residual, predicted, base, tool, spread: seen.spread };
            let share = candidate.share(&self.tolerance);
            // A unit that makes the measurements far larger than the machine is not a candidate
            // either.
            let is_one = || share <= cut && residual.both <= 2.0 * of_machine;
            if share <= NEAR || is_one() {
                candidates.push(candidate);
            }
        }
    }

    /// Keeps candidates that may fit and the nearest of the others. Returns the share beyond which
    /// candidates are dropped.
    fn keep(&self, candidates: &mut Vec<Candidate>) -> f64 {
        let share = |candidate: &Candidate| candidate.share(&self.tolerance);
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

/// Returns true if a fit of base or tool can succeed. The rotation angle between rows depends on
/// neither, and distances between positions do not depend on the base.
fn can_be_fitted(predicted: &[Pose], seen: &[Pose], oriented: bool, tool: bool, limit: f64) -> bool {
    let [mut turns, mut distances] = [0.0; 2];
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let trace = |a: &Pose, b: &Pose| dot(a.0[0], b.0[0]) + dot(a.0[1], b.0[1]) + dot(a.0[2], b.0[2]);
    let distance = |a: &Pose, b: &Pose| norm(std::array::from_fn(|i| a.0[3][i] - b.0[3][i]));
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
