//! Calliper, length bar: distance of two targets on the tool.

use super::{Evaluation, Geometry, InstrumentKind, Observable, Reference};
use abbe_analysis::sampling::vectors::{dot, subtract as difference, unit};

/// `|p_1 − p_2|`.
pub(super) static BETWEEN: InstrumentKind = InstrumentKind {
    name: "between",
    reads: "the distance of two targets from each other",
    keys: &["column", "unit", "targets", "zero"],
    reference: Reference::Target,
    evaluate,
    ..InstrumentKind::LENGTH
};

/// Evaluates `|p_1 − p_2|`; its gradient is `(p_1 − p_2) / |p_1 − p_2|`.
pub(super) fn evaluate(observable: &Observable, geometry: &Geometry) -> Evaluation {
    let [first, second] = observable.targets.map(|target| geometry.target(target));
    let apart = difference(first, second);
    Evaluation { value: dot(apart, apart).sqrt(), along: unit(apart), ..Evaluation::ZERO }
}
