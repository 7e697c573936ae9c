//! Gains: the decrease of the radius for each source made smaller.

use super::peak;
use super::sums::Sums;
use abbe_core::lanes::{Lanes, Register};
use abbe_core::{Class, Scalar};

/// Reduction of a source.
const PERCENT: f64 = 0.01;

/// Radius with each source reduced by one percent, over some configurations.
///
/// `ρ_k = max_q ‖Σ r − r_k/100‖ + ‖RSS‖` for a repeatable source; for a random one the root sum of
/// squares has `0.99 b_k`. The maximum is searched anew, since it may move.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Gains {
    remaining: Vec<f64>,
}

impl Gains {
    /// Creates the result of no configurations.
    pub(super) fn new(sources: usize) -> Self {
        Self { remaining: vec![0.0; sources] }
    }

    /// Merges the result of other configurations.
    pub(super) fn merge(&mut self, other: &Self) {
        for (remaining, other) in self.remaining.iter_mut().zip(&other.remaining) {
            *remaining = remaining.max(*other);
        }
    }

    /// Returns the number of sources.
    pub(super) fn len(&self) -> usize {
        self.remaining.len()
    }

    /// Returns the decrease of the radius for each source. Negative for a source that counteracts
    /// the others.
    pub(super) fn gains(self, radius: f64) -> Vec<f64> {
        self.remaining.into_iter().map(|remaining| radius - remaining).collect()
    }
}

/// Accumulates [`Gains`] in lanes.
pub(super) struct GainsAccumulator<R: Register> {
    remaining: Vec<Lanes<R>>,
    /// Smallest remaining radius in any lane.
    least: f64,
}

impl<R: Register> GainsAccumulator<R> {
    pub(super) fn new(sources: usize) -> Self {
        Self { remaining: vec![Lanes::constant(0.0); sources], least: 0.0 }
    }

    /// Adds the configurations of a tile, given the norm of each source.
    #[inline(always)]
    pub(super) fn add(&mut self, classes: &[Class], rows: &[Lanes<R>], norm_of: &[Lanes<R>], sums: &Sums<R>) {
        // Reducing one source adds at most its share to the radius.
        let at_most = sums.norms.mul_add(Lanes::constant(PERCENT), sums.radius);
        if !at_most.more_than(Lanes::constant(self.least)).any() {
            return;
        }
        let less = Lanes::constant(1.0 - (1.0 - PERCENT) * (1.0 - PERCENT));
        let (percent, zero) = (Lanes::constant(PERCENT), Lanes::constant(0.0));
        let mut least = f64::INFINITY;
        for (k, class) in classes.iter().enumerate() {
            let radius = match class {
                Class::Repeatable => {
                    let rest =
                        core::array::from_fn(|i| rows[6 * k + i].neg_mul_add(percent, sums.repeatable[i]));
                    peak::square(rest).sqrt() + sums.random_norm
                }
                // The squared norm of a root sum of squares is the sum of the squared norms.
                _ => {
                    let rest = (norm_of[k] * norm_of[k]).neg_mul_add(less, sums.random_square);
                    sums.repeatable_norm + rest.max(zero).sqrt()
                }
            };
            self.remaining[k] = radius.max(self.remaining[k]);
            least = least.min(peak::least(self.remaining[k]));
        }
        self.least = least;
    }

    pub(super) fn finish(self) -> Gains {
        Gains { remaining: self.remaining.into_iter().map(peak::largest).collect() }
    }
}
