//! Variance of a fit between blocks of rows: regions of joint space, or runs of rows.
//!
//! Where the model lacks something, residuals of neighbouring rows agree, and the unknowns are less
//! certain than independent rows make them. With the scores `g_c = J_cᵀ r_c` of the configurations,
//! their sums `g_b` over blocks, `N = Σ J_cᵀ J_c + P` and `M = N⁻¹ Jᵀ J` of a block or
//! configuration,
//!
//! ```text
//! κ² = (Σ_b g_bᵀ N⁻¹ g_b / Σ_b t_b) / (Σ_c g_cᵀ N⁻¹ g_c / Σ_c t_c),   t = tr M − tr M²
//! ```
//!
//! is 1 in the mean for independent configurations, because residuals `(1 − H) e` of white noise
//! give `E gᵀ N⁻¹ g = σ² t`. It has about `(Σ_b tr M_b)² / Σ_b tr M_b²` degrees of freedom. The
//! part of the covariance that is due to the data is multiplied by κ², that of the prior is not.

use nalgebra::{DMatrix, DVector};

use super::{Configurations, Fit, Folds, Model, Observation, Result, f_beyond, linearize, with_priors};
use abbe_analysis::in_order;

/// Variance of a fit between blocks.
#[derive(Clone, Debug, PartialEq)]
pub struct BetweenBlocks {
    /// κ: ratio of the standard deviations to those of independent configurations.
    pub factor: f64,
    /// Probability of a ratio at least as large if configurations are independent.
    pub p: f64,
    /// Degrees of freedom of the variance between blocks.
    pub freedom: f64,
    /// Covariance of the kept unknowns with it.
    pub covariance: DMatrix<f64>,
}

/// Sums of a partition of the rows.
#[derive(Default)]
struct Sums {
    /// `Σ gᵀ N⁻¹ g`.
    squares: f64,
    /// `Σ tr M` and `Σ tr M²`.
    traces: [f64; 2],
}

impl Sums {
    /// Returns the variance of a number that the sums say.
    fn variance(&self) -> f64 {
        self.squares / (self.traces[0] - self.traces[1]).max(f64::MIN_POSITIVE)
    }
}

/// Compares the variance of a fit between blocks of its rows with that between configurations; none
/// with fewer than two blocks, or if the covariance is singular.
pub fn between_blocks(
    model: &Model,
    data: &[Observation],
    fit: &Fit,
    blocks: &Folds,
) -> Result<Option<BetweenBlocks>> {
    let (kept, x) = fit.of_kept(model);
    let p = x.len();
    let problem = with_priors(linearize(&kept, data, &x, Some(&fit.weights))?, &fit.prior, &x);
    let Some(l) = problem.half() else { return Ok(None) };
    let groups = Configurations::new(data).rows();
    let groups = groups.slices();
    let block = |block: usize| {
        let (mut at, mut sums) = (kept.at(&x), Sums::default());
        let (mut information, mut score) = (DMatrix::zeros(p, p), DVector::zeros(p));
        for rows in groups.iter().filter(|rows| blocks.fold[rows[0]] as usize == block) {
            let mut own: Vec<DVector<f64>> = Vec::new();
            let mut of_these = DVector::zeros(p);
            for i in rows.iter().copied().filter(|i| fit.weights[*i] > 0.0) {
                at.linear(&data[i], |residual, row| {
                    let weight = fit.weights[i].sqrt();
                    own.push(l.tr_mul(&DVector::from_column_slice(row)) * weight);
                    of_these.axpy(residual * weight, &own[own.len() - 1], 1.0);
                })?;
            }
            own.iter().for_each(|row| information.ger(1.0, row, row, 1.0));
            score += &of_these;
            sums.squares += of_these.norm_squared();
            sums.traces[0] += own.iter().map(DVector::norm_squared).sum::<f64>();
            let products = own.iter().flat_map(|a| own.iter().map(|b| a.dot(b).powi(2)));
            sums.traces[1] += products.sum::<f64>();
        }
        Ok((information, score, sums))
    };
    let (mut between, mut sums) = (Sums::default(), Sums::default());
    in_order(blocks.count, block, |(information, score, own): (DMatrix<f64>, DVector<f64>, Sums)| {
        between.squares += score.norm_squared();
        between.traces[0] += information.trace();
        between.traces[1] += information.norm_squared();
        sums.squares += own.squares;
        (0..2).for_each(|i| sums.traces[i] += own.traces[i]);
    })?;
    let (square, [trace, traces]) = (between.variance() / sums.variance(), between.traces);
    if blocks.count < 2 || !square.is_finite() {
        return Ok(None);
    }
    let freedom = trace * trace / traces;
    let prior = &fit.prior * &l;
    let of_prior = &l * prior.tr_mul(&prior) * l.transpose();
    let covariance = &fit.covariance * square - of_prior * (square - 1.0);
    let within = sums.traces[0].powi(2) / sums.traces[1];
    Ok(Some(BetweenBlocks {
        factor: square.sqrt(),
        p: f_beyond(square, freedom, within),
        freedom,
        covariance,
    }))
}
