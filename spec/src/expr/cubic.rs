//! Slopes of monotone cubic interpolation, which never leaves the range between two neighbouring
//! points.
//!
//! The method is that of Fritsch and Butland, *A method for constructing local monotone piecewise
//! cubic interpolants*, SIAM J. Sci. Stat. Comput. 5 (1984) 300–304, with the ends of Moler,
//! *Numerical computing with MATLAB*, section 3.6. MATLAB and SciPy call it pchip. A natural spline
//! is smoother, but it overshoots between measured points, and one outlier affects all of it. Here
//! a point affects two intervals on each side.

/// Returns the slope at each of n + 1 points, from the widths of the n intervals and the slopes of
/// their secants.
///
/// If the secants `d` of two neighbouring intervals differ in sign, the slope is 0. Otherwise it is
/// their weighted harmonic mean: `m = (w₁ + w₂) / (w₁/d₁ + w₂/d₂)` with `w₁ = 2h₂ + h₁` and `w₂ =
/// h₂ + 2h₁`.
pub(super) fn slopes(widths: &[f64], secants: &[f64]) -> Vec<f64> {
    let count = widths.len();
    if count == 1 {
        return vec![secants[0]; 2];
    }
    let inner = |k: usize| {
        let ([h1, h2], [d1, d2]) = ([widths[k - 1], widths[k]], [secants[k - 1], secants[k]]);
        if d1 * d2 <= 0.0 {
            return 0.0;
        }
        let (w1, w2) = (2.0 * h2 + h1, h2 + 2.0 * h1);
        (w1 + w2) / (w1 / d1 + w2 / d2)
    };
    let first = end([widths[0], widths[1]], [secants[0], secants[1]]);
    let last = end([widths[count - 1], widths[count - 2]], [secants[count - 1], secants[count - 2]]);
    [first].into_iter().chain((1..count).map(inner)).chain([last]).collect()
}

/// Returns the slope at an end: that of the parabola through three points, `((2h₁ + h₂) d₁ − h₁ d₂)
/// / (h₁ + h₂)`, limited to the sign of `d₁`, and to `3 d₁` if the secants differ in sign.
fn end([h1, h2]: [f64; 2], [d1, d2]: [f64; 2]) -> f64 {
    let slope = ((2.0 * h1 + h2) * d1 - h1 * d2) / (h1 + h2);
    if slope * d1 <= 0.0 {
        0.0
    } else if d1 * d2 < 0.0 && slope.abs() > 3.0 * d1.abs() {
        3.0 * d1
    } else {
        slope
    }
}
