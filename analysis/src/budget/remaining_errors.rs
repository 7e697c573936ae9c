//! Errors that remain after compensation.

use super::combined::Extreme;
use super::peak::Peak;
use super::sums::Sums;
use abbe_core::Scalar;
use abbe_core::lanes::{Lanes, Register};

/// Error that remains of a repeatable source after compensation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Residual {
    /// Share of its error, with unknown sign: `f ‖r_k(q)‖`.
    Share(f64),
    /// Error of at most this norm, in the length unit, wherever the source has an error.
    Bound(f64),
}

/// Errors that remain of all sources after compensation, and the total absolute accuracy, as maxima
/// over the configurations. Random errors cannot be compensated and remain unchanged.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RemainingErrors {
    /// max √(Σ ρ_k²) with the residuals ρ_k of the repeatable sources, for unknown and independent
    /// signs.
    pub residual: Extreme,
    /// max Σ ρ_k, for residuals all in one direction.
    pub residual_sum: Extreme,
    /// max √(Σ ρ_k²) + ‖RSS random‖, the paper's total.
    pub total: Extreme,
}

impl RemainingErrors {
    /// Creates the result of no configurations.
    pub(super) fn none() -> Self {
        Self::default()
    }

    /// Returns the indices of the configurations in the result.
    pub(super) fn indices(&self) -> impl Iterator<Item = usize> {
        [self.residual, self.residual_sum, self.total].into_iter().filter_map(|extreme| extreme.configuration)
    }

    /// Merges the result of other configurations.
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

/// Accumulates [`RemainingErrors`] in lanes.
pub(super) struct RemainingErrorsAccumulator<R: Register> {
    square: Peak<R>,
    sum: Peak<R>,
    total: Peak<R>,
}

impl<R: Register> RemainingErrorsAccumulator<R> {
    pub(super) fn new() -> Self {
        Self { square: Peak::none(), sum: Peak::none(), total: Peak::none() }
    }

    /// Adds the configurations of a tile, given the norm of each source.
    #[inline(always)]
    pub(super) fn add(&mut self, residuals: &[Option<Residual>], norm_of: &[Lanes<R>], sums: &Sums<R>) {
        let zero = Lanes::constant(0.0);
        let (mut sum, mut square) = (zero, zero);
        for (residual, norm) in residuals.iter().zip(norm_of) {
            let residual = match *residual {
                None => continue,
                Some(Residual::Share(share)) => *norm * Lanes::constant(share),
                // Only where the source has an error.
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
