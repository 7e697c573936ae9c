//! Configurations at which a tolerance is least likely to be met, by a fast approximation.

use super::sums::Sums;
use abbe_core::Scalar;
use abbe_core::lanes::{Lanes, Register};

/// Number of configurations kept.
const KEPT: usize = 32;
/// Smallest significant variance, relative to the square of the tolerance.
const NONE: f64 = 1e-24;

/// Configurations at which a tolerance T is least likely to be met, the least likely first.
///
/// The squared norm of an error with mean b and covariance C has the mean `κ_1 = |b|² + tr C` and
/// the variance `κ_2 = 2 tr C² + 4 bᵀ C b`. Its root is nearly normal, with the mean
/// `√(κ_1 − κ_2/(4 κ_1))` and the standard deviation `√κ_2 / (2 √κ_1)`. Configurations are ranked
/// by the distance of T from that mean in standard deviations.
#[derive(Clone, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct LeastLikely(Vec<(f64, usize)>);

impl LeastLikely {
    fn add(&mut self, deviations: f64, index: usize) {
        let after = self.0.partition_point(|kept| (kept.0, kept.1) < (deviations, index));
        if after < KEPT {
            self.0.truncate(KEPT - 1);
            self.0.insert(after, (deviations, index));
        }
    }

    /// Merges the result of other configurations.
    pub(super) fn merge(&mut self, other: &Self) {
        other.0.iter().for_each(|(deviations, index)| self.add(*deviations, *index));
    }

    /// Returns the indices of the configurations.
    pub(super) fn indices(&self) -> impl Iterator<Item = usize> {
        self.0.iter().map(|(_, index)| *index)
    }

    /// Returns the indices of the configurations, the least likely first.
    pub(super) fn finish(self) -> Vec<usize> {
        self.0.into_iter().map(|(_, index)| index).collect()
    }
}

/// Accumulates a [`LeastLikely`] in lanes.
pub(super) struct LeastLikelyAccumulator {
    tolerance: f64,
    kept: LeastLikely,
}

impl LeastLikelyAccumulator {
    pub(super) fn new(tolerance: f64) -> Self {
        Self { tolerance, kept: LeastLikely::default() }
    }

    /// Adds the configurations of a tile. `index` maps places to indices of configurations.
    #[inline(always)]
    pub(super) fn add<R: Register>(&mut self, sums: &Sums<R>, index: impl Fn(usize) -> usize) {
        let number = Lanes::<R>::constant;
        let [x, y, z] = sums.repeatable;
        let [xx, yy, zz, xy, xz, yz] = sums.covariance;
        let two = number(2.0);
        let trace = xx + yy + zz;
        let of_square = xx * xx + yy * yy + zz * zz + two * (xy * xy + xz * xz + yz * yz);
        let along = xx * x * x + yy * y * y + zz * z * z + two * (xy * x * y + xz * x * z + yz * y * z);
        let square = self.tolerance * self.tolerance;
        let mean = (sums.repeatable_square + trace).max(number(NONE * square));
        let variance = (two * of_square + number(4.0) * along).max(number(NONE * square * square));
        let middle = (mean - variance / (number(4.0) * mean)).max(number(0.0)).sqrt();
        let deviations = (number(self.tolerance) - middle) * two * (mean / variance).sqrt();
        let most = match self.kept.0.get(KEPT - 1) {
            Some((most, _)) => *most,
            None => f64::INFINITY,
        };
        if number(most).more_than(deviations).any() {
            self.keep(deviations.to_slice(), sums, &index);
        }
    }

    #[cold]
    #[inline(never)]
    fn keep<R: Register>(&mut self, deviations: &[f64], sums: &Sums<R>, index: &dyn Fn(usize) -> usize) {
        let places = sums.place.to_slice().iter().zip(sums.weight.to_slice());
        for (deviations, (place, weight)) in deviations.iter().zip(places) {
            if *weight != 0.0 {
                self.kept.add(*deviations, index(*place as usize));
            }
        }
    }

    pub(super) fn finish(self) -> LeastLikely {
        self.kept
    }
}
