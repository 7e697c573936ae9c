//! The program (3) over given cuts: a primal-dual interior-point method in the logarithms of the
//! factors.

use nalgebra::{DMatrix, DVector};

/// Largest number of steps.
const STEPS: usize = 100;
/// Relative residual at which the iteration ends.
const END: f64 = 1e-13;
/// Relative excess of a cut that counts as none.
const HELD: f64 = 1e-11;
/// Largest step of a logarithm.
const STEP: f64 = 2.0;

/// Error source whose size can be chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScalableSource {
    /// Indicates that the sign of its errors is known.
    pub is_repeatable: bool,
    /// Indicates an error with several parts, which may have any direction.
    pub has_parts: bool,
    /// Index of the source whose factor it has; its own index for most.
    pub follows: usize,
    /// Cost c of the factor 1.
    pub cost: f64,
    /// Exponent p: the factor x costs `c x^(−p)`.
    pub exponent: f64,
    /// Smallest and largest factor; equal ones fix it.
    pub limits: [f64; 2],
}

impl ScalableSource {
    pub(super) fn cost_of(&self, factor: f64) -> f64 {
        self.cost * factor.powf(-self.exponent)
    }

    /// Returns `true` if the limits leave one factor.
    pub fn is_fixed(&self) -> bool {
        self.limits[0] >= self.limits[1]
    }
}

/// Returns the factors of all sources, and the multipliers λ of the cuts `a·x ≤ target`.
///
/// With `t = ln x`, cost and cuts are sums of exponential functions: a geometric program, convex in
/// t. Let `h(t) ≤ 0` be the cuts, followed by the limits `t ≤ ln u` and `t ≥ ln l`, and J the
/// Jacobian of h. Newton's method solves, for a decreasing μ,
///
/// ```text
/// −c p x^(−p) + Jᵀλ = 0      h(t) + s = 0      λ_i s_i = μ
/// ```
///
/// for t and λ together: nearly parallel cuts make the equations of t alone ill-conditioned. The
/// factors are then exactly stationary, `x_k = (c_k p_k / (λᵀA)_k)^(1/(p_k+1))`, within their
/// limits.
pub(super) fn minimize(
    sources: &[ScalableSource],
    cuts: &[(usize, Vec<f64>)],
    target: f64,
) -> (Vec<f64>, Vec<f64>) {
    // A source that follows another one has no slope of its own.
    let (free, fixed): (Vec<usize>, Vec<usize>) =
        (0..sources.len()).partition(|k| sources[*k].follows == *k && !sources[*k].is_fixed());
    let rest = |(_, cut): &(usize, Vec<f64>)| {
        target - fixed.iter().map(|k| cut[*k] * sources[*k].limits[0]).sum::<f64>()
    };
    let rest: Vec<f64> = cuts.iter().map(rest).collect();
    let (m, n) = (cuts.len(), free.len());
    let size = m + 2 * n;
    let slopes = DMatrix::from_fn(m, n, |i, j| cuts[i].1[free[j]] / rest[i]);
    let limit = |j: usize, side: usize| sources[free[j]].limits[side].ln();
    let slope = |j: usize, t: f64| sources[free[j]].exponent * sources[free[j]].cost_of(t.exp());
    let mut t = DVector::from_fn(n, |j, _| (limit(j, 0) + limit(j, 1)) / 2.0);
    let whole: f64 = (0..n).map(|j| slope(j, t[j])).sum();
    let mut s = DVector::from_element(size, 1.0);
    let mut multipliers = DVector::from_element(size, 1.0 / size as f64);
    for _ in 0..if m * n == 0 { 0 } else { STEPS } {
        let own = DVector::from_fn(n, |j, _| slope(j, t[j]) / whole);
        let jacobian = DMatrix::from_fn(size, n, |i, j| match i {
            i if i < m => slopes[(i, j)] * t[j].exp(),
            i => f64::from(i8::from(i == m + j) - i8::from(i == m + n + j)),
        });
        let primal = DVector::from_fn(size, |i, _| match i {
            i if i < m => jacobian.row(i).sum() - 1.0 + s[i],
            i if i < m + n => t[i - m] - limit(i - m, 1) + s[i],
            i => limit(i - m - n, 0) - t[i - m - n] + s[i],
        });
        let dual = jacobian.tr_mul(&multipliers) - &own;
        let gap = multipliers.dot(&s);
        let is_stationary = (0..n).all(|j| dual[j].abs() <= 10.0 * END * own[j]);
        if gap <= END * own.sum() && is_stationary && primal.amax() <= END {
            break;
        }
        let goal = 0.1 * gap / size as f64;
        let mut matrix = DMatrix::zeros(n + size, n + size);
        matrix.view_mut((n, 0), (size, n)).copy_from(&jacobian);
        matrix.view_mut((0, n), (n, size)).tr_copy_from(&jacobian);
        let pull = jacobian.rows(0, m).tr_mul(&multipliers.rows(0, m));
        (0..n).for_each(|j| matrix[(j, j)] = sources[free[j]].exponent * own[j] + pull[j]);
        (0..size).for_each(|i| matrix[(n + i, n + i)] = -s[i] / multipliers[i]);
        let complement = &s - multipliers.map(|multiplier| goal / multiplier) - &primal;
        let right = DVector::from_iterator(n + size, (-dual).iter().chain(&complement).copied());
        let Some(solution) = matrix.lu().solve(&right) else { break };
        let (step, by_multipliers) = (solution.rows(0, n), solution.rows(n, size));
        let by_s = -primal - jacobian * step;
        let share = |values: &DVector<f64>, steps: &[f64]| {
            let falling = values.iter().zip(steps).filter(|(_, step)| **step < 0.0);
            falling.fold(1.0_f64, |most, (value, step)| most.min(-0.995 * value / step))
        };
        let primal = share(&s, by_s.as_slice()).min(STEP / step.amax());
        let dual = share(&multipliers, &solution.as_slice()[n..]);
        t += primal * step;
        s += primal * by_s;
        multipliers += dual * by_multipliers;
    }
    let multipliers = whole * multipliers.rows(0, m);
    let pull = slopes.tr_mul(&multipliers);
    let scaled = |scale: f64| {
        let mut factors: Vec<f64> = sources.iter().map(|source| source.limits[0]).collect();
        for (pull, k) in pull.iter().zip(&free) {
            let source = &sources[*k];
            let stationary =
                (source.cost * source.exponent / (scale * pull)).powf(1.0 / (source.exponent + 1.0));
            factors[*k] = stationary.clamp(source.limits[0], source.limits[1]);
        }
        factors
    };
    // Where an optimal factor is just at its limit, λ is exact to half of the digits: the cuts hold
    // for slightly larger ones.
    let exceeds = |scale: f64| {
        let factors = scaled(scale);
        cuts.iter()
            .any(|(_, cut)| cut.iter().zip(&factors).map(|(a, x)| a * x).sum::<f64>() > target * (1.0 + HELD))
    };
    let (mut below, mut scale) = (1.0, 1.0);
    for step in (0..20).map(|k| END * 4.0_f64.powi(k)) {
        if exceeds(scale) {
            (below, scale) = (scale, 1.0 + step);
        }
    }
    for _ in 0..if scale > 1.0 { 60 } else { 0 } {
        let middle = f64::midpoint(below, scale);
        if exceeds(middle) { below = middle } else { scale = middle }
    }
    let multipliers = multipliers.iter().zip(rest).map(|(multiplier, rest)| scale * multiplier / rest);
    (scaled(scale), multipliers.collect())
}
