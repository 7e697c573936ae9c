//! Numerical differentiation, to verify analytic derivatives.

/// Number of steps, each half the one before.
const LEVELS: i32 = 10;

/// Returns the derivative of `f` at 0 by Ridders' method: central differences at `step`,
/// `step / 2`, … extrapolated to a step of zero until rounding errors dominate.
///
/// `f` and its argument should be of order 1. `f` returns `None` where it is undefined; such steps
/// are skipped as too long. Returns `None` if `f` is undefined at all steps.
pub(super) fn derivative(step: f64, f: impl Fn(f64) -> Option<[f64; 6]>) -> Option<[f64; 6]> {
    let mut coarser: Vec<[f64; 6]> = Vec::new();
    let (mut best, mut uncertainty) = (None, f64::INFINITY);
    for level in 0..LEVELS {
        let h = step / f64::from(1 << level);
        let (Some(after), Some(before)) = (f(h), f(-h)) else {
            coarser.clear();
            continue;
        };
        let mut finer = vec![zip(after, before, |after, before| (after - before) / (2.0 * h))];
        let mut power = 1.0;
        for (k, coarse) in coarser.iter().enumerate() {
            // The error of column k falls with h^(2k+2).
            power *= 4.0;
            let fine = finer[k];
            let better = zip(fine, *coarse, |fine, coarse| fine + (fine - coarse) / (power - 1.0));
            let change = largest_change(better, fine).max(largest_change(better, *coarse));
            if change <= uncertainty {
                (best, uncertainty) = (Some(better), change);
            }
            finer.push(better);
        }
        let diverging = match (finer.last(), coarser.last()) {
            (Some(fine), Some(coarse)) => largest_change(*fine, *coarse) > 2.0 * uncertainty,
            _ => false,
        };
        if uncertainty < 1e-13 || diverging && level > 3 {
            break;
        }
        coarser = finer;
    }
    best
}

fn zip(a: [f64; 6], b: [f64; 6], f: impl Fn(f64, f64) -> f64) -> [f64; 6] {
    core::array::from_fn(|i| f(a[i], b[i]))
}

fn largest_change(a: [f64; 6], b: [f64; 6]) -> f64 {
    zip(a, b, |a, b| (a - b).abs()).into_iter().fold(0.0, f64::max)
}

#[cfg(test)]
mod tests;
