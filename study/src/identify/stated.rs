//! The interpretation that a map states, and rows by another one.

use abbe::identify::{Measurement, Observation};
use abbe::{Pose, VariableKind};

use super::setup::Setup;
use crate::data::{Channel, Layout, Map, Order, Turn, to_numbers};
use crate::interpretations::{
    Change, Interpretation, LENGTHS, Length, PoseFormat, angle, changed, joint_values, mirrored,
};

/// The units of length that have a name here.
const NAMED: [Length; 5] = [LENGTHS[0], LENGTHS[1], ("um", 1e-6), ("cm", 1e-2), ("inch", 0.0254)];

/// What a map states, and what is needed to read rows otherwise.
pub(super) struct Stated<'a> {
    pub(super) interpretation: Interpretation,
    map: &'a Map,
    kinds: Vec<VariableKind>,
    travel: Length,
    length: Length,
    /// The length unit of the spec, in metres.
    metres: f64,
}

impl<'a> Stated<'a> {
    /// None if the map has a layout in which no pose and no point is seen.
    pub(super) fn new(setup: &Setup, map: &'a Map) -> Option<Self> {
        let metres = setup.description.length.in_metres();
        let kinds: Vec<VariableKind> =
            setup.description.variables.iter().map(|variable| variable.kind).collect();
        // One in the first column of a kind; joints of one kind are rarely in several units.
        let one = |kind: VariableKind| {
            kinds.contains(&kind).then(|| {
                let columns = kinds.iter().zip(&map.joints).filter(|(one, _)| **one == kind);
                let scales = columns.filter_map(|(_, channel)| match channel {
                    Channel::Column(_, scale) => Some(scale.one.abs()),
                    _ => None,
                });
                scales.into_iter().next().unwrap_or(1.0)
            })
        };
        let travel = named(one(VariableKind::Prismatic).unwrap_or(1.0) * metres);
        let length = named(
            metres
                * match &map.layout {
                    Layout::Point(_, factor)
                    | Layout::Difference(_, _, factor)
                    | Layout::Pose(_, factor, _) => *factor,
                    Layout::Targets(targets) => targets.first()?.factor,
                    Layout::Instruments(_) => 1.0,
                },
        );
        let layout = match &map.layout {
            Layout::Pose(_, _, turn) => format_of(turn),
            _ => PoseFormat::Position,
        };
        let interpretation = Interpretation {
            joints_in_degrees: one(VariableKind::Revolute).map(is_degree),
            slides_in: one(VariableKind::Prismatic).map(|_| travel.0),
            lengths_in: length.0,
            layout,
            changes: Vec::new(),
        };
        Some(Self { interpretation, map, kinds, travel, length, metres })
    }

    /// The units of travels that are tried.
    pub(super) fn travels(&self) -> Vec<Length> {
        with_common(self.travel)
    }

    /// The units of measured lengths that are tried: instruments state theirs one by one.
    pub(super) fn lengths(&self) -> Vec<Length> {
        match self.map.layout {
            Layout::Instruments(_) => vec![self.length],
            _ => with_common(self.length),
        }
    }

    /// The formats that the same columns can be in.
    pub(super) fn layouts(&self) -> Vec<PoseFormat> {
        match self.interpretation.layout {
            PoseFormat::Euler { .. } | PoseFormat::RotationVector { .. } => {
                PoseFormat::all(6).into_iter().filter(|format| format.is_oriented()).collect()
            }
            PoseFormat::Quaternion { .. } => PoseFormat::all(7),
            layout => vec![layout],
        }
    }

    /// What can be otherwise in the measured columns.
    pub(super) fn changes(&self) -> Vec<Option<Change>> {
        match self.map.layout {
            Layout::Instruments(_) => vec![None],
            Layout::Pose(..) => vec![None, Some(Change::Mirrored), Some(Change::OrientationInverted)],
            _ => vec![None, Some(Change::Mirrored)],
        }
    }

