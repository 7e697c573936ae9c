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
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::bounded;
    use crate::sampling::halton;

    /// Compares the result with the best over all active sets.
    #[test]
    fn it_is_the_best_of_all_sets() {
        for seed in 0..200 {
            let value = |i: usize, j: usize| 2.0 * halton(1 + 100 * seed + i, j) - 1.0;
            let (m, n) = (6, 4);
            let a = DMatrix::from_fn(m, n, value);
            let b = DVector::from_fn(m, |i, _| 3.0 * value(i, 9));
            let lower: Vec<f64> = (0..n).map(|j| -value(j, 20).abs()).collect();
            let upper: Vec<f64> = (0..n).map(|j| value(j, 21).abs()).collect();
            let cost = |p: &DVector<f64>| (&a * p + &b).norm_squared();
            let mut best = f64::INFINITY;
            for set in 0..3_usize.pow(n as u32) {
                let place = |j: usize| set / 3_usize.pow(j as u32) % 3;
                let mut p = DVector::from_fn(n, |j, _| [lower[j], upper[j], 0.0][place(j)]);
                let free: Vec<usize> = (0..n).filter(|j| place(*j) == 2).collect();
                if !free.is_empty() {
                    let part = a.select_columns(&free);
                    let wanted = part.transpose() * -(&a * &p + &b);
                    let solved = (part.transpose() * &part).cholesky().unwrap().solve(&wanted);
                    free.iter().zip(solved.iter()).for_each(|(j, value)| p[*j] = *value);
                }
                if (0..n).all(|j| (lower[j]..=upper[j]).contains(&p[j])) {
                    best = best.min(cost(&p));
                }
            }
            let found = bounded(&a, &b, &lower, &upper).unwrap();
            assert!((0..n).all(|j| (lower[j]..=upper[j]).contains(&found[j])));
            assert!(cost(&found) <= best * (1.0 + 1e-12), "{seed}: {} and {best}", cost(&found));
        }
    }
}
