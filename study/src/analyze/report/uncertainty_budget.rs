//! Uncertainty budget of a workspace, after the GUM.

use abbe::Distribution;
use abbe::analysis::{COVERAGE, Compliance, Contribution, Measurand, Statement};
use abbe_spec::{Source, Spec};
use serde::{Serialize, Serializer};

use super::source_report::{ErrorSites, Quantity, SourceValue};
use crate::number::Named;

/// Uncertainty budget at the configuration with the largest combined standard uncertainty of the
/// norm. Arrays hold three rows and the norm; lengths are in the spec's unit, angles in rad.
#[derive(Clone, Debug, Serialize)]
pub struct UncertaintyBudget {
    /// Position or orientation.
    #[serde(skip)]
    pub measurand: Measurand,
    /// Index of the configuration in the workspace.
    #[serde(skip)]
    pub configuration: Option<usize>,
    /// Joint variables and varying inputs of the configuration.
    pub at: Named,
    /// Parameters of the configuration that vary over the workspace.
    pub at_parameters: Named,
    /// Random sources that contribute, largest share first.
    pub sources: Vec<SourceUncertainty>,
    /// Sum of the repeatable sources, with signs, and its norm.
    pub bias: [f64; 4],
    /// Combined standard uncertainties u.
    pub standard_uncertainty: [f64; 4],
    /// Effective degrees of freedom; infinite if all standard uncertainties are exact.
    #[serde(serialize_with = "crate::finite::or_null")]
    pub effective_degrees_of_freedom: [f64; 4],
    /// Coverage probability of U.
    pub coverage_probability: f64,
    /// Coverage factors k.
    pub coverage_factor: [f64; 4],
    /// Expanded uncertainties `U = k u`.
    pub expanded_uncertainty: [f64; 4],
    /// Probability that the deviation from the bias has a norm within U, with the actual
    /// distributions.
    pub coverage: Compliance,
}

/// Contribution of one random source. Arrays hold three rows and the norm. Lengths are in the
/// spec's unit, angles in rad.
#[derive(Clone, Debug, Serialize)]
pub struct SourceUncertainty {
    /// Name of the source.
    pub source: String,
    /// Distribution of its error.
    #[serde(serialize_with = "distribution")]
    pub distribution: Distribution,
    /// Value of the source in coherent units; `None` if it causes several errors, whose common
    /// factor is 1.
    pub value: Option<f64>,
    /// Quantity of the value.
    #[serde(skip)]
    pub quantity: Quantity,
    /// Divisor of the value: `u = value × sensitivity / divisor`.
    pub divisor: f64,
    /// Sensitivity `|∂ΔX / ∂value|`, in products of the units.
    pub sensitivity: [f64; 4],
    /// Standard uncertainties u.
    pub standard_uncertainty: [f64; 4],
    /// Degrees of freedom of the standard uncertainty; infinite if it is exact.
    #[serde(serialize_with = "crate::finite::or_null")]
    pub degrees_of_freedom: f64,
    /// Share of the variance of the norm, from 0 to 1.
    pub share: f64,
}

impl UncertaintyBudget {
    /// Creates the budget from a statement, with the names of sources and configuration.
    pub(in crate::analyze) fn new(
        statement: &Statement,
        configuration: Option<usize>,
        spec: &Spec,
        sites: &ErrorSites,
    ) -> Self {
        let all = spec.enabled_sources().collect::<Vec<_>>();
        let contributions = with_calibration_as_one(&statement.contributions, &all);
        let sources = contributions.iter().map(|one| SourceUncertainty::new(one, all[one.source], spec));
        Self {
            measurand: statement.measurand,
            configuration,
            at: sites.variables(configuration),
            at_parameters: sites.parameters(configuration),
            sources: sources.collect(),
            // Avoids −0.
            bias: statement.bias.map(|value| value + 0.0),
            standard_uncertainty: statement.standard,
            effective_degrees_of_freedom: statement.degrees_of_freedom,
            coverage_probability: COVERAGE,
            coverage_factor: statement.coverage_factors,
            expanded_uncertainty: statement.expanded(),
            coverage: statement.coverage,
        }
    }

    /// Returns true if any standard uncertainty has finite degrees of freedom.
    pub fn is_estimated(&self) -> bool {
        self.sources.iter().any(|one| one.degrees_of_freedom.is_finite())
    }
}

/// Returns the contributions with the independent parts of the calibration as one, largest share
/// first.
fn with_calibration_as_one(contributions: &[Contribution], sources: &[&Source]) -> Vec<Contribution> {
    let (parts, mut all): (Vec<_>, Vec<_>) =
        contributions.iter().cloned().partition(|one| sources[one.source].is_calibration_error());
    if let (Some(part), Some(source)) =
        (parts.first(), sources.iter().position(|one| one.is_calibration_error()))
    {
        let standard = [0, 1, 2, 3].map(|i| parts.iter().map(|part| part.standard[i].powi(2)).sum::<f64>());
        let standard = standard.map(f64::sqrt);
        let share = parts.iter().map(|part| part.share).sum();
        all.push(Contribution {
            source,
            value: None,
            sensitivity: standard,
            standard,
            share,
            ..part.clone()
        });
        all.sort_by(|a, b| b.share.total_cmp(&a.share));
    }
    all
}

impl SourceUncertainty {
    fn new(one: &Contribution, source: &Source, spec: &Spec) -> Self {
        let SourceValue { value, quantity } = SourceValue::new(spec, source, one);
        let divisor = one.distribution.divisor();
        Self {
            source: source.name.clone(),
            distribution: one.distribution,
            value: (quantity != Quantity::Multiple).then_some(value),
            quantity,
            divisor,
            sensitivity: one.standard.map(|u| u * divisor / value),
            standard_uncertainty: one.standard,
            degrees_of_freedom: one.degrees_of_freedom,
            share: one.share,
        }
    }
}

fn distribution<S: Serializer>(distribution: &Distribution, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(distribution.name())
}
