//! The uncertainty budget of the GUM (JCGM 100:2008) at one configuration.

use super::compliance::{Compliance, within};
use super::errors_at::{ErrorsAt, RandomError, covariance};
use crate::analysis::Measurand;
use crate::analysis::normal::NormalVector;
use crate::{Component, Distribution};

/// The coverage probability of an expanded uncertainty.
pub const COVERAGE: f64 = 0.95;
/// `Φ⁻¹((1 + 0.95)/2)`.
const NORMAL_95: f64 = 1.959_963_984_540_054;

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
    /// k of the rows is 1.960; that of the norm is the 95 % quantile of the norm of a normal vector with this covariance, over u:
    /// 1.960 on a line, 1.731 of a round plane error, 1.614 of a round one in space.
    pub coverage_factors: [f64; 4],
    /// The share of the errors whose norm is within U, about the bias: [`COVERAGE`] if all sources are normal, otherwise
    /// drawn as they are distributed (JCGM 101).
    pub coverage: Compliance,
}

impl Statement {
    /// Of the errors at a configuration. What is drawn follows from the seed.
    pub fn new(errors: &ErrorsAt, measurand: Measurand, seed: u64) -> Self {
        let random = errors.random(measurand);
        let matrix = covariance(&random);
        let rows = [0, 1, 2].map(|i| matrix[i][i].sqrt());
        let standard = with_norm(rows);
        let quantile = NormalVector::new([0.0; 3], matrix).quantile(COVERAGE);
        let factor = if standard[3] > 0.0 { quantile / standard[3] } else { NORMAL_95 };
        let mut contributions =
            random.iter().map(|one| contribution(errors, one, standard[3])).collect::<Vec<_>>();
        contributions.sort_by(|a, b| b.share.total_cmp(&a.share));
        Self {
            measurand,
            contributions,
            bias: with_norm(errors.bias(measurand)),
            standard,
            coverage_factors: [NORMAL_95, NORMAL_95, NORMAL_95, factor],
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
        share: (standard[3] / all).powi(2),
    }
}

fn with_norm([x, y, z]: [f64; 3]) -> [f64; 4] {
    [x, y, z, x.hypot(y).hypot(z)]
}
