//! Other ways to read rows than the map says.

use std::f64::consts::PI;

use abbe::identify::{Measurement, Observation};
use abbe::{Pose, VariableKind};

use super::setup::Setup;
use crate::data::{EULER_ORDERS, Layout, Map, Order, Turn, reread};

const DEGREE: f64 = PI / 180.0;

/// One thing that was meant otherwise than the map says.
#[derive(Clone, Debug)]
pub(super) enum Change {
    /// The measured lengths are in another unit: they are so many times as large.
    Lengths(f64),
    /// So are the values of all joints of a kind.
    Joints(VariableKind, f64),
    /// These joints count the other way round.
    Reversed(Vec<usize>),
    /// The columns of two joints are swapped.
    Swapped(usize, usize),
    /// Two of the columns of x, y and z are swapped, or one has the wrong sign: all of these are the same but for a turn of the
    /// base, and other orders are such a turn.
    Mirrored,
    /// The orientation is written as another kind.
    Turned(Turn),
    /// The orientation is that of `F_0` as the tool sees it.
    Inverse,
}

impl Change {
    /// Applies it to a row that was read with a map.
    pub(super) fn apply(&self, mut row: Observation, setup: &Setup, map: &Map) -> Observation {
        match self {
            Self::Lengths(factor) => row.measured = points(row.measured, |point| point.map(|x| x * factor)),
            Self::Mirrored => row.measured = points(row.measured, |[x, y, z]| [y, x, z]),
            Self::Joints(kind, factor) => {
                let values = row.q.iter_mut().zip(setup.description.variables.iter());
                values.filter(|(_, variable)| variable.kind == *kind).for_each(|(value, _)| *value *= factor);
            }
            Self::Reversed(joints) => joints.iter().for_each(|i| row.q[*i] = -row.q[*i]),
            Self::Swapped(i, j) => row.q.swap(*i, *j),
            Self::Turned(other) => row.measured = turned(row.measured, map, other),
            Self::Inverse => row.measured = inverse(row.measured),
        }
        if let Some(approach) = &mut row.approach {
            approach.from = approach.from.take().map(|from| Box::new(self.apply(*from, setup, map)));
        }
        row
    }

    /// What to ask, and what to change in the map.
    pub(super) fn question(&self, setup: &Setup) -> String {
        let name = |i: usize| format!("`{}`", setup.description.variables[i].name);
        match self {
            Self::Lengths(factor) => format!("are the measured lengths in {}? set `unit` accordingly", lengths(*factor)),
            Self::Joints(VariableKind::Prismatic, factor) => {
                format!("are the joint travels in {}? set `unit` accordingly", lengths(*factor))
            }
            Self::Joints(VariableKind::Revolute, factor) if *factor < 1.0 => {
                "are the joint angles in deg, not rad? set `unit = \"deg\"`".to_owned()
            }
            Self::Joints(VariableKind::Revolute, _) => {
                "are the joint angles in rad, not deg? set `unit = \"rad\"`".to_owned()
            }
            Self::Reversed(joints) => match &joints[..] {
                [only] => format!("does {} count the other way round? set `sign = -1` there", name(*only)),
                several => {
                    let names = several.iter().map(|i| name(*i)).collect::<Vec<_>>().join(", ");
                    format!("do {names} count the other way round? set `sign = -1` there")
                }
            },
            Self::Swapped(i, j) => format!("are the columns of {} and {} swapped?", name(*i), name(*j)),
            Self::Mirrored => {
                "are two of the measured columns x, y and z swapped, or has one the wrong sign?".to_owned()
            }
            Self::Turned(Turn::Quaternion(_, order)) => {
                let order = if *order == Order::Wxyz { "wxyz" } else { "xyzw" };
                format!("is the quaternion in the order `{order}`?")
            }
            Self::Turned(Turn::Euler(_, axes, _)) => {
                let order: String = axes.iter().map(|axis| ["x", "y", "z"][*axis]).collect();
                format!("are these Euler angles in the order `{order}`?")
            }
            Self::Turned(Turn::RotationVector(..)) => {
                "are these numbers a rotation vector, not Euler angles? give them as `rotation_vector`".to_owned()
            }
            Self::Inverse | Self::Turned(Turn::Matrix(_)) => {
                "are the orientations the other way round, of F_0 as the tool sees it? turn them round in the file".to_owned()
            }
        }
    }
}

