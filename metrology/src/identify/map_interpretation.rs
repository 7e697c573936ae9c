//! Interpretation of the data stated by a map, and conversion of rows to other interpretations.

use abbe::identify::{Measurement, Observation};
use abbe::{Pose, VariableKind};

use super::setup::Setup;
use crate::data::{Channel, Layout, Map, Order, Turn, to_numbers};
use crate::interpretations::{
    Change, Interpretation, LENGTHS, Length, PoseFormat, angle, changed, joint_values, mirrored,
};

/// Interpretation stated by a map, and the conversion factors to other interpretations.
pub(super) struct MapInterpretation<'a> {
    pub(super) interpretation: Interpretation,
    map: &'a Map,
    kinds: Vec<VariableKind>,
    travel: Length,
    length: Length,
    /// Length unit of the spec, in metres.
    metres: f64,
}

impl<'a> MapInterpretation<'a> {
    /// Returns none if the layout of the map has no targets.
    pub(super) fn new(setup: &Setup, map: &'a Map) -> Option<Self> {
        let metres = setup.description.length.in_metres();
        let kinds: Vec<VariableKind> =
            setup.description.variables.iter().map(|variable| variable.kind).collect();
        // The first column of a kind decides: joints of one kind rarely have several units.
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
            Layout::Instruments(all) if all.camera.is_some() => PoseFormat::Matrix { by_rows: true },
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

    /// Returns the units of joint travel to try.
    pub(super) fn travels(&self) -> Vec<Length> {
        with_common(self.travel)
    }

    /// Returns the units of measured lengths to try; instruments state theirs one by one.
    pub(super) fn lengths(&self) -> Vec<Length> {
        match self.map.layout {
            Layout::Instruments(_) => vec![self.length],
            _ => with_common(self.length),
        }
    }

    /// Returns the formats that the same columns can have.
    pub(super) fn layouts(&self) -> Vec<PoseFormat> {
        match self.interpretation.layout {
            PoseFormat::Euler { .. } | PoseFormat::RotationVector { .. } => {
                PoseFormat::all(6).into_iter().filter(|format| format.is_oriented()).collect()
            }
            PoseFormat::Quaternion { .. } => PoseFormat::all(7),
            layout => vec![layout],
        }
    }

    /// Returns the changes of the measured columns to try.
    pub(super) fn changes(&self) -> Vec<Option<Change>> {
        match self.map.layout {
            Layout::Instruments(_) => vec![None],
            Layout::Pose(..) => vec![None, Some(Change::Mirrored), Some(Change::OrientationInverted)],
            _ => vec![None, Some(Change::Mirrored)],
        }
    }

    /// Converts joint values to numbers of the columns, without signs and zeros.
    pub(super) fn joints(&self, q: &[f64]) -> Vec<f64> {
        let factors = self.factors(&self.interpretation);
        let factor = |kind: &VariableKind| factors[usize::from(*kind == VariableKind::Prismatic)];
        q.iter().zip(&self.kinds).map(|(value, kind)| value / factor(kind)).collect()
    }

    /// Converts a measured pose to numbers of the columns, with angles in degrees or radians.
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
        } else if self.interpretation.layout.is_oriented() {
            numbers.extend((0..3).flat_map(|row| [x[row], y[row], z[row]]));
        }
        numbers
    }

    /// Converts a row to another interpretation.
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

    /// Returns the factors from column numbers to coherent units, for angles and for travels.
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
    LENGTHS.iter().find(is_it).copied().unwrap_or(("the unit of the map", metres))
}

fn common(unit: &str) -> Length {
    LENGTHS.into_iter().find(|(name, _)| *name == unit).unwrap_or(LENGTHS[0])
}

/// Returns the stated unit and all others.
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
