//! The uncertainty budget of the GUM (JCGM 100:2008) at one configuration.

use super::error_distribution::{COVERAGE, Compliance, ErrorDistribution};
use super::errors_at::{ErrorsAt, RandomError, covariance};
use crate::{Measurand, Principal, StudentVector};
use abbe_core::{Component, Distribution};

/// Normal coverage factor `Φ⁻¹((1 + 0.95)/2)`.
const NORMAL_95: f64 = 1.959_963_984_540_054;

/// Returns the coverage factor of Student's t-distribution for a two-sided probability; fewer than
/// one degree of freedom count as one.
pub fn student_factor(probability: f64, degrees_of_freedom: f64) -> f64 {
    let line = [[1.0, 0.0, 0.0], [0.0; 3], [0.0; 3]];
    StudentVector::new(line, degrees_of_freedom.max(1.0)).quantile(probability)
}

/// Returns the half-width of the 95 % interval of Student's t-distribution.
pub fn student_95(degrees_of_freedom: f64) -> f64 {
    match degrees_of_freedom {
        f64::INFINITY => NORMAL_95,
        few => student_factor(COVERAGE, few),
    }
}

/// Returns the effective degrees of freedom of a sum of squares `Σ v_k`, each with ν_k degrees of
/// freedom, by Welch (1947) and Satterthwaite (1946): `1/ν = Σ (v_k/Σv)²/ν_k`.
fn welch_satterthwaite(squares: &[(f64, f64)]) -> f64 {
    let sum: f64 = squares.iter().map(|(square, _)| square).sum();
    combined(squares.iter().map(|(square, degrees)| ((square / sum).powi(2), *degrees)))
}

/// Returns the harmonic mean of the degrees of freedom, weighted by shares of the sum. It is never
/// more than [`welch_satterthwaite`] returns, and more cautious where a source with few degrees of
/// freedom has a large share. Shares are estimates, too: the formula hardly counts the degrees of
/// freedom of a source whose share is underestimated.
fn cautious(squares: &[(f64, f64)]) -> f64 {
    let sum: f64 = squares.iter().map(|(square, _)| square).sum();
    combined(squares.iter().map(|(square, degrees)| (square / sum, *degrees)))
}

/// Returns `1 / Σ w_k/ν_k`.
fn combined(weights: impl Iterator<Item = (f64, f64)>) -> f64 {
    let inverse: f64 =
        weights.filter(|(_, degrees)| degrees.is_finite()).map(|(weight, degrees)| weight / degrees).sum();
    if inverse > 0.0 { 1.0 / inverse } else { f64::INFINITY }
}

/// Returns the effective degrees of freedom of the rows and of the norm. The derivative of U² of
/// the norm by a variance λ_i along a principal axis is approximately proportional to
/// `1 + (1.960² − 1) λ_i/λ_1`, exactly if all λ_i are equal or only one is nonzero.
pub(super) fn degrees_of_freedom(random: &[RandomError], covariance: [[f64; 3]; 3]) -> [f64; 4] {
    let principal = Principal::new(covariance);
    let [longest, ..] = principal.deviations;
    let weights = principal.deviations.map(|deviation| match longest {
        0.0 => 0.0,
        _ => 1.0 + (NORMAL_95 * NORMAL_95 - 1.0) * (deviation / longest).powi(2),
    });
    let row = |i: usize| {
        let squares = random.iter().map(|one| (one.standard()[i].powi(2), one.degrees_of_freedom));
        welch_satterthwaite(&squares.collect::<Vec<_>>())
    };
    let norm = random.iter().map(|one| {
        let along = one.standard_parts().map(|part| principal.components(part));
        let square =
            |along: [f64; 3]| along.iter().zip(weights).map(|(u, weight)| weight * u * u).sum::<f64>();
        (along.map(square).sum::<f64>(), one.degrees_of_freedom)
    });
    [row(0), row(1), row(2), cautious(&norm.collect::<Vec<_>>())]
}

/// Contribution of one random source. Arrays hold the three rows and their norm.
#[derive(Clone, Debug, PartialEq)]
pub struct Contribution {
    /// Index of the source.
    pub source: usize,
    /// Distribution of its error; `u = value / divisor`.
    pub distribution: Distribution,
    /// Component and value, in rad or in the length unit, if the source causes a single generalized
    /// error here. `None` if it causes several, which share one magnitude; the value in the budget
    /// is then 1.
    pub value: Option<(Component, f64)>,
    /// Sensitivity `|∂ΔX / ∂value|`.
    pub sensitivity: [f64; 4],
    /// Standard uncertainties: sensitivity × value / divisor.
    pub standard: [f64; 4],
    /// Degrees of freedom of its standard uncertainty. Infinite if that is known.
    pub degrees_of_freedom: f64,
    /// Share of the variance `u_x² + u_y² + u_z²`.
    pub share: f64,
}

