//! The covariance of the tool point's error and its 95 % ellipsoid.

use crate::Measurand;
use crate::normal::Principal;
use abbe_core::{Class, Distribution, Source};

/// The 95 % quantiles of χ² with one, two and three degrees of freedom, the rank of the covariance Σ: a normal error is
/// within `ΔXᵀ Σ⁻¹ ΔX ≤ χ²` with this probability. Their roots are 1.960, 2.448 and 2.796.
pub const CHI_SQUARED_95: [f64; 3] = [3.841_458_820_694_124, 5.991_464_547_107_979, 7.814_727_903_251_179];

/// The variance of a random error, in squares of its bound: `a²/3` of a uniform one with half-width a (GUM,
/// 4.3.7), `a²/6` of a triangular one, `a²/2` of an arcsine one with amplitude a, `(b/3)²` of a normal one with 3σ = b.
pub const fn variance(distribution: Distribution) -> f64 {
    1.0 / (distribution.divisor_squared() * distribution.bound() * distribution.bound())
}

/// The block of a measurand of `J_e Σ J_eᵀ`: `Σ_k c_k b_k b_kᵀ` with the bound b of every random source and its
/// [`variance`] c. All effects of a source share one magnitude, and so its b is one vector. Squares of its unit.
///
/// `deviations` holds what [`Row::sources`](crate::Row::sources) does: ΔX of each source, of random ones the bound.
pub fn covariance(sources: &[Source], deviations: &[[f64; 6]], measurand: Measurand) -> [[f64; 3]; 3] {
    let mut sum = [[0.0; 3]; 3];
    for (source, b) in sources.iter().zip(deviations) {
        let Class::Random(distribution) = source.class else { continue };
        let (b, c) = (measurand.rows(b), variance(distribution));
        for i in 0..3 {
            for j in 0..3 {
                sum[i][j] += c * b[i] * b[j];
            }
        }
    }
    sum
}

/// The region that holds a normal error with 95 % probability.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Ellipsoid {
    /// Half its lengths `√(χ² λ_i)`, the largest first, in the length unit; χ² is that of the rank.
    pub semi_axes: [f64; 3],
    /// The covariance: its standard deviations √λ_i, and their directions in `F_0`.
    pub principal: Principal,
    /// Index of the configuration; none if there is no random error.
    pub configuration: Option<usize>,
}

impl Ellipsoid {
    /// Of a covariance at a configuration.
    pub fn new(covariance: [[f64; 3]; 3], configuration: usize) -> Self {
        let principal = Principal::new(covariance);
        let factor = principal.rank().checked_sub(1).map_or(0.0, |i| CHI_SQUARED_95[i].sqrt());
        let semi_axes = principal.deviations.map(|deviation| factor * deviation);
        Self { semi_axes, principal, configuration: Some(configuration) }
    }

    /// In how many directions there are errors: 3, 2 if it is flat, 1 if it is a line, 0 if there is none.
    pub fn rank(&self) -> usize {
        self.principal.rank()
    }
}
