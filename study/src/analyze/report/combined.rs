//! Position errors of all sources together.

use abbe::analysis::Combined;
use serde::Serialize;

use super::error_sites::ErrorSites;
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
