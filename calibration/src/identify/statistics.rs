//! Tests of nested models, and tail probabilities.

use nalgebra::DMatrix;

/// F-test of a model against one nested in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FTest {
    /// Statistic `F = ((c_0 − c_1)/k) / (c_1/f)`.
    pub f: f64,
    /// Number of added terms `k`.
    pub terms: usize,
    /// Residual degrees of freedom `f`.
    pub freedom: usize,
    /// p-value: probability of a larger `F` if the added terms are zero.
    pub p: f64,
}

/// Computes the F-test from the sums of squared residuals before and after adding `terms`, with
/// `freedom` residual degrees of freedom after.
pub fn f_test(before: f64, after: f64, terms: usize, freedom: usize) -> FTest {
    let (k, n) = (terms.max(1) as f64, freedom.max(1) as f64);
    let f = ((before - after).max(0.0) / k) / (after / n).max(1e-300);
    // P(F > f) = I_{n/(n + k f)}(n/2, k/2).
    FTest { f, terms, freedom, p: f_beyond(f, k, n) }
}

/// Returns the two-sided tail probability of Student's t: `I_{n/(n + t²)}(n/2, 1/2)`.
pub fn student_beyond(t: f64, freedom: f64) -> f64 {
    incomplete_beta(freedom / 2.0, 0.5, freedom / (freedom + t * t))
}

/// Returns the two-sided p-value of a sample standard deviation with `freedom` degrees of freedom,
/// if the true one is 1.
///
/// Wilson and Hilferty, 1931: `(χ²/n)^(1/3)` is nearly normal with mean `1 − 2/(9n)` and variance
/// `2/(9n)`.
pub fn deviation_beyond(sigma: f64, freedom: f64) -> f64 {
    let spread = 2.0 / (9.0 * freedom.max(1.0));
    let z = (sigma.powf(2.0 / 3.0) - (1.0 - spread)) / spread.sqrt();
    libm::erfc(z.abs() / core::f64::consts::SQRT_2)
}

/// Returns the upper tail probability of F with `k` and `n` degrees of freedom.
pub fn f_beyond(f: f64, k: f64, n: f64) -> f64 {
    incomplete_beta(n / 2.0, k / 2.0, n / (n + k * f.max(0.0)))
}

/// Scores of the magnitudes of a group of terms, one row for each independent configuration, before
/// and after its addition.
pub(super) struct Scores {
    pub(super) before: DMatrix<f64>,
    pub(super) after: DMatrix<f64>,
}

impl Scores {
    /// Tests whether the magnitudes of the group are zero.
    ///
    /// `left` is the number of configurations less the degrees of freedom used by other terms. With
    /// the sum s of the scores before and the scores U after, `F = sᵀ(UᵀU)⁻¹s / k` with k and `left
    /// − k` degrees of freedom. The variance of s is that of the scores after, whether or not the
    /// magnitudes are zero: scores before contain the effect itself, which in few rows hides it.
    pub(super) fn test(&self, left: f64) -> FTest {
        let terms = self.before.ncols();
        let sum = self.before.row_sum_tr();
        let root = self.after.tr_mul(&self.after).cholesky();
        let (k, n) = (terms.max(1) as f64, (left - terms as f64).max(1.0));
        let f = root.map_or(0.0, |root| sum.dot(&root.solve(&sum))) / k;
        FTest { f, terms, freedom: n as usize, p: f_beyond(f, k, n) }
    }
}

/// Computes the regularized incomplete beta function `I_x(a, b)` by its continued fraction
/// (Abramowitz and Stegun 26.5.8).
fn incomplete_beta(a: f64, b: f64, x: f64) -> f64 {
    if x <= 0.0 || x >= 1.0 {
        return x.clamp(0.0, 1.0);
    }
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - incomplete_beta(b, a, 1.0 - x);
    }
    let front =
        (libm::lgamma(a + b) - libm::lgamma(a) - libm::lgamma(b) + a * x.ln() + b * (1.0 - x).ln()).exp() / a;
    // Lentz's algorithm.
    let (mut c, mut d) = (1.0, 1.0 / (1.0 - (a + b) * x / (a + 1.0)));
    let mut fraction = d;
    for i in 1..300 {
        let m = f64::from(i);
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        d = 1.0 / (1.0 + even * d);
        c = 1.0 + even / c;
        fraction *= c * d;
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        d = 1.0 / (1.0 + odd * d);
        c = 1.0 + odd / c;
        let factor = c * d;
        fraction *= factor;
        if (factor - 1.0).abs() < 1e-14 {
            break;
        }
    }
    front * fraction
}

#[cfg(test)]
mod tests;
