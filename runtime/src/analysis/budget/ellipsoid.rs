//! The covariance of the tool point's error and its 95 % ellipsoid.

use nalgebra::{Matrix3, SymmetricEigen};

use crate::{Class, Distribution, Source};

/// The 95 % quantile of χ² with three degrees of freedom: a normal error is within
/// `ΔXᵀ Σ⁻¹ ΔX ≤ χ²` with this probability.
pub const CHI_SQUARED_95: f64 = 7.814_727_903_251_179;

/// The variance of a random error, in squares of its bound: `a²/3` of a uniform one with half-width a (GUM,
/// 4.3.7), `(b/3)²` of a normal one with 3σ = b.
pub const fn variance(distribution: Distribution) -> f64 {
    match distribution {
        Distribution::Uniform => 1.0 / 3.0,
        Distribution::Normal => 1.0 / 9.0,
    }
}

/// Rows 1–3 of `J_e Σ J_eᵀ`: `Σ_k c_k b_k b_kᵀ` with the bound b of every random source and its
/// [`variance`] c. All effects of a source share one magnitude, and so its b is one vector. Squares of lengths.
///
/// `deviations` holds what [`Row::sources`](crate::analysis::Row::sources) does: ΔX of each source, of random ones the bound.
pub fn covariance(sources: &[Source], deviations: &[[f64; 6]]) -> [[f64; 3]; 3] {
    let mut sum = [[0.0; 3]; 3];
    for (source, b) in sources.iter().zip(deviations) {
        let Class::Random(distribution) = source.class else { continue };
        let c = variance(distribution);
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
pub struct Ellipsoid {
    /// Half its lengths `√(χ² λ_i)`, the largest first, in the length unit.
    pub semi_axes: [f64; 3],
    /// The directions of these, unit vectors in `F_0`.
    pub axes: [[f64; 3]; 3],
    /// Index of the configuration; none if there is no random error.
    pub configuration: Option<usize>,
}

impl Ellipsoid {
    /// Of a covariance at a configuration.
    pub fn new(covariance: [[f64; 3]; 3], configuration: usize) -> Self {
        let SymmetricEigen { eigenvectors, eigenvalues } = SymmetricEigen::new(Matrix3::from(covariance));
        let mut order = [0, 1, 2];
        order.sort_by(|&i, &j| eigenvalues[j].total_cmp(&eigenvalues[i]));
        Self {
            semi_axes: order.map(|i| (CHI_SQUARED_95 * eigenvalues[i].max(0.0)).sqrt()),
            axes: order.map(|i| eigenvectors.column(i).into_owned().into()),
            configuration: Some(configuration),
        }
    }
}
