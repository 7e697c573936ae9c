//! Configurations at which a tolerance is least likely to be met, and the one with the largest
//! error at 95 %, by a fast approximation.

use super::extreme::{Extreme, comparable};
use super::{peak::Peak, sums::Sums};
use crate::normal::ONE_SIDED_95;
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
/// by the distance of T from that mean in standard deviations, and compared by the norm that 5 % of
/// the errors exceed.
#[derive(Clone, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct LeastLikely {
    /// [`comparable`] distances and indices, the smallest distance first.
    kept: Vec<(f64, usize)>,
    /// Largest norm that 5 % of the errors exceed.
    farthest: Extreme,
}

impl LeastLikely {
    fn add(&mut self, deviations: f64, index: usize) {
        let deviations = comparable(deviations);
        let after = self.kept.partition_point(|kept| (kept.0, kept.1) < (deviations, index));
        if after < KEPT {
            self.kept.truncate(KEPT - 1);
            self.kept.insert(after, (deviations, index));
        }
    }

    /// Merges the result of other configurations.
    pub(super) fn merge(&mut self, other: &Self) {
        other.kept.iter().for_each(|(deviations, index)| self.add(*deviations, *index));
        self.farthest.merge(&other.farthest);
    }

    /// Returns the indices of the configurations.
    pub(super) fn indices(&self) -> impl Iterator<Item = usize> {
        self.kept.iter().map(|(_, index)| *index).chain(self.farthest.configuration)
    }

    /// Returns the indices of the configurations, the least likely first, and that of the largest
    /// error last.
    pub(super) fn finish(self) -> Vec<usize> {
        let mut indices: Vec<usize> = self.kept.into_iter().map(|(_, index)| index).collect();
        indices.extend(self.farthest.configuration.filter(|index| !indices.contains(index)));
        indices
    }
}

/// Accumulates a [`LeastLikely`] in lanes.
pub(super) struct LeastLikelyAccumulator<R: Register> {
    tolerance: f64,
    least: LeastLikely,
    farthest: Peak<R>,
}

impl<R: Register> LeastLikelyAccumulator<R> {
    pub(super) fn new(tolerance: f64) -> Self {
        Self { tolerance, least: LeastLikely::default(), farthest: Peak::none() }
    }

    /// Adds the configurations of a tile. `index` maps places to indices of configurations.
    #[inline(always)]
    pub(super) fn add(&mut self, sums: &Sums<R>, index: impl Fn(usize) -> usize) {
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
        let half = number(ONE_SIDED_95 / 2.0);
        let farthest = (variance / mean).sqrt().mul_add(half, middle);
        self.farthest.add(farthest, farthest * farthest, sums.place);
        let most = self.least.kept.get(KEPT - 1).map_or(f64::INFINITY, |(most, _)| *most);
        if number(most).more_than(deviations).any() {
            self.keep(deviations.as_slice(), sums, &index);
        }
    }

    #[cold]
    #[inline(never)]
    fn keep(&mut self, deviations: &[f64], sums: &Sums<R>, index: &dyn Fn(usize) -> usize) {
        let places = sums.place.as_slice().iter().zip(sums.weight.as_slice());
        for (deviations, (place, weight)) in deviations.iter().zip(places) {
            if *weight != 0.0 {
                self.least.add(*deviations, index(*place as usize));
            }
        }
    }

    /// Returns the partial result. `index` maps places to indices of configurations.
    pub(super) fn finish(self, index: impl Fn(usize) -> usize) -> LeastLikely {
        LeastLikely { farthest: self.farthest.finish(index), ..self.least }
    }
}
