//! The uncertainty budget of a workspace, after the GUM.

use abbe::Distribution;
use abbe::analysis::{COVERAGE, Compliance, Contribution, Measurand, Statement};
use abbe_spec::{Source, Spec};
use serde::{Serialize, Serializer};

use super::error_sites::ErrorSites;
use super::source_value::{Quantity, SourceValue};
use crate::number::Named;

/// Uncertainty budget where the combined standard uncertainty of the norm is largest: three rows and the norm, lengths in the
/// spec's unit, angles in rad.
#[derive(Clone, Debug, Serialize)]
pub struct UncertaintyBudget {
    /// What it is about.
    #[serde(skip)]
    pub measurand: Measurand,
    /// Index of the configuration.
    #[serde(skip)]
    pub configuration: Option<usize>,
    /// The configuration.
    pub at: Named,
    /// Its parameters which the workspace moves.
    pub at_parameters: Named,
    /// The random sources that do something, the largest share first.
    pub sources: Vec<SourceUncertainty>,
    /// The sum of the repeatable sources.
    pub bias: [f64; 4],
    /// Combined standard uncertainties u.
    pub standard_uncertainty: [f64; 4],
    /// Effective degrees of freedom; infinite if all standard uncertainties are known.
    pub effective_degrees_of_freedom: [f64; 4],
    /// Probability that U is to cover.
    pub coverage_probability: f64,
    /// Coverage factors k.
    pub coverage_factor: [f64; 4],
    /// Expanded uncertainties `U = k u`.
    pub expanded_uncertainty: [f64; 4],
    /// The share of the errors whose norm is within U, about the bias.
    pub coverage: Compliance,
}

/// Contribution of one random source: figures are of three rows and their norm.
#[derive(Clone, Debug, Serialize)]
pub struct SourceUncertainty {
    /// Name of the source.
    pub source: String,
    /// Distribution of its error.
    #[serde(serialize_with = "distribution")]
    pub distribution: Distribution,
    /// Its value; none if it causes several errors: then it is a multiple of what the spec says.
    pub value: Option<f64>,
    /// The quantity that its value is.
    #[serde(skip)]
    pub quantity: Quantity,
    /// Divisor of the value: `u = value × sensitivity / divisor`.
    pub divisor: f64,
    /// `|∂ΔX / ∂value|`.
    pub sensitivity: [f64; 4],
    /// Standard uncertainties u.
    pub standard_uncertainty: [f64; 4],
    /// Degrees of freedom of the standard uncertainty; infinite if it is known.
    pub degrees_of_freedom: f64,
    /// Its share of the variance.
    pub share: f64,
}

impl UncertaintyBudget {
    /// Names the sources and the configuration of a statement.
    pub(in crate::analyze) fn new(
        statement: &Statement,
        configuration: Option<usize>,
        spec: &Spec,
        sites: &ErrorSites,
    ) -> Self {
        let all = spec.enabled_sources().collect::<Vec<_>>();
        let sources =
            statement.contributions.iter().map(|one| SourceUncertainty::new(one, all[one.source], spec));
        Self {
            measurand: statement.measurand,
            configuration,
            at: sites.variables(configuration),
            at_parameters: sites.parameters(configuration),
            sources: sources.collect(),
            // Never −0.
            bias: statement.bias.map(|value| value + 0.0),
            standard_uncertainty: statement.standard,
            effective_degrees_of_freedom: statement.degrees_of_freedom,
            coverage_probability: COVERAGE,
            coverage_factor: statement.coverage_factors,
            expanded_uncertainty: statement.expanded(),
            coverage: statement.coverage,
        }
    }

    /// Whether any standard uncertainty has a finite number of degrees of freedom.
    pub(in crate::analyze) fn is_estimated(&self) -> bool {
        self.sources.iter().any(|one| one.degrees_of_freedom.is_finite())
    }
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