/// Uncertainty statement for the error of the tool at one configuration: `U = k u` about the bias.
///
/// The budget covers the random sources. The repeatable ones are known: the GUM presumes that such
/// errors are corrected (3.2.4). Until they are, they form a bias, and `|bias| + U` is stated
/// (6.3.1, note; F.2.4.5).
#[derive(Clone, Debug, PartialEq)]
pub struct Statement {
    /// Position or orientation.
    pub measurand: Measurand,
    /// Random sources with a nonzero effect, the largest share first.
    pub contributions: Vec<Contribution>,
    /// Sum of the repeatable sources: three rows with signs, and their norm.
    pub bias: [f64; 4],
    /// Combined standard uncertainties u: root sums of squares. That of the norm is
    /// `√(u_x² + u_y² + u_z²)`.
    pub standard: [f64; 4],
    /// Effective degrees of freedom ν, not rounded. Those of the rows follow Welch and
    /// Satterthwaite (GUM, G.4.1); that of the norm is the harmonic mean by shares, which is
    /// slightly smaller. Infinite if all standard uncertainties are known.
    pub degrees_of_freedom: [f64; 4],
    /// Coverage factors k. Those of the rows are the 95 % quantiles of Student's t-distribution
    /// with ν degrees of freedom, 1.960 if ν is infinite. That of the norm is the 95 % quantile of
    /// the norm of a [`StudentVector`] with this covariance, divided by u: for infinite ν, 1.960
    /// for an error along a line, 1.731 for an isotropic error in a plane, 1.614 for an isotropic
    /// error in space.
    pub coverage_factors: [f64; 4],
    /// Coverage of U for the norm, about the bias: [`COVERAGE`] if all sources are normal with
    /// known standard deviations. Otherwise it is estimated by draws from the actual distributions
    /// (JCGM 101; Student's t-distribution for estimated ones, 6.4.9).
    pub coverage: Compliance,
}

impl Statement {
    /// States the uncertainty of the errors at a configuration. Draws depend on the seed alone.
    pub fn new(errors: &ErrorsAt, measurand: Measurand, seed: u64) -> Self {
        let random = errors.random(measurand);
        let matrix = covariance(&random);
        let standard = with_norm([0, 1, 2].map(|i| matrix[i][i].sqrt()));
        let degrees_of_freedom = degrees_of_freedom(&random, matrix);
        let [x, y, z, norm] = degrees_of_freedom;
        let quantile = StudentVector::new(matrix, norm).quantile(COVERAGE);
        let factor = if standard[3] > 0.0 { quantile / standard[3] } else { NORMAL_95 };
        let mut contributions =
            random.iter().map(|one| contribution(errors, one, standard[3])).collect::<Vec<_>>();
        contributions.sort_by(|a, b| b.share.total_cmp(&a.share));
        Self {
            measurand,
            contributions,
            bias: with_norm(errors.bias(measurand)),
            standard,
            degrees_of_freedom,
            coverage_factors: [student_95(x), student_95(y), student_95(z), factor],
            coverage: ErrorDistribution::new([0.0; 3], random.clone()).coverage(quantile, seed).0,
        }
    }

    /// Returns the expanded uncertainties `U = k u`.
    pub fn expanded(&self) -> [f64; 4] {
        core::array::from_fn(|i| self.coverage_factors[i] * self.standard[i])
    }
}

fn contribution(errors: &ErrorsAt, one: &RandomError, all: f64) -> Contribution {
    let effects = errors.description.effects.iter().zip(&errors.effects);
    let mut active = effects.filter(|(effect, value)| effect.source == one.source && **value != 0.0);
    let value = match (active.next(), active.next()) {
        (Some((effect, value)), None) => Some((effect.component, value.abs())),
        _ => None,
    };
    let standard = with_norm(one.standard());
    let unit = value.map_or(1.0, |(_, value)| value);
    Contribution {
        source: one.source,
        distribution: one.distribution,
        value,
        sensitivity: standard.map(|u| u * one.distribution.divisor() / unit),
        standard,
        degrees_of_freedom: one.degrees_of_freedom,
        share: (standard[3] / all).powi(2),
    }
}

fn with_norm([x, y, z]: [f64; 3]) -> [f64; 4] {
    [x, y, z, x.hypot(y).hypot(z)]
}
