//! What was drawn, for machines.

use abbe::analysis::MonteCarlo;
use serde::Serialize;

use super::super::report::{Drawn, Report};
use crate::number::Named;

#[derive(Serialize)]
pub(super) struct Shape {
    draws: usize,
    seed: u64,
    worst: Place,
    home: Place,
}

#[derive(Serialize)]
struct Place {
    at: Named,
    at_parameters: Named,
    quantiles: Vec<Quantile>,
    largest: f64,
    mean: [f64; 3],
    covariance: [[f64; 3]; 3],
    covariance_standard_error: [[f64; 3]; 3],
    first_order_covariance: [[f64; 3]; 3],
    #[serde(skip_serializing_if = "Option::is_none")]
    inside_ellipsoid: Option<f64>,
}

#[derive(Serialize)]
struct Quantile {
    probability: f64,
    value: f64,
    standard_error: f64,
}

pub(super) fn of(report: &Report, drawn: &Drawn) -> Shape {
    let place = |found: &MonteCarlo, configuration| {
        let plain = |matrix: [[f64; 3]; 3]| matrix.map(|row| row.map(|value| value + 0.0));
        let quantiles = found.quantiles.iter().map(|quantile| Quantile {
            probability: quantile.probability,
            value: quantile.value,
            standard_error: quantile.standard_error,
        });
        Place {
            at: report.variables(configuration),
            at_parameters: report.parameters(configuration),
            quantiles: quantiles.collect(),
            largest: found.largest,
            mean: found.mean.map(|value| value + 0.0),
            covariance: plain(found.covariance),
            covariance_standard_error: plain(found.standard_error),
            first_order_covariance: plain(found.first_order),
            inside_ellipsoid: found.inside_ellipsoid,
        }
    };
    Shape {
        draws: drawn.worst.draws,
        seed: drawn.seed,
        worst: place(&drawn.worst, report.configuration(report.budget.combined.radius.configuration)),
        home: place(&drawn.home, Some(&report.home)),
    }
}
