//! Rotary-axis calibrator, angular interferometer: rotation of the tool since the previous row.

use super::{Evaluation, Geometry, InstrumentKind, Observable, Reference, SizeInformation};
use abbe_analysis::sampling::vectors::{dot, unit};
use abbe_core::rotation_vector;

/// Angle of `R R_0ᵀ`, in rad.
pub(super) static ROTATION: InstrumentKind = InstrumentKind {
    name: "rotation",
    reads: "the angle by which the tool has rotated since the row before, at most 180°, whether anything was read there \
            or not: a rotary-axis calibrator, an angular interferometer",
    keys: &["column", "unit"],
    is_angle: true,
    reference: Reference::PreviousRow,
    size: SizeInformation::None,
    evaluate,
    ..InstrumentKind::LENGTH
};

/// Evaluates `θ = |r|`, `r` the rotation vector of `R R_0ᵀ`; its gradient is `r / θ`, zero without
/// motion.
///
/// A further rotation `dω` about `r / θ` adds to θ; about axes perpendicular to it, it changes the
/// direction of `r` alone.
fn evaluate(_: &Observable, geometry: &Geometry) -> Evaluation {
    let mut turn = geometry.tool_in_f0.then(&geometry.previous_tool().inverse());
    turn.0[3] = [0.0; 3];
    let r = rotation_vector(&turn);
    Evaluation { value: dot(r, r).sqrt(), along: unit(r), ..Evaluation::ZERO }
}
