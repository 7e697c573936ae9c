//! Words of a spec file that stand for one of a few values.

use abbe_core::{Class, Distribution, LengthUnit, Orientation, VariableKind};

use crate::expr::{Extrapolation, Interpolation};
use crate::manipulator::Axes;

pub(super) const LENGTHS: [(&str, LengthUnit); 2] =
    [("mm", LengthUnit::Millimetre), ("m", LengthUnit::Metre)];

pub(super) const ORIENTATIONS: [(&str, Orientation); 3] = [
    ("rotation-vector", Orientation::RotationVector),
    ("euler-yzx", Orientation::EulerYzx),
    ("iec-61217", Orientation::Iec61217),
];

pub(super) const JOINT_KINDS: [(&str, VariableKind); 2] =
    [("revolute", VariableKind::Revolute), ("prismatic", VariableKind::Prismatic)];

pub(super) const INTERPOLATIONS: [(&str, Interpolation); 2] =
    [("linear", Interpolation::Linear), ("cubic", Interpolation::Cubic)];

pub(super) const OUTSIDE: [(&str, Extrapolation); 1] = [("hold", Extrapolation::Hold)];

/// Closures of a loop, each with its coordinates; a distance has none.
pub(super) const CLOSURES: [(&str, &[usize]); 3] =
    [("point", &[0, 1, 2]), ("pose", &[0, 1, 2, 3, 4, 5]), ("distance", &[])];

/// Classes of a source, with a distribution that stands for any.
pub(super) const CLASSES: [(&str, Class); 3] = [
    ("repeatable", Class::Repeatable),
    ("tolerance", Class::Tolerance(Distribution::Uniform)),
    ("random", Class::Random(Distribution::Uniform)),
];

pub(super) const BEAM_AXES: [(&str, usize); 3] = [("x", 0), ("y", 1), ("z", 2)];

pub(super) const LOAD_AXES: [(&str, Axes); 2] = [("frame", Axes::Frame), ("base", Axes::Base)];

pub(super) const TOOL: [(&str, ()); 1] = [("tool", ())];
