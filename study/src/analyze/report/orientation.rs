//! The orientation errors of the sources: rows 4–6 and their norm, rad.

use abbe::Orientation;
use abbe::analysis::{Budget, Figures, Measurand, SourceErrors};
use abbe_spec::Spec;
use serde::Serialize;

use super::combined::Radii;
use super::error_allowance::ErrorAllowance;
use super::error_sites::ErrorSites;
use super::uncertainty_budget::UncertaintyBudget;
use crate::number::Named;

/// Orientation errors over the workspace, rad.
#[derive(Clone, Debug, Serialize)]
pub struct OrientationReport {
    /// Names of rows 4–6.
    pub rows: [&'static str; 3],
    /// Each source alone.
    pub sources: Vec<OrientationSource>,
    /// All sources together, as the paper adds them.
    #[serde(flatten)]
    pub radii: Radii,
    /// The largest standard deviation, row by row.
    pub standard_deviation: [f64; 3],
    /// The largest standard deviation of the norm.
    pub standard_radius: f64,
    /// Configuration with the largest radius.
    pub worst: Named,
    /// The study's tolerance of the norm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// What this tolerance allows.
    #[serde(rename = "budget", skip_serializing_if = "Option::is_none")]
    pub allowance: Option<ErrorAllowance>,
    /// Uncertainty budget after the GUM; none if no random source turns the tool.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub uncertainty: Option<UncertaintyBudget>,
}

/// Orientation errors of one source over the workspace, rad.
#[derive(Clone, Debug, Serialize)]
pub struct OrientationSource {
    /// Name of the source.
    pub name: String,
    /// The largest error.
    pub plain_max: Figures,
    /// Half of what the error varies by.
    pub half_peak_to_peak: Figures,
    /// The largest difference from the error at home.
    pub relative_to_home: Figures,
    /// Root mean square of the norm over the configurations.
    pub rms: f64,
    /// Configuration with the largest norm.
    pub worst: Named,
}

impl OrientationReport {
    /// Names the sources and configurations of a budget.
    pub(in crate::analyze) fn new(
        budget: &Budget,
        spec: &Spec,
        sites: &ErrorSites,
        tolerance: Option<f64>,
        uncertainty: Option<UncertaintyBudget>,
    ) -> Self {
        let (sources, combined, _) = budget.errors(Measurand::Orientation);
        let sources = spec.enabled_sources().zip(sources).map(|(source, errors)| {
            let &SourceErrors { plain_max, half_peak_to_peak, relative_to_home, rms, worst, .. } = errors;
            let (name, worst) = (source.name.clone(), sites.variables(worst));
            OrientationSource { name, plain_max, half_peak_to_peak, relative_to_home, rms, worst }
        });
        Self {
            rows: match spec.orientation {
                Orientation::RotationVector => ["about x", "about y", "about z"],
                Orientation::EulerYzx => ["spin", "roll", "pitch"],
            },
            sources: sources.collect(),
            radii: combined.into(),
            standard_deviation: combined.standard_deviation,
            standard_radius: combined.standard_radius.value,
            worst: sites.variables(combined.radius.configuration),
            tolerance,
            allowance: tolerance
                .map(|tolerance| ErrorAllowance::new(budget, spec, Measurand::Orientation, tolerance)),
            uncertainty,
        }
    }
}
