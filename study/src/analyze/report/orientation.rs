//! Orientation errors of the sources: rows 4–6 and their norm, in rad.

use abbe::Orientation;
use abbe::analysis::{Budget, Figures, Measurand, SourceErrors};
use abbe_spec::Spec;
use serde::Serialize;

use super::combined::Radii;
use super::error_sites::ErrorSites;
use super::judged_shares::JudgedShares;
use super::uncertainty_budget::UncertaintyBudget;
use crate::number::Named;

/// Orientation errors over the workspace, in rad.
#[derive(Clone, Debug, Serialize)]
pub struct OrientationReport {
    /// Names of rows 4–6.
    pub rows: [&'static str; 3],
    /// Number of configurations at which these rows exist: all reached ones but those where Euler
    /// angles are singular.
    pub configurations: usize,
    /// Errors of each source alone.
    pub sources: Vec<OrientationSource>,
    /// Combined errors, as the paper adds them.
    #[serde(flatten)]
    pub radii: Radii,
    /// Largest norm over all signs.
    pub worst_case_radius: f64,
    /// Largest standard deviations, row by row.
    pub standard_deviation: [f64; 3],
    /// Largest standard deviation of the norm.
    pub standard_radius: f64,
    /// Configuration with the largest radius: joint variables and varying inputs.
    pub worst: Named,
    /// Tolerance of the norm, from the study.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// Factor for all sources at which the judged orientation error as built equals the tolerance;
    /// `None` without a tolerance or an error, or if a probability or yield is judged.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub factor_for_all: Option<f64>,
    /// Uncertainty budget after the GUM; `None` if no random source rotates the tool.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub uncertainty: Option<UncertaintyBudget>,
}

/// Orientation errors of one source alone over the workspace: rows 4–6 and their norm, in rad.
#[derive(Clone, Debug, Serialize)]
pub struct OrientationSource {
    /// Name of the source.
    pub name: String,
    /// Largest absolute error. Random sources count at their bounds.
    pub plain_max: Figures,
    /// Half of the peak-to-peak variation; of the norm, the norm of these halves.
    pub half_peak_to_peak: Figures,
    /// Largest difference from the error at home; `None` if the rows are singular at home.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relative_to_home: Option<Figures>,
    /// Root mean square of the norm over the configurations.
    pub rms: f64,
    /// Share of the source in the judged orientation error, as in the ledger.
    pub share: f64,
    /// Configuration with the largest norm.
    pub worst: Named,
}

impl OrientationReport {
    /// Creates the report from a budget, with the names of sources and configurations.
    pub(in crate::analyze) fn new(
        budget: &Budget,
        spec: &Spec,
        sites: &ErrorSites,
        (tolerance, judged): (Option<f64>, &JudgedShares),
        uncertainty: Option<UncertaintyBudget>,
    ) -> Self {
        let (sources, combined) = budget.errors(Measurand::Orientation);
        let sources = spec.whole_sources().zip(sources).zip(&judged.shares);
        let sources = sources.map(|((source, errors), share)| {
            let &SourceErrors { plain_max, half_peak_to_peak, relative_to_home, rms, worst, .. } = errors;
            let (name, worst) = (source.name.clone(), sites.variables(worst));
            let relative_to_home = budget.orientation.at_home.then_some(relative_to_home);
            let share = *share;
            OrientationSource { name, plain_max, half_peak_to_peak, relative_to_home, rms, share, worst }
        });
        Self {
            rows: match spec.orientation {
                Orientation::RotationVector => ["about x", "about y", "about z"],
                Orientation::EulerYzx => ["spin", "roll", "pitch"],
                Orientation::Iec61217 => ["yaw", "pitch", "roll"],
            },
            configurations: budget.orientation.configurations,
            sources: sources.collect(),
            radii: combined.into(),
            worst_case_radius: combined.worst_case_radius.value,
            standard_deviation: combined.standard_deviation,
            standard_radius: combined.standard_radius.value,
            worst: sites.variables(combined.radius.configuration),
            tolerance,
            factor_for_all: judged.factor_for_all,
            uncertainty,
        }
    }
}