fn lengths(factor: f64) -> &'static str {
    if factor > 1.0 { "m, not mm" } else { "mm, not m" }
}

/// By unit: nothing, what is measured, the joints of a kind, and combinations of these. No length is far beyond the machine
/// both ways.
pub(super) fn units(setup: &Setup) -> Vec<Vec<Change>> {
    let has = |kind: VariableKind| setup.description.variables.iter().any(|variable| variable.kind == kind);
    let mut all = vec![Vec::new()];
    let mut add = |changes: [Change; 2]| {
        let with = |change: &Change| {
            let change = std::slice::from_ref(change);
            all.iter().map(|others| [&others[..], change].concat()).collect::<Vec<_>>()
        };
        let more = changes.iter().flat_map(with).collect::<Vec<_>>();
        all.extend(more);
    };
    add([1e3, 1e-3].map(Change::Lengths));
    for (kind, factor) in [(VariableKind::Revolute, DEGREE), (VariableKind::Prismatic, 1e-3)] {
        if has(kind) {
            add([factor, 1.0 / factor].map(|factor| Change::Joints(kind, factor)));
        }
    }
    all
}

/// By order: columns of joints of one kind that are swapped, and two of the coordinates.
pub(super) fn orders(setup: &Setup) -> Vec<Change> {
    let variables = &setup.description.variables;
    let pairs = (0..variables.len()).flat_map(|j| (0..j).map(move |i| (i, j)));
    let alike = pairs.filter(|(i, j)| variables[*i].kind == variables[*j].kind);
    let swapped = alike.map(|(i, j)| Change::Swapped(i, j));
    swapped.chain([Change::Mirrored]).collect()
}

/// By orientation, if poses are measured.
pub(super) fn orientations(map: &Map) -> Vec<Change> {
    let Layout::Pose(_, _, turn) = &map.layout else { return Vec::new() };
    let mut all = match turn {
        Turn::Quaternion(columns, order) => {
            let other = if *order == Order::Wxyz { Order::Xyzw } else { Order::Wxyz };
            vec![Change::Turned(Turn::Quaternion(columns.clone(), other))]
        }
        Turn::Euler(columns, axes, factor) => {
            let others = EULER_ORDERS.into_iter().filter(|(_, order)| order != axes);
            let others = others.map(|(_, order)| Turn::Euler(columns.clone(), order, *factor));
            others.chain([Turn::RotationVector(columns.clone(), *factor)]).map(Change::Turned).collect()
        }
        Turn::RotationVector(columns, factor) => {
            let orders = EULER_ORDERS.into_iter();
            orders.map(|(_, order)| Change::Turned(Turn::Euler(columns.clone(), order, *factor))).collect()
        }
        Turn::Matrix(_) => Vec::new(),
    };
    all.push(Change::Inverse);
    all
}

fn points(measured: Measurement, change: impl Fn([f64; 3]) -> [f64; 3]) -> Measurement {
    match measured {
        Measurement::Points(points) => {
            Measurement::Points(points.iter().map(|point| point.map(&change)).collect())
        }
        Measurement::Pose(mut pose) => {
            pose.0[3] = change(pose.position());
            Measurement::Pose(pose)
        }
        Measurement::Readings(_) => measured,
    }
}

/// The numbers of the orientation, read another way.
fn turned(measured: Measurement, map: &Map, other: &Turn) -> Measurement {
    match (&measured, &map.layout) {
        (Measurement::Pose(pose), Layout::Pose(_, _, turn)) => {
            let [x, y, z, position] = pose.0;
            let [x, y, z] = reread(turn, other, &[x, y, z]);
            Measurement::Pose(Box::new(Pose([x, y, z, position])))
        }
        _ => measured,
    }
}

fn inverse(measured: Measurement) -> Measurement {
    let Measurement::Pose(mut pose) = measured else { return measured };
    let position = pose.position();
    pose.0[3] = [0.0; 3];
    *pose = pose.inverse();
    pose.0[3] = position;
    Measurement::Pose(pose)
}
