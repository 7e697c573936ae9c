//! Linear least squares within bounds: `min ‖A p + b‖` for `l ≤ p ≤ u`, by an active set.
//!
//! Stark and Parker, *Bounded-variable least squares: an algorithm and applications*, 1995. The
//! unbounded solution of the free variables is followed up to the first bound, which then fixes its
//! variable. A fixed variable is freed where the gradient points inwards. Every change lowers the
//! sum of squares, so no active set recurs.

use nalgebra::{DMatrix, DVector};

/// Smallest significant gradient, relative to the norms of its column and of the residual.
const ROUNDING: f64 = 1e-13;

/// Returns the solution, starting from `p = 0`, which the bounds must contain. `a` must have full
/// column rank; returns `None` if it has not.
pub(super) fn bounded(
    a: &DMatrix<f64>,
    b: &DVector<f64>,
    lower: &[f64],
    upper: &[f64],
) -> Option<DVector<f64>> {
    let n = a.ncols();
    let mut p = DVector::zeros(n);
    let outward = |j: usize, p: &DVector<f64>| {
        let residual = a * p + b;
        let gradient = a.column(j).dot(&residual);
        let least = ROUNDING * a.column(j).norm() * residual.norm();
        let at_lower = if p[j] <= lower[j] { gradient } else { f64::NEG_INFINITY };
        let at_upper = if p[j] >= upper[j] { -gradient } else { f64::NEG_INFINITY };
        (at_lower.max(at_upper), least)
    };
    let mut free: Vec<bool> = (0..n).map(|j| outward(j, &p).0 < 0.0).collect();
    // Each variable is fixed and freed a few times at most. The limit guards against cycles by
    // rounding errors.
    for _ in 0..10 * n + 10 {
        let moving: Vec<usize> = (0..n).filter(|j| free[*j]).collect();
        if !moving.is_empty() {
            let mut held = p.clone();
            moving.iter().for_each(|j| held[*j] = 0.0);
            let wanted = -(a * &held + b);
            let solved = solve(a.select_columns(&moving), wanted)?;
            // Relative distance to the first bound along the step.
            let mut share = 1.0;
            let mut first = None;
            for (&j, to) in moving.iter().zip(solved.iter()) {
                let beyond = if *to < lower[j] { lower[j] } else { upper[j] };
                if (*to < lower[j] || *to > upper[j]) && (beyond - p[j]) / (to - p[j]) < share {
                    share = ((beyond - p[j]) / (to - p[j])).max(0.0);
                    first = Some((j, beyond));
                }
            }
            for (&j, to) in moving.iter().zip(solved.iter()) {
                p[j] = (p[j] + share * (to - p[j])).clamp(lower[j], upper[j]);
            }
            if let Some((j, bound)) = first {
                p[j] = bound;
                free[j] = false;
                continue;
            }
        }
        // Free the fixed variable with the largest gain.
        let inward = (0..n).filter(|j| !free[*j] && lower[*j] < upper[*j]).filter_map(|j| {
            let (outward, least) = outward(j, &p);
            (outward < -least).then_some((j, outward / a.column(j).norm()))
        });
        match inward.min_by(|x, y| x.1.total_cmp(&y.1)) {
            Some((j, _)) => free[j] = true,
            None => break,
        }
    }
    Some(p)
}

/// Solves the unbounded problem by QR decomposition.
fn solve(a: DMatrix<f64>, mut b: DVector<f64>) -> Option<DVector<f64>> {
    let n = a.ncols();
    let qr = a.qr();
    qr.q_tr_mul(&mut b);
    let solved = qr.r().solve_upper_triangular(&b.rows(0, n).into_owned())?;
    solved.iter().all(|value| value.is_finite()).then_some(solved)
}

#[cfg(test)]
mod tests;
