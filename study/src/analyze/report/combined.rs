//! The position errors of all sources together.

use abbe::analysis::{Combined, Sphere};
use serde::Serialize;

use super::error_sites::ErrorSites;
use crate::number::Named;

/// Errors of all sources together over the workspace: position in the length unit, orientation in rad.
#[derive(Clone, Debug, Serialize)]
pub struct Radii {
    /// The largest norm of the sum of the repeatable sources.
    pub repeatable_radius: f64,
    /// The largest root sum of squares of the random sources at their bounds.
    pub random_radius: f64,
    /// The largest sum of both norms.
    pub radius: f64,
    /// The largest sum of the repeatable sources, row by row.
    pub repeatable: [f64; 3],
    /// The largest root sum of squares of the random sources, row by row.
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

/// Position errors of all sources together over the workspace, in the length unit.
#[derive(Clone, Debug, Serialize)]
pub struct CombinedReport {
    /// The errors as the paper adds them.
    #[serde(flatten)]
    pub radii: Radii,
    /// Configuration with the largest radius.
    pub worst: Named,
    /// Parameters of that configuration which the workspace moves.
    pub worst_parameters: Named,
    /// Root mean squares over the configurations.
    pub rms: RootMeanSquares,
    /// The largest standard deviation along x, y, z.
    pub standard_deviation: [f64; 3],
    /// The largest standard deviation of the position.
    pub standard_radius: f64,
    /// The largest sum of absolute values along x, y, z.
    pub worst_case: [f64; 3],
    /// The largest sum of the norms of all sources.
    pub worst_case_radius: f64,
    /// The longest of the 95 % ellipsoids.
    pub ellipsoid: LongestEllipsoid,
    /// The smallest sphere around the repeatable errors.
    pub enclosing_sphere: Sphere,
}

/// Root mean squares over the configurations of three norms.
#[derive(Clone, Debug, Serialize)]
pub struct RootMeanSquares {
    /// Of the repeatable sources.
    pub repeatable: f64,
    /// Of the random sources.
    pub random: f64,
    /// Of both, added.
    pub both: f64,
}

/// The longest of the 95 % ellipsoids.
#[derive(Clone, Debug, Serialize)]
pub struct LongestEllipsoid {
    /// Half its lengths, the largest first.
    pub semi_axes: [f64; 3],
    /// Their directions in `F_0`.
    pub axes: [[f64; 3]; 3],
    /// Configuration where it is.
    pub worst: Named,
}

impl CombinedReport {
    /// Names the configurations of what a budget has of all sources together.
    pub(in crate::analyze) fn new(combined: &Combined, sites: &ErrorSites) -> Self {
        let [repeatable, random, both] = combined.rms;
        let (ellipsoid, sphere) = (&combined.ellipsoid, combined.enclosing);
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
                // Never −0.
                axes: ellipsoid.principal.axes.map(|axis| axis.map(|value| value + 0.0)),
                worst: sites.variables(ellipsoid.configuration),
            },
            enclosing_sphere: Sphere { centre: sphere.centre.map(|value| value + 0.0), ..sphere },
        }
    }
}
