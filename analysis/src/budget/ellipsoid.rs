//! Covariance of the error of the tool point, and its 95 % ellipsoid.

use super::extreme::comparable;
use crate::{Measurand, Principal};
use abbe_core::{Distribution, Source};

/// The 95 % quantiles of χ² with one, two and three degrees of freedom, the rank of the covariance
/// Σ. A normal error satisfies `ΔXᵀ Σ⁻¹ ΔX ≤ χ²` with this probability. Their roots are 1.960,
/// 2.448 and 2.796.
pub const CHI_SQUARED_95: [f64; 3] = [3.841_458_820_694_124, 5.991_464_547_107_979, 7.814_727_903_251_179];

/// Returns the variance of a random error relative to the square of its bound: `a²/3` for a uniform
/// error with half-width a (GUM, 4.3.7), `a²/6` for a triangular one, `a²/2` for an arcsine one
/// with amplitude a, `(b/3)²` for a normal one with 3σ = b.
pub const fn variance(distribution: Distribution) -> f64 {
    1.0 / (distribution.divisor_squared() * distribution.bound() * distribution.bound())
}

/// Returns the block of a measurand of `J_e Σ J_eᵀ`: `Σ_k c_k b_k b_kᵀ` with the bound b and the
/// relative [`variance`] c of every random source. All effects of a source share one magnitude, so
/// its b is a single vector. The unit is the square of the measurand's.
///
/// `deviations` has the layout of [`Row::sources`](crate::Row::sources): ΔX of each source, its
/// bound for a random one.
pub fn covariance(sources: &[Source], deviations: &[[f64; 6]], measurand: Measurand) -> [[f64; 3]; 3] {
    let mut sum = [[0.0; 3]; 3];
    for (source, b) in sources.iter().zip(deviations) {
        let Some(distribution) = source.class.distribution() else { continue };
        let (b, c) = (measurand.rows(b), variance(distribution));
        for i in 0..3 {
            for j in 0..3 {
                sum[i][j] += c * b[i] * b[j];
            }
        }
    }
    sum
}

/// Region that contains a normal error with 95 % probability.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Ellipsoid {
    /// Semi-axes `√(χ² λ_i)`, the longest first, in the length unit. χ² is that of the rank.
    pub semi_axes: [f64; 3],
    /// Principal axes of the covariance: standard deviations √λ_i, and directions in `F_0`.
    pub principal: Principal,
    /// Index of the configuration. `None` without random errors.
    pub configuration: Option<usize>,
}

impl Ellipsoid {
    /// Takes in the ellipsoid at a later configuration, and keeps the longer one.
    pub(super) fn add(&mut self, other: &Self) {
        if comparable(other.principal.deviations[0]) > comparable(self.principal.deviations[0]) {
            *self = *other;
        }
    }

    /// Creates the ellipsoid of a covariance at a configuration.
    pub fn new(covariance: [[f64; 3]; 3], configuration: usize) -> Self {
        let principal = Principal::new(covariance);
        let factor = principal.rank().checked_sub(1).map_or(0.0, |i| CHI_SQUARED_95[i].sqrt());
        let semi_axes = principal.deviations.map(|deviation| factor * deviation);
        Self { semi_axes, principal, configuration: Some(configuration) }
    }

    /// Returns the dimension: 3, 2 for a flat ellipsoid, 1 for a line, 0 without errors.
    pub fn rank(&self) -> usize {
        self.principal.rank()
    }
}
