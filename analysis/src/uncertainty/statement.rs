//! The uncertainty budget of the GUM (JCGM 100:2008) at one configuration.

use super::compliance::{Compliance, within};
use super::errors_at::{ErrorsAt, RandomError, covariance};
use crate::Measurand;
use crate::normal::{Principal, StudentVector};
use abbe_core::{Component, Distribution};

/// The coverage probability of an expanded uncertainty.
pub const COVERAGE: f64 = 0.95;
/// `Φ⁻¹((1 + 0.95)/2)`.
const NORMAL_95: f64 = 1.959_963_984_540_054;

/// The half-width of 95 % of Student's t.
pub fn student_95(degrees_of_freedom: f64) -> f64 {
    match degrees_of_freedom {
        f64::INFINITY => NORMAL_95,
        few => StudentVector::new([[1.0, 0.0, 0.0], [0.0; 3], [0.0; 3]], few).quantile(COVERAGE),
    }
}

/// Welch (1947) and Satterthwaite (1946): a sum of squares `Σ v_k`, each with ν_k degrees of freedom, varies as one with
/// `1/ν = Σ (v_k/Σv)²/ν_k` does.
fn welch_satterthwaite(squares: &[(f64, f64)]) -> f64 {
    let sum: f64 = squares.iter().map(|(square, _)| square).sum();
    combined(squares.iter().map(|(square, degrees)| ((square / sum).powi(2), *degrees)))
}

/// The harmonic mean of the degrees of freedom, by shares of the sum: never more than what [`welch_satterthwaite`] gives, and more
/// cautious where a source with few of them is a large share. Shares are estimated, too: where that source happens to look
/// small the formula hardly counts its few degrees of freedom.
fn cautious(squares: &[(f64, f64)]) -> f64 {
    let sum: f64 = squares.iter().map(|(square, _)| square).sum();
    combined(squares.iter().map(|(square, degrees)| (square / sum, *degrees)))
}

/// `1 / Σ w_k/ν_k`.
fn combined(weights: impl Iterator<Item = (f64, f64)>) -> f64 {
    let inverse: f64 =
        weights.filter(|(_, degrees)| degrees.is_finite()).map(|(weight, degrees)| weight / degrees).sum();
    if inverse > 0.0 { 1.0 / inverse } else { f64::INFINITY }
}

/// Of the rows, and of the norm. How much U² of the norm changes with a variance λ_i along a principal axis is, to a good
/// approximation, in proportion to `1 + (1.960² − 1) λ_i/λ_1`: exactly where all λ_i are equal, and where there is one only.
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
        let along = principal.components(one.standard());
        let square = along.iter().zip(weights).map(|(u, weight)| weight * u * u).sum::<f64>();
        (square, one.degrees_of_freedom)
    });
    [row(0), row(1), row(2), cautious(&norm.collect::<Vec<_>>())]
}

/// What one random source contributes. Figures are of the three rows and of their norm.
#[derive(Clone, Debug, PartialEq)]
pub struct Contribution {
    /// Index of the source.
    pub source: usize,
    /// How its error is distributed; `u = value / divisor`.
    pub distribution: Distribution,
    /// Its value and which error that is, in rad or in the length unit, if one generalized error is all it causes here. What it
    /// causes otherwise has one magnitude, and its value is 1.
    pub value: Option<(Component, f64)>,
    /// `|∂ΔX / ∂value|`.
    pub sensitivity: [f64; 4],
    /// Standard uncertainties: sensitivity × value / divisor.
    pub standard: [f64; 4],
    /// Of its standard uncertainty: infinite if that is known.
    pub degrees_of_freedom: f64,
    /// Its share of the variance `u_x² + u_y² + u_z²`.
    pub share: f64,
}

/// What is stated of the error of the tool at one configuration: `U = k u` about the bias.
///
/// The budget covers the random sources. The repeatable ones are known: the GUM takes for granted that such errors are
/// corrected (3.2.4). As long as they are not they are a bias, and `|bias| + U` is stated (6.3.1, note; F.2.4.5).
#[derive(Clone, Debug, PartialEq)]
pub struct Statement {
    /// What it is about.
    pub measurand: Measurand,
    /// The random sources that do something, the largest share first.
    pub contributions: Vec<Contribution>,
    /// The sum of the repeatable sources: three rows and their norm, with signs.
    pub bias: [f64; 4],
    /// Combined standard uncertainties u: root sums of squares; of the norm `√(u_x² + u_y² + u_z²)`.
    pub standard: [f64; 4],
    /// Effective degrees of freedom ν: of the rows by Welch and Satterthwaite (GUM, G.4.1), not rounded; of the norm the
    /// harmonic mean by shares, a little fewer than that. Infinite if all standard uncertainties are known.
    pub degrees_of_freedom: [f64; 4],
    /// k of the rows is the 95 % quantile of Student's t with ν degrees of freedom, 1.960 if they are infinite; that of the
    /// norm is the 95 % quantile of the norm of a [`StudentVector`] with this covariance, over u: with infinite degrees of
    /// freedom 1.960 on a line, 1.731 of a round plane error, 1.614 of a round one in space.
    pub coverage_factors: [f64; 4],
    /// The share of the errors whose norm is within U, about the bias: [`COVERAGE`] if all sources are normal with known
    /// standard deviations, otherwise drawn as they are distributed (JCGM 101; estimated ones after Student's t, 6.4.9).
    pub coverage: Compliance,
}

impl Statement {
    /// Of the errors at a configuration. What is drawn follows from the seed.
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
            coverage: within([0.0; 3], &random, quantile, seed),
        }
    }

    /// `U = k u`.
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
    let standard = with_norm(one.standard().map(f64::abs));
    let unit = value.map_or(1.0, |(_, value)| value);
    Contribution {
        source: one.source,
        distribution: one.distribution,
        value,
        sensitivity: with_norm(one.magnitude.map(|a| a.abs() / unit)),
        standard,
        degrees_of_freedom: one.degrees_of_freedom,
        share: (standard[3] / all).powi(2),
    }
}

fn with_norm([x, y, z]: [f64; 3]) -> [f64; 4] {
    [x, y, z, x.hypot(y).hypot(z)]
}
