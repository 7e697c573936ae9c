//! Probability that a tolerance is met.

use super::error_distribution::{Compliance, ErrorDistribution};
use super::errors_at::{ErrorsAt, RandomError, covariance};
use crate::Measurand;
use crate::normal::{NormalVector, PROBABILITY_ERROR};

/// Computes the probability that `‖Σ r_k + Σ t_k a_k‖ ≤ limit`, with the magnitudes a and the
/// errors t of the random sources. If these are all normal with known standard deviations, or there
/// are none, it is the integral of [`NormalVector`]. Otherwise it is estimated by
/// [`DRAWS`](super::DRAWS) draws, which depend on the seed alone.
pub fn compliance(errors: &ErrorsAt, measurand: Measurand, limit: f64, seed: u64) -> Compliance {
    within(errors.bias(measurand), &errors.random(measurand), limit, seed)
}

/// Computes the probability as if all random sources were normal with the same standard
/// uncertainties. It is exact if they are, close for a sum of many, and much faster.
pub fn normal_compliance(errors: &ErrorsAt, measurand: Measurand, limit: f64) -> Compliance {
    integrated(errors.bias(measurand), &errors.random(measurand), limit)
}

fn integrated(bias: [f64; 3], random: &[RandomError], limit: f64) -> Compliance {
    let probability = NormalVector::new(bias, covariance(random)).within(limit);
    let error = if random.is_empty() { 0.0 } else { PROBABILITY_ERROR };
    Compliance { probability, error, draws: None }
}

pub(super) fn within(bias: [f64; 3], random: &[RandomError], limit: f64, seed: u64) -> Compliance {
    ErrorDistribution::new(bias, random.to_vec()).coverage(limit, seed).0
}
