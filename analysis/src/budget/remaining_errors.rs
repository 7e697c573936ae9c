//! What is left after compensation.

use super::combined::Extreme;
use super::peak::Peak;
use super::sums::Sums;
use abbe_core::Scalar;
use abbe_core::lanes::{Lanes, Register};

/// What compensation leaves of a repeatable source.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Residual {
    /// This share of its error, with unknown sign: `f ‖r_k(q)‖`.
    Share(f64),
    /// An error of at most this norm, in the length unit, wherever there is one at all.
    Bound(f64),
}

/// What compensation leaves of all sources, and the total absolute accuracy, gathered configuration by
/// configuration. Random errors cannot be compensated: they remain as they are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RemainingErrors {
    /// max √(Σ ρ_k²) with the residuals ρ_k of the repeatable sources: their signs are unknown and independent.
    pub residual: Extreme,
    /// max Σ ρ_k: all in one direction.
    pub residual_sum: Extreme,
    /// max √(Σ ρ_k²) + ‖RSS random‖, the total as the paper adds it up.
    pub total: Extreme,
}

impl RemainingErrors {
    /// Of no configurations.
    pub(super) fn none() -> Self {
        Self::default()
    }

    /// Indices of the configurations that it names.
    pub(super) fn indices(&self) -> impl Iterator<Item = usize> {
        [self.residual, self.residual_sum, self.total].into_iter().filter_map(|extreme| extreme.configuration)
    }

    /// Takes in what follows.
    pub(super) fn merge(&mut self, other: &Self) {
        for (here, other) in [
            (&mut self.residual, other.residual),
            (&mut self.residual_sum, other.residual_sum),
            (&mut self.total, other.total),
        ] {
            if let Some(index) = other.configuration {
                here.add(index, other.value);
            }
        }
    }
}

/// Gathers [`RemainingErrors`] in lanes.
pub(super) struct Lane<R: Register> {
    square: Peak<R>,
    sum: Peak<R>,
    total: Peak<R>,
}

impl<R: Register> Lane<R> {
    pub(super) fn new() -> Self {
        Self { square: Peak::none(), sum: Peak::none(), total: Peak::none() }
    }

    /// Takes in the configurations of a tile, with the norm of each source.
    #[inline(always)]
    pub(super) fn add(&mut self, residuals: &[Option<Residual>], norm_of: &[Lanes<R>], sums: &Sums<R>) {
        let zero = Lanes::constant(0.0);
        let (mut sum, mut square) = (zero, zero);
        for (residual, norm) in residuals.iter().zip(norm_of) {
            let residual = match *residual {
                None => continue,
                Some(Residual::Share(share)) => *norm * Lanes::constant(share),
                // Wherever there is an error at all.
                Some(Residual::Bound(bound)) => norm.more_than(zero).select(Lanes::constant(bound), zero),
            };
            sum = sum + residual;
            square = residual.mul_add(residual, square);
        }
        self.square.add(square, sums.place);
        self.sum.add(sum, sums.place);
        self.total.add(square.sqrt() + sums.random_norm, sums.place);
    }

    pub(super) fn finish(self, index: impl Fn(usize) -> usize) -> RemainingErrors {
        let extreme = |peak: Peak<R>, f: fn(f64) -> f64| {
            let found = peak.finish().map(|(value, place)| (f(value), Some(index(place))));
            let (value, configuration) = found.unwrap_or_default();
            Extreme { value, configuration }
        };
        RemainingErrors {
            residual: extreme(self.square, f64::sqrt),
            residual_sum: extreme(self.sum, |sum| sum),
            total: extreme(self.total, |total| total),
        }
    }
}
