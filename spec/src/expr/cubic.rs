//! The slopes of cubics through points that never leave the range between two neighbours.
//!
//! Those of Fritsch and Butland, *A method for constructing local monotone piecewise cubic interpolants*, SIAM J. Sci. Stat.
//! Comput. 5 (1984) 300–304, with the ends of Moler, *Numerical computing with MATLAB*, section 3.6: what MATLAB and SciPy
//! call pchip. A natural spline is smoother, but it overshoots between measured points, and one wrong point bends
//! all of it; here a point changes the two intervals on each side of it, and a table never says more than was measured.

/// The slope at each of n + 1 points, from the widths of the n intervals between them and the slopes of their secants.
///
/// Where the secants `d` of two neighbours differ in sign it is 0, else their weighted harmonic mean:
/// `m = (w₁ + w₂) / (w₁/d₁ + w₂/d₂)` with `w₁ = 2h₂ + h₁` and `w₂ = h₂ + 2h₁`.
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

/// The slope at an end: of the parabola through three points, `((2h₁ + h₂) d₁ − h₁ d₂) / (h₁ + h₂)`, but of the sign of
/// `d₁`, and no more than `3 d₁` where the secants differ in sign.
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
