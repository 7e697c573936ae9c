//! Touched plane: a target lies in a plane.

use super::kind::{InstrumentKind, SizeInformation};

/// `n · (p − a) = 0`, the observable of an [indicator](super::indicator).
pub(super) static PLANE: InstrumentKind = InstrumentKind {
    name: "plane",
    reads: "nothing: the target touches a plane",
    keys: &["target", "at", "direction"],
    has_unknown_zero: true,
    size: SizeInformation::Variation,
    evaluate: super::indicator::evaluate,
    ..InstrumentKind::LENGTH
};
