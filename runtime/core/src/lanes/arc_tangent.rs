//! Angle of a point in lanes, without branches or tables.
//!
//! The smaller of `|x|` and `|y|` over the larger is reduced to `|t| ≤ tan π/8` by
//! `atan t = π/4 + atan ((t − 1) / (t + 1))`. Then `atan t = t − t³ A(t²)` with the minimax polynomial
//! of fdlibm, for `|t| ≤ 7/16`. Octants follow. The error is below 2 ulp.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use super::{Lanes, Register};
use crate::Scalar;

/// Sizes of coordinates outside of which [`near`] does not hold: the larger one may be neither.
pub(super) const REACH: [f64; 2] = [1e-290, 1e290];

/// `tan π/8`.
const TAN_PI_8: f64 = 0.414_213_562_373_095_03;
/// Rest of π/4 beyond its `f64`.
const FRAC_PI_4_REST: f64 = 3.061_616_997_868_383e-17;
/// Coefficients of `A`, lowest power first.
const COEFFICIENTS: [f64; 11] = [
    0.333_333_333_333_329_3,
    -0.199_999_999_998_764_83,
    0.142_857_142_725_034_66,
    -0.111_111_104_054_623_56,
    0.090_908_871_334_365_07,
    -0.076_918_762_050_448_3,
    0.066_610_731_373_875_31,
    -0.058_335_701_337_905_735,
    0.049_768_779_946_159_324,
    -0.036_531_572_744_216_916,
    0.016_285_820_115_365_782,
];

/// Returns the angle of the point (x, y), whose larger coordinate is within [`REACH`].
// Without optimization, each copy of it in a long function would take room on the stack.
#[cfg_attr(debug_assertions, inline(never))]
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn near<R: Register>(y: Lanes<R>, x: Lanes<R>) -> Lanes<R> {
    let number = <Lanes<R> as Scalar>::constant;
    let zero = number(0.0);
    let (wide, high) = (x.abs(), y.abs());
    let (less, more) = (Lanes::min(wide, high), Lanes::max(wide, high));
    // Beyond π/8 the angle is measured from π/4.
    let is_steep = less.more_than(more * number(TAN_PI_8));
    let upper = is_steep.select(less - more, less);
    let lower = is_steep.select(less + more, more);
    let t = upper / lower;
    let z = t * t;
    let w = z * z;
    // Even and odd powers, which do not wait for each other.
    let mut odd = number(COEFFICIENTS[9]);
    let mut even = number(COEFFICIENTS[10]);
    for i in (0..4).rev() {
        odd = Scalar::mul_add(w, odd, number(COEFFICIENTS[2 * i + 1]));
        even = Scalar::mul_add(w, even, number(COEFFICIENTS[2 * i + 2]));
    }
    let even = Scalar::mul_add(w, even, number(COEFFICIENTS[0]));
    let rest = is_steep.select(number(FRAC_PI_4_REST), zero);
    let part = Scalar::neg_mul_add(t * z, Scalar::mul_add(z, odd, even), rest);
    let angle = is_steep.select(number(FRAC_PI_4), zero) + (t + part);
    let angle =
        high.more_than(wide).select(number(FRAC_PI_2) - (angle - number(2.0 * FRAC_PI_4_REST)), angle);
    let angle = zero.more_than(x).select(number(PI) - (angle - number(4.0 * FRAC_PI_4_REST)), angle);
    // NaN stays NaN, also of the coordinate that a minimum drops.
    let angle = angle + (x + y) * zero;
    angle.with_sign_of(y)
}
