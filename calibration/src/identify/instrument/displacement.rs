//! Laser interferometer, linear scale: distance of a target from its position in the previous row.

use super::{Evaluation, Geometry, InstrumentKind, Observable, Reference};
use abbe_analysis::sampling::vectors::{dot, subtract as difference, unit};

/// `|p − p_0|`.
pub(super) static DISPLACEMENT: InstrumentKind = InstrumentKind {
    name: "displacement",
    reads: "the distance of a target from its position in the row before, whether anything was read there or not: a laser or a scale between two poses",
    keys: &["column", "unit", "target"],
    reference: Reference::PreviousRow,
    evaluate,
    ..InstrumentKind::LENGTH
};

/// Evaluates `|p − p_0|`; its gradient is `(p − p_0) / |p − p_0|`, zero without motion.
pub(super) fn evaluate(observable: &Observable, geometry: &Geometry) -> Evaluation {
    let target = observable.targets[0];
    let apart = difference(geometry.target(target), geometry.previous_target(target));
    Evaluation { value: dot(apart, apart).sqrt(), along: unit(apart), ..Evaluation::ZERO }
}
