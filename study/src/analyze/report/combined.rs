//! Position errors of all sources together.
//!
//! Monte Carlo draws on the exact chain.
//!
//! Orientation errors of the sources: rows 4–6 and their norm, in rad.

use abbe::Orientation;
use abbe::analysis::{Budget, Combined, Figures, Measurand, MonteCarlo, SourceErrors};
use abbe_spec::Spec;
use serde::Serialize;

use super::source_report::{ErrorSite, ErrorSites};
use super::{JudgedShares, UncertaintyBudget};
use crate::number::Named;

/// Combined errors over the workspace, as the paper adds them. Position: along x, y, z of `F_0`, in
/// the length unit; orientation: rows 4–6, in rad. Each entry is the largest over the workspace.
#[derive(Clone, Debug, Serialize)]
pub struct Radii {
    /// Norm of the sum of the repeatable sources.
    pub repeatable_radius: f64,
    /// Norm of the root sum of squares of the random sources at their bounds.
    pub random_radius: f64,
    /// Sum of both norms at one configuration.
    pub radius: f64,
    /// Absolute value of the sum of the repeatable sources, row by row.
    pub repeatable: [f64; 3],
    /// Root sum of squares of the random sources, row by row.
    pub random: [f64; 3],
}

impl From<&Combined> for Radii {
    fn from(combined: &Combined) -> Self {
        Self {
            repeatable_radius: combined.repeatable_radius.value,
            random_radius: combined.random_radius.value,
            radius: combined.radius.value,
            repeatable: combined.repeatable,
            random: combined.random,
        }
    }
}

/// Combined position errors over the workspace, along x, y, z of `F_0`, in the length unit.
#[derive(Clone, Debug, Serialize)]
pub struct CombinedReport {
    /// Errors as the paper adds them.
    #[serde(flatten)]
    pub radii: Radii,
    /// Configuration with the largest radius: joint variables and varying inputs.
    pub worst: Named,
    /// Parameters of that configuration that vary over the workspace.
    pub worst_parameters: Named,
    /// Root mean squares of the norms over the configurations.
    pub rms: RootMeanSquares,
    /// Largest standard deviations along x, y, z.
    pub standard_deviation: [f64; 3],
    /// Largest standard deviation of the position, √(trace of the covariance).
    pub standard_radius: f64,
    /// Largest errors along x, y, z over all signs: repeatable sources at their values, the others
    /// at their bounds.
    pub worst_case: [f64; 3],
    /// Largest norm over all signs.
    pub worst_case_radius: f64,
    /// Longest of the 95 % ellipsoids.
    pub ellipsoid: LongestEllipsoid,
}

/// Root mean squares of three norms over the configurations, in the length unit.
#[derive(Clone, Debug, Serialize)]
pub struct RootMeanSquares {
    /// Sum of the repeatable sources.
    pub repeatable: f64,
    /// Root sum of squares of the random sources at their bounds.
    pub random: f64,
    /// Sum of both norms.
    pub both: f64,
}

/// Longest of the 95 % ellipsoids of the random errors.
#[derive(Clone, Debug, Serialize)]
pub struct LongestEllipsoid {
    /// Semi-axes, longest first, in the length unit.
    pub semi_axes: [f64; 3],
    /// Directions of the semi-axes, unit vectors in `F_0`.
    pub axes: [[f64; 3]; 3],
    /// Configuration with this ellipsoid.
    pub worst: Named,
}

impl CombinedReport {
    /// Creates the report from a budget, with the names of configurations.
    pub(in crate::analyze) fn new(combined: &Combined, sites: &ErrorSites) -> Self {
        let [repeatable, random, both] = combined.rms;
        let ellipsoid = &combined.ellipsoid;
        let worst = combined.radius.configuration;
        Self {
            radii: combined.into(),
            worst: sites.variables(worst),
            worst_parameters: sites.parameters(worst),
            rms: RootMeanSquares { repeatable, random, both },
            standard_deviation: combined.standard_deviation,
            standard_radius: combined.standard_radius.value,
            worst_case: combined.worst_case,
            worst_case_radius: combined.worst_case_radius.value,
            ellipsoid: LongestEllipsoid {
                semi_axes: ellipsoid.semi_axes,
                // Avoids −0.
                axes: ellipsoid.principal.axes.map(|axis| axis.map(|value| value + 0.0)),
                worst: sites.variables(ellipsoid.configuration),
            },
        }
    }
}

/// Errors drawn at the worst configuration and at home.
#[derive(Clone, Debug, Serialize)]
pub struct MonteCarloReport {
    /// Number of draws at each configuration.
    pub draws: usize,
    /// Seed of the draws.
    pub seed: u64,
    /// Errors at the configuration with the largest radius.
    pub worst: MonteCarloErrors,
    /// Errors at home.
    pub home: MonteCarloErrors,
}

/// Errors drawn at one configuration.
#[derive(Clone, Debug, Serialize)]
pub struct MonteCarloErrors {
    /// Joint variables and varying inputs of the configuration.
    pub at: Named,
    /// Parameters of the configuration that vary over the workspace.
    pub at_parameters: Named,
    /// Statistics of the errors.
    #[serde(flatten)]
    pub errors: MonteCarlo,
}

impl MonteCarloErrors {
    /// Adds the names of the configuration to its draws.
    pub(in crate::analyze) fn new(site: &ErrorSite, errors: MonteCarlo) -> Self {
        Self { at: site.variables.clone(), at_parameters: site.parameters.clone(), errors }
    }
}

impl MonteCarloReport {
    /// Returns both results, with their names.
    pub fn results(&self) -> [(&'static str, &MonteCarlo); 2] {
        [("worst", &self.worst.errors), ("home", &self.home.errors)]
    }
}

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
