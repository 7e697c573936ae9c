//! Dial indicator with a flat tip: coordinate of a target along a fixed direction.

use super::{Evaluation, Geometry, InstrumentKind, Observable, SizeInformation};
use abbe_analysis::sampling::vectors::{dot, subtract as difference};

/// `n · (p − a)`.
pub(super) static INDICATOR: InstrumentKind = InstrumentKind {
    name: "indicator",
    reads: "the coordinate of a target along a direction: a dial indicator with a flat tip, against a ball; its zero is unknown",
    keys: &["column", "unit", "target", "at", "direction", "range"],
    has_unknown_zero: true,
    size: SizeInformation::Variation,
    evaluate,
    ..InstrumentKind::LENGTH
};

/// Evaluates `n · (p − a)`; its gradients are `n` with respect to `p`, and `p − a` with respect to
/// `n`.
pub(super) fn evaluate(observable: &Observable, geometry: &Geometry) -> Evaluation {
    let n = geometry.fixture(observable.fixture);
    let apart = difference(geometry.target(observable.targets[0]), observable.at);
    Evaluation { value: dot(n, apart), along: n, by_fixture: apart, ..Evaluation::ZERO }
}
