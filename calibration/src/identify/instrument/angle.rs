//! Autocollimator, electronic level: inclination of a direction on the tool towards a fixed
//! direction.

use super::{Evaluation, Geometry, InstrumentKind, Observable, SizeInformation};
use abbe_analysis::sampling::vectors::{cross, dot};

/// `asin(n · R m)`, in rad.
pub(super) static ANGLE: InstrumentKind = InstrumentKind {
    name: "angle",
    reads: "the inclination of a mirror on the tool towards a direction: an autocollimator, or an electronic level if the direction is the vertical; its zero is unknown",
    keys: &["column", "unit", "direction", "mirror"],
    is_angle: true,
    has_unknown_zero: true,
    size: SizeInformation::None,
    evaluate,
    ..InstrumentKind::LENGTH
};

/// Evaluates `asin(n · R m)`; its gradients are `R m × n` with respect to a rotation, and `R m`
/// with respect to `n`, both divided by `√(1 − (n · R m)²)`.
pub(super) fn evaluate(observable: &Observable, geometry: &Geometry) -> Evaluation {
    let (m, n) = (geometry.tool_in_f0.turn(observable.mirror), geometry.fixture(observable.fixture));
    let sine = dot(n, m).clamp(-1.0, 1.0);
    let cosine = (1.0 - sine * sine).sqrt().max(f64::MIN_POSITIVE);
    let scaled = |v: [f64; 3]| v.map(|v| v / cosine);
    Evaluation { value: sine.asin(), along: scaled(cross(m, n)), by_fixture: scaled(m), ..Evaluation::ZERO }
}
