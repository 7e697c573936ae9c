//! The norm of a normal vector in space.
//!
//! The principal axes of a covariance.

use core::f64::consts::{SQRT_2, TAU};

use abbe_kinematics::decompose::symmetric_eigen;
use nalgebra::{Matrix3, SymmetricEigen};

use super::quadrature::{integral, root};

/// Bound of the error of [`NormalVector::within`], if the mean is at most 10⁴ times the largest
/// standard deviation.
pub const PROBABILITY_ERROR: f64 = 1e-9;

/// Normal quantile `Φ⁻¹(0.95)`.
pub(crate) const ONE_SIDED_95: f64 = 1.644_853_626_951_473;
/// Standard deviations at which tails are truncated: the probability beyond is 3e-12.
const TAIL: f64 = 7.0;
/// Largest difference of the two rules of an integral; the result is far more accurate. The outer
/// tolerance allows for the noise of the inner integral.
const OUTER: f64 = 1e-9;
const INNER: f64 = 1e-10;

/// Normal vector `X = m + √λ_1 Z_1 a_1 + √λ_2 Z_2 a_2 + √λ_3 Z_3 a_3` with independent standard
/// normal Z, along the principal axes of its covariance. Some or all of the λ may be 0.
///
/// The square of its norm is `Σ (m_i + √λ_i Z_i)²`, whose distribution has no closed form. It is
/// integrated over the shorter axes, on which the integrand depends smoothly:
///
/// ```text
/// P_1(r) = Φ((r − m_1)/σ_1) − Φ((−r − m_1)/σ_1)
/// P_2(r) = ∫ φ_2(t) P_1(√(r² − t²)) dt                   (t = r cos θ where it comes near r: no root at the end)
/// P_3(r) = ∫ φ_3(t) P_2(√(r² − t²)) dt                   (P_2 is a function of the square)
/// ```
///
/// ```
/// use abbe::analysis::NormalVector;
/// let quantile = |variances: [f64; 3]| {
///     let [x, y, z] = variances;
///     NormalVector::new([0.0; 3], [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]]).quantile(0.95)
/// };
/// assert!((quantile([1.0, 0.0, 0.0]) - 1.959_964).abs() < 1e-6);
/// assert!((quantile([1.0, 1.0, 0.0]) - 2.447_747).abs() < 1e-6);
/// assert!((quantile([1.0, 1.0, 1.0]) - 2.795_483).abs() < 1e-6);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalVector {
    /// Mean along the principal axes, the longest first. Components are nonnegative, which changes
    /// no norm.
    mean: [f64; 3],
    pub(super) deviations: [f64; 3],
}

impl NormalVector {
    /// Creates the vector from its mean, and its covariance, symmetric and positive semidefinite.
    pub fn new(mean: [f64; 3], covariance: [[f64; 3]; 3]) -> Self {
        let principal = Principal::new(covariance);
        Self { mean: principal.components(mean).map(f64::abs), deviations: principal.deviations }
    }

    /// Returns the probability `P(‖X‖ ≤ radius)`, with an error below [`PROBABILITY_ERROR`].
    pub fn within(&self, radius: f64) -> f64 {
        self.three(radius).clamp(0.0, 1.0)
    }

    /// Returns the quantile of the norm for a probability between 0 and 1: `within(quantile(p))` is
    /// p to 2e-9, unless the covariance is zero.
    pub fn quantile(&self, probability: f64) -> f64 {
        let length = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let (mean, deviation) = (length(self.mean), length(self.deviations));
        if deviation == 0.0 {
            return mean;
        }
        root(0.0, mean + TAIL * deviation, |radius| self.within(radius) - probability)
    }

    /// Returns the part of an axis with significant density within a radius.
    fn range(&self, axis: usize, radius: f64) -> [f64; 2] {
        let (mean, reach) = (self.mean[axis], TAIL * self.deviations[axis]);
        [(mean - reach).max(-radius), (mean + reach).min(radius)]
    }

    /// Returns φ_i at a distance from its mean.
    fn density(&self, axis: usize, from_mean: f64) -> f64 {
        let deviation = self.deviations[axis];
        let z = from_mean / deviation;
        (-z * z / 2.0).exp() / (deviation * TAU.sqrt())
    }

