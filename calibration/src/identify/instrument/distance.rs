//! Ballbar, draw-wire: distance of a target from a fixed point.

use super::{Evaluation, Geometry, InstrumentKind, Observable};
use abbe_analysis::sampling::vectors::{dot, subtract as difference, unit};

/// `|p − c|`.
pub(super) static DISTANCE: InstrumentKind = InstrumentKind {
    name: "distance",
    reads: "the distance of a target from a point: ballbar, draw-wire",
    keys: &["column", "unit", "target", "at", "zero", "range"],
    evaluate,
    ..InstrumentKind::LENGTH
};

/// Evaluates `|p − c|`; its gradients are `±(p − c) / |p − c|`.
pub(super) fn evaluate(observable: &Observable, geometry: &Geometry) -> Evaluation {
    let apart = difference(geometry.target(observable.targets[0]), geometry.fixture(observable.fixture));
    let along = unit(apart);
    Evaluation { value: dot(apart, apart).sqrt(), along, by_fixture: along.map(|v| -v), ..Evaluation::ZERO }
}
