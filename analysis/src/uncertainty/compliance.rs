//! How likely a tolerance is met.

use super::errors_at::{ErrorsAt, RandomError, covariance, is_normal};
use crate::Measurand;
use crate::normal::{NormalVector, PROBABILITY_ERROR};
use crate::sampling::{norm, stream};
use crate::sweep::in_order;

/// How many draws are made where there is no other way.
pub const DRAWS: usize = 200_000;
/// How many draws come from one stream of random numbers.
const BLOCK: usize = 8192;

/// The probability that the norm of the error is within a limit at one configuration: the repeatable sources are as they
/// are, the random ones drawn, to first order.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Compliance {
    /// The probability.
    pub probability: f64,
    /// How far it may be off: a bound without draws, their standard error `√(p (1 − p)/N)` with them.
    pub error: f64,
    /// How many draws it rests on; none if it is an integral.
    pub draws: Option<usize>,
}

/// How likely `‖Σ r_k + Σ t_k a_k‖ ≤ limit` with the magnitudes a and errors t of the random sources. If these are all
/// normal with known standard deviations (or there are none) that is the integral of [`NormalVector`]; otherwise [`DRAWS`]
/// draws, which follow from the seed alone.
pub fn compliance(errors: &ErrorsAt, measurand: Measurand, limit: f64, seed: u64) -> Compliance {
    within(errors.bias(measurand), &errors.random(measurand), limit, seed)
}

/// The same as if all random sources were normal with these standard uncertainties: right if they are, near it if many are
/// added, and far quicker.
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
