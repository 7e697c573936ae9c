//! Probability that a tolerance is met.

use super::errors_at::{ErrorsAt, RandomError, covariance, is_normal};
use crate::Measurand;
use crate::normal::{NormalVector, PROBABILITY_ERROR};
use crate::sampling::{norm, stream};
use crate::sweep::in_order;

/// Number of draws for errors that are not normal.
pub const DRAWS: usize = 200_000;
/// Number of draws per stream of random numbers.
const BLOCK: usize = 8192;

/// Probability that the norm of the error is within a limit at one configuration, to first order:
/// the repeatable sources are fixed, the random ones vary.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Compliance {
    /// Probability.
    pub probability: f64,
    /// Error of the probability: a bound for an integral, the standard error `√(p (1 − p)/N)` for
    /// draws.
    pub error: f64,
    /// Number of draws. `None` for an integral.
    pub draws: Option<usize>,
}

/// Computes the probability that `‖Σ r_k + Σ t_k a_k‖ ≤ limit`, with the magnitudes a and the
/// errors t of the random sources. If these are all normal with known standard deviations, or there
/// are none, it is the integral of [`NormalVector`]. Otherwise it is estimated by [`DRAWS`] draws,
/// which depend on the seed alone.
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
    if is_normal(random) {
        return integrated(bias, random, limit);
    }
    let mut within = 0;
    let Ok(()) = in_order(
        DRAWS.div_ceil(BLOCK),
        |block| {
            let mut numbers = stream(seed, block);
            let drawn = (block * BLOCK..DRAWS.min((block + 1) * BLOCK)).filter(|_| {
                let mut error = bias;
                for one in random {
                    let t = one.draw(&mut numbers);
                    error = core::array::from_fn(|i| error[i] + t * one.magnitude[i]);
                }
                norm(error) <= limit
            });
            Ok::<_, core::convert::Infallible>(drawn.count())
        },
        |more| within += more,
    );
    let probability = within as f64 / DRAWS as f64;
    let error = (probability * (1.0 - probability) / DRAWS as f64).sqrt();
    Compliance { probability, error, draws: Some(DRAWS) }
}
