//! Touched sphere: a target is at the distance of the radius from a fixed point.

use super::kind::InstrumentKind;

/// `|p − c| = r`, the observable of a [distance](super::distance) whose zero is `−r`.
pub(super) static SPHERE: InstrumentKind = InstrumentKind {
    name: "sphere",
    reads: "nothing: the target touches a sphere",
    keys: &["target", "at", "radius", "nominal_radius"],
    evaluate: super::distance::evaluate,
    ..InstrumentKind::LENGTH
};