    /// The numbers of the columns of joints, as stated but for signs and zeros.
    pub(super) fn joints(&self, q: &[f64]) -> Vec<f64> {
        let factors = self.factors(&self.interpretation);
        let factor = |kind: &VariableKind| factors[usize::from(*kind == VariableKind::Prismatic)];
        q.iter().zip(&self.kinds).map(|(value, kind)| value / factor(kind)).collect()
    }

    /// The numbers of the measured columns, angles in degrees or radians.
    pub(super) fn numbers(&self, pose: &Pose) -> Vec<f64> {
        let [x, y, z, position] = pose.0;
        let mut numbers = position.map(|x| x * self.metres / self.length.1).to_vec();
        if let Layout::Pose(_, _, turn) = &self.map.layout {
            let unit = match turn {
                Turn::Euler(_, _, factor) | Turn::RotationVector(_, factor) => {
                    factor / angle(is_degree(*factor))
                }
                Turn::Quaternion(..) | Turn::Matrix(_) => 1.0,
            };
            numbers.extend(to_numbers(turn, &[x, y, z]).into_iter().map(|number| number * unit));
        }
        numbers
    }

    /// A row by another interpretation.
    pub(super) fn reread(&self, row: &Observation, found: &Interpretation) -> Observation {
        let mut row = row.clone();
        row.q = joint_values(&self.joints(&row.q), &self.kinds, self.factors(found), &found.changes).into();
        let factor = self.length_of(found.lengths_in).1 / self.metres;
        row.measured = match row.measured {
            Measurement::Points(points) => {
                let scale = factor * self.metres / self.length.1;
                let is_mirrored = found.changes.contains(&Change::Mirrored);
                let point = |point: [f64; 3]| {
                    let point = point.map(|x| x * scale);
                    if is_mirrored { mirrored(point) } else { point }
                };
                Measurement::Points(points.iter().map(|one| one.map(point)).collect())
            }
            Measurement::Pose(pose) => {
                let read = found.layout.pose(&self.numbers(&pose), factor).unwrap_or(*pose);
                Measurement::Pose(Box::new(found.changes.iter().fold(read, |pose, one| changed(&pose, one))))
            }
            Measurement::Readings(values) => Measurement::Readings(values),
        };
        if let Some(approach) = &mut row.approach {
            approach.from = approach.from.take().map(|from| Box::new(self.reread(&from, found)));
        }
        row
    }

    /// What makes angles and travels coherent.
    fn factors(&self, interpretation: &Interpretation) -> [f64; 2] {
        let travel = interpretation.slides_in.map_or(self.travel, |unit| match unit {
            unit if unit == self.travel.0 => self.travel,
            unit => common(unit),
        });
        [angle(interpretation.joints_in_degrees == Some(true)), travel.1 / self.metres]
    }

    fn length_of(&self, unit: &str) -> Length {
        if unit == self.length.0 { self.length } else { common(unit) }
    }
}

fn is_degree(one: f64) -> bool {
    (one / angle(true) - 1.0).abs() < 1e-9
}

fn named(metres: f64) -> Length {
    let is_it = |(_, one): &&Length| (one / metres - 1.0).abs() < 1e-9;
    NAMED.iter().find(is_it).copied().unwrap_or(("the unit of the map", metres))
}

fn common(unit: &str) -> Length {
    LENGTHS.into_iter().find(|(name, _)| *name == unit).unwrap_or(LENGTHS[0])
}

/// The stated unit and the common ones.
fn with_common(stated: Length) -> Vec<Length> {
    let others = LENGTHS.into_iter().filter(|(name, _)| *name != stated.0);
    std::iter::once(stated).chain(others).collect()
}

fn format_of(turn: &Turn) -> PoseFormat {
    match turn {
        Turn::Quaternion(_, order) => PoseFormat::Quaternion { scalar_first: *order == Order::Wxyz },
        Turn::Matrix(_) => PoseFormat::Matrix { by_rows: true },
        Turn::Euler(_, axes, factor) => {
            PoseFormat::Euler { axes: *axes, fixed: false, degrees: is_degree(*factor) }
        }
        Turn::RotationVector(_, factor) => PoseFormat::RotationVector { degrees: is_degree(*factor) },
    }
}
