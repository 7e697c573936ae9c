//! What was drawn, for machines.

use abbe::analysis::MonteCarlo;
use serde::Serialize;

use super::super::{Analysis, Drawn};
use super::{parameters, variables};
use abbe_study::number::Named;

#[derive(Serialize)]
pub(super) struct Report {
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

pub(super) fn of(analysis: &Analysis, drawn: &Drawn) -> Report {
    let place = |found: &MonteCarlo, configuration| {
        let plain = |matrix: [[f64; 3]; 3]| matrix.map(|row| row.map(|value| value + 0.0));
        let quantiles = found.quantiles.iter().map(|quantile| Quantile {
            probability: quantile.probability,
            value: quantile.value,
            standard_error: quantile.standard_error,
        });
        Place {
            at: variables(analysis, &configuration),
            at_parameters: parameters(analysis, &configuration),
            quantiles: quantiles.collect(),
            largest: found.largest,
            mean: found.mean.map(|value| value + 0.0),
            covariance: plain(found.covariance),
            covariance_standard_error: plain(found.standard_error),
            first_order_covariance: plain(found.first_order),
            inside_ellipsoid: found.inside_ellipsoid,
        }
    };
    Report {
        draws: drawn.worst.draws,
        seed: drawn.seed,
        worst: place(&drawn.worst, analysis.configuration(analysis.budget.combined.radius.configuration)),
        home: place(&drawn.home, Some(analysis.workspace.home().clone())),
    }
}
