//! Centre point, nest: a target is held at a fixed point.

use super::{Evaluation, Geometry, InstrumentKind, Observable, SizeInformation};
use abbe_core::Pose;

/// `p − c = 0`.
pub static CONTACT: InstrumentKind = InstrumentKind {
    name: "contact",
    reads: "nothing: the target is held at a point, and the joints are recorded",
    keys: &["target", "at"],
    numbers: 3,
    finds_position: true,
    size: SizeInformation::None,
    evaluate,
    ..InstrumentKind::LENGTH
};

/// Evaluates `(p − c)_k` in the axes of `F_0`; its gradients are `±e_k`.
pub(super) fn evaluate(observable: &Observable, geometry: &Geometry) -> Evaluation {
    let (k, along) = (observable.axis, Pose::IDENTITY.0[observable.axis]);
    Evaluation {
        value: geometry.target(observable.targets[0])[k] - geometry.fixture(observable.fixture)[k],
        along,
        by_fixture: along.map(|v| -v),
        ..Evaluation::ZERO
    }
}
