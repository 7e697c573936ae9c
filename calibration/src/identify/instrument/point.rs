//! Laser tracker, coordinate measuring machine: coordinates of a target in the frame of the
//! instrument.

use super::{Evaluation, Geometry, InstrumentKind, Observable, SizeInformation};

/// Coordinates `p_x`, `p_y`, `p_z`.
pub(super) static POINT: InstrumentKind = InstrumentKind {
    name: "point",
    reads: "the coordinates of a target in the frame of the instrument",
    keys: &["columns", "unit", "target"],
    numbers: 3,
    sees_base: true,
    size: SizeInformation::Variation,
    evaluate,
    ..InstrumentKind::LENGTH
};

/// Evaluates `p_k` in the frame of the instrument; its gradient is `e_k` of that frame.
pub(super) fn evaluate(observable: &Observable, geometry: &Geometry) -> Evaluation {
    let k = observable.axis;
    Evaluation {
        value: geometry.target_seen(observable.targets[0])[k],
        along: core::array::from_fn(|i| geometry.base.0[i][k]),
        ..Evaluation::ZERO
    }
}
