//! The norm of a normal vector whose variance is estimated from few measurements.

use core::f64::consts::FRAC_1_PI;

use super::quadrature::{integral, root};
use super::vector::{NormalVector, Principal};

/// Bound of the error of [`StudentVector::within`].
const PROBABILITY_ERROR: f64 = 1e-9;
/// Degrees of freedom above which probabilities and quantiles are a parabola in 1/ν. The neglected
/// cubic term is 1e-10.
const MANY: f64 = 4e3;
/// u below which the integrand is linear up to the third order, and integrand below which the
/// integral is truncated.
const LINEAR: f64 = 1e-5;
const NEGLIGIBLE: f64 = 1e-13;
/// Length of a panel of the integral, in ln u.
const PART: f64 = 2.0;

/// Vector `T = X / √(W/ν)` with a normal X of mean 0 and an independent W distributed as χ² with ν
/// degrees of freedom: the multivariate Student's t-distribution. In one dimension it is the
/// distribution of a mean of few measurements.
///
/// ```
/// use abbe::analysis::StudentVector;
/// let line = [[1.0, 0.0, 0.0], [0.0; 3], [0.0; 3]];
/// assert!((StudentVector::new(line, 9.0).quantile(0.95) - 2.262_157).abs() < 1e-6);
/// assert!((StudentVector::new(line, f64::INFINITY).quantile(0.95) - 1.959_964).abs() < 1e-6);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StudentVector {
    covariance: [[f64; 3]; 3],
    /// Principal variances of X.
    variances: [f64; 3],
    degrees_of_freedom: f64,
}

impl StudentVector {
    /// Creates the vector from the covariance of X, symmetric and positive semidefinite, and ν > 0,
    /// which may be fractional or infinite.
    pub fn new(covariance: [[f64; 3]; 3], degrees_of_freedom: f64) -> Self {
        let variances = Principal::new(covariance).deviations.map(|deviation| deviation * deviation);
        Self { covariance, variances, degrees_of_freedom }
    }

    /// Returns the probability `P(‖T‖ ≤ radius)`, with an error below 1e-9.
    pub fn within(&self, radius: f64) -> f64 {
        match self.degrees_of_freedom {
            f64::INFINITY => NormalVector::new([0.0; 3], self.covariance).within(radius),
            _ if self.variances[0] == 0.0 => f64::from(u8::from(radius >= 0.0)),
            _ if radius <= 0.0 => 0.0,
            many if many > MANY => self.in_inverse_degrees(|vector| vector.within(radius)),
            few => self.inverted(radius, few),
        }
    }

    /// Returns the quantile of the norm for a probability between 0 and 1. Returns 0 for zero
    /// covariance.
    pub fn quantile(&self, probability: f64) -> f64 {
        let normal = NormalVector::new([0.0; 3], self.covariance).quantile(probability);
        if normal == 0.0 || self.degrees_of_freedom == f64::INFINITY {
            return normal;
        }
        if self.degrees_of_freedom > MANY {
            return self.in_inverse_degrees(|vector| vector.quantile(probability));
        }
        // The tails of T are heavier than those of X.
        let (mut low, mut high) = (normal, 2.0 * normal);
        while self.within(high) < probability {
            (low, high) = (high, 2.0 * high);
        }
        root(low, high, |radius| self.within(radius) - probability)
    }

    /// Interpolates a smooth function of 1/ν: `f = f_∞ + a x + b x²` with x = MANY/ν, through x = 1
    /// and x = 2.
    fn in_inverse_degrees(&self, f: impl Fn(&Self) -> f64) -> f64 {
        let at = |degrees_of_freedom: f64| f(&Self { degrees_of_freedom, ..*self });
        let normal = at(f64::INFINITY);
        let (one, two) = (at(MANY) - normal, at(MANY / 2.0) - normal);
        let (a, b) = (2.0 * one - two / 2.0, two / 2.0 - one);
        let x = MANY / self.degrees_of_freedom;
        normal + (a + b * x) * x
    }

    /// Inverts the characteristic function: `‖T‖ ≤ r` is equivalent to
    /// `Q = Σ λ_i Z_i² − (r²/ν) W ≤ 0`, and by Imhof (1961, equation 3.2)
    ///
    /// ```text
    /// P(Q > 0) = 1/2 + 1/π ∫₀^∞ sin θ(u) / (u ρ(u)) du
    /// θ(u) = ½ Σ h_j atan(λ_j u),  ρ(u) = Π (1 + λ_j² u²)^(h_j/4),  λ_4 = −r²/ν with h_4 = ν, the others with h_j = 1
    /// ```
    ///
    /// The integration variable is ln u, with r = 1.
    fn inverted(&self, radius: f64, degrees_of_freedom: f64) -> f64 {
        let [a, b, c] = self.variances.map(|variance| variance / radius / radius);
        let weights = [(a, 1.0), (b, 1.0), (c, 1.0), (-1.0 / degrees_of_freedom, degrees_of_freedom)];
        let along = |u: f64| {
            let (mut phase, mut decay) = (0.0, 0.0);
            for (weight, degrees) in weights {
                let angle = weight * u;
                phase += 0.5 * degrees * angle.atan();
                decay += 0.25 * degrees * (angle * angle).ln_1p();
            }
            (phase, decay)
        };
        let begin = LINEAR / (a + b + c + 1.0);
        let first = begin.ln();
        let least = -NEGLIGIBLE.ln();
        let mut last = first;
        while along(last.exp()).1 < least {
            last += PART;
        }
        let integrand = |logarithm: f64| {
            let (phase, decay) = along(logarithm.exp());
            phase.sin() * (-decay).exp()
        };
        let parts = ((last - first) / PART).round() as usize;
        let part = |i: usize| {
            let from = first + i as f64 * PART;
            integral(&integrand, from, from + PART, PROBABILITY_ERROR / 30.0)
        };
        // θ(u)/u near 0.
        let below = 0.5 * (a + b + c - 1.0) * begin;
        let sum = below + (0..parts).map(part).sum::<f64>();
        (0.5 - FRAC_1_PI * sum).clamp(0.0, 1.0)
    }
}
