//! What all sources do together, and what compensation leaves of it, for machines.

use abbe::analysis::RemainingErrors;
use serde::Serialize;

use super::super::report::Report;
use crate::number::Named;

/// Further figures of `combined`.
#[derive(Serialize)]
pub(super) struct Together {
    rms: Rms,
    standard_deviation: [f64; 3],
    standard_radius: f64,
    worst_case: [f64; 3],
    worst_case_radius: f64,
    ellipsoid: Ellipsoid,
    enclosing_sphere: Sphere,
}

#[derive(Serialize)]
struct Rms {
    repeatable: f64,
    random: f64,
    both: f64,
}

/// The longest of the 95 % ellipsoids.
#[derive(Serialize)]
struct Ellipsoid {
    semi_axes: [f64; 3],
    axes: [[f64; 3]; 3],
    worst: Named,
}

#[derive(Serialize)]
struct Sphere {
    centre: [f64; 3],
    radius: f64,
    /// By how much the smallest may be smaller.
    excess: f64,
}

#[derive(Serialize)]
pub(super) struct Compensated {
    residual: f64,
    residual_sum: f64,
    total: f64,
}

pub(super) fn of(report: &Report) -> Together {
    let combined = &report.budget.combined;
    let [repeatable, random, both] = combined.rms;
    let (ellipsoid, sphere) = (&combined.ellipsoid, &combined.enclosing);
    Together {
        rms: Rms { repeatable, random, both },
        standard_deviation: combined.standard_deviation,
        standard_radius: combined.standard_radius.value,
        worst_case: combined.worst_case,
        worst_case_radius: combined.worst_case_radius.value,
        ellipsoid: Ellipsoid {
            semi_axes: ellipsoid.semi_axes,
            axes: ellipsoid.principal.axes.map(|axis| axis.map(|value| value + 0.0)),
            worst: report.variables(report.configuration(ellipsoid.configuration)),
        },
        enclosing_sphere: Sphere {
            centre: sphere.centre.map(|value| value + 0.0),
            radius: sphere.radius,
            excess: sphere.excess,
        },
    }
}

pub(super) fn compensated(compensation: &RemainingErrors) -> Compensated {
    Compensated {
        residual: compensation.residual.value,
        residual_sum: compensation.residual_sum.value,
        total: compensation.total.value,
    }
}