    /// Returns the probability along the first axis.
    fn one(&self, radius: f64) -> f64 {
        let (mean, deviation) = (self.mean[0], self.deviations[0]);
        if deviation == 0.0 {
            return f64::from(u8::from(mean.abs() <= radius));
        }
        let unit = deviation * SQRT_2;
        (libm::erf((radius - mean) / unit) + libm::erf((radius + mean) / unit)) / 2.0
    }

    /// Returns the probability in the plane of the first two axes.
    fn two(&self, radius: f64) -> f64 {
        if self.deviations[1] == 0.0 {
            return self.remaining(1, radius).map_or(0.0, |rest| self.one(rest));
        }
        let [from, to] = self.range(1, radius);
        if from >= to {
            return 0.0;
        }
        if to < 0.9 * radius && from > -0.9 * radius {
            let along = |t: f64| self.density(1, t - self.mean[1]) * self.one(leg(radius, t));
            return integral(&along, from, to, self.error(INNER));
        }
        let along = |angle: f64| {
            // t − m without cancellation: r cos θ − m = (r − m) − 2 r sin²(θ/2).
            let from_mean = (radius - self.mean[1]) - 2.0 * radius * (angle / 2.0).sin().powi(2);
            let rest = radius * angle.sin();
            self.density(1, from_mean) * self.one(rest) * rest
        };
        let angle = |t: f64| (t / radius).clamp(-1.0, 1.0).acos();
        integral(&along, angle(to), angle(from), self.error(INNER))
    }

    /// Returns the probability in space.
    fn three(&self, radius: f64) -> f64 {
        if self.deviations[2] == 0.0 {
            return self.remaining(2, radius).map_or(0.0, |rest| self.two(rest));
        }
        let [from, to] = self.range(2, radius);
        if from >= to {
            return 0.0;
        }
        let along = |t: f64| self.density(2, t - self.mean[2]) * self.two(leg(radius, t));
        integral(&along, from, to, self.error(OUTER))
    }

    /// Returns the radius that remains in the plane perpendicular to a constant axis, or `None` if
    /// the mean along it exceeds the radius.
    fn remaining(&self, axis: usize, radius: f64) -> Option<f64> {
        (self.mean[axis] <= radius).then(|| leg(radius, self.mean[axis]))
    }

    /// Returns the tolerance of an integral, not below the rounding errors.
    fn error(&self, least: f64) -> f64 {
        let mean = self.mean.iter().fold(0.0_f64, |largest, m| largest.max(*m));
        least.max(1e-15 * mean / self.deviations[0])
    }
}

/// Returns `√(r² − t²)`.
fn leg(radius: f64, t: f64) -> f64 {
    ((radius - t) * (radius + t)).max(0.0).sqrt()
}

/// Relative variance below which an axis counts as constant: the error lies in a plane or on a
/// line.
pub const FLAT: f64 = 1e-12;

/// Principal axes of a covariance, the longest first.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Principal {
    /// Standard deviations along the axes. 0 along constant axes.
    pub deviations: [f64; 3],
    /// Directions of the axes, unit vectors.
    pub axes: [[f64; 3]; 3],
}

impl Principal {
    /// Decomposes a covariance, symmetric and positive semidefinite. If it is not finite, the
    /// deviations are infinite.
    pub fn new(covariance: [[f64; 3]; 3]) -> Self {
        let Some(SymmetricEigen { eigenvectors, eigenvalues }) = symmetric_eigen(Matrix3::from(covariance))
        else {
            return Self { deviations: [f64::INFINITY; 3], axes: Matrix3::identity().into() };
        };
        let mut order = [0, 1, 2];
        order.sort_by(|&i, &j| eigenvalues[j].total_cmp(&eigenvalues[i]));
        let least = FLAT * eigenvalues[order[0]];
        let deviation = |i: usize| if eigenvalues[i] > least { eigenvalues[i].sqrt() } else { 0.0 };
        Self {
            deviations: order.map(deviation),
            axes: order.map(|i| eigenvectors.column(i).into_owned().into()),
        }
    }

    /// Returns the number of axes with a variance, 0 to 3.
    pub fn rank(&self) -> usize {
        self.deviations.iter().filter(|deviation| **deviation > 0.0).count()
    }

    /// Returns the components of a vector along the axes.
    pub fn components(&self, vector: [f64; 3]) -> [f64; 3] {
        self.axes.map(|axis| axis.iter().zip(vector).map(|(a, v)| a * v).sum())
    }
}
