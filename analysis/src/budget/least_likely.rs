//! Where a tolerance is least likely met, by an approximation that a sweep can afford.

use super::sums::Sums;
use abbe_core::Scalar;
use abbe_core::lanes::{Lanes, Register};

/// How many configurations are kept.
const KEPT: usize = 32;
/// Variances below this share of the tolerance's square are none.
const NONE: f64 = 1e-24;

/// The configurations at which a tolerance T is least likely met, the least first.
///
/// The square of the norm of an error with mean b and covariance C has the mean `κ_1 = |b|² + tr C` and the variance
/// `κ_2 = 2 tr C² + 4 bᵀ C b`. Its root is nearly normal, with the mean `√(κ_1 − κ_2/(4 κ_1))` and the standard deviation
/// `√κ_2 / (2 √κ_1)`: configurations are ranked by how many of these T is above that mean.
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

    /// Takes in those of other configurations.
    pub(super) fn merge(&mut self, other: &Self) {
        other.0.iter().for_each(|(deviations, index)| self.add(*deviations, *index));
    }

    /// Indices of the configurations.
    pub(super) fn indices(&self) -> impl Iterator<Item = usize> {
        self.0.iter().map(|(_, index)| *index)
    }

    /// Indices of the configurations.
    pub(super) fn finish(self) -> Vec<usize> {
        self.0.into_iter().map(|(_, index)| index).collect()
    }
}

/// Gathers a [`LeastLikely`] in lanes.
pub(super) struct Lane {
    tolerance: f64,
    kept: LeastLikely,
}

impl Lane {
    pub(super) fn new(tolerance: f64) -> Self {
        Self { tolerance, kept: LeastLikely::default() }
    }

    /// Takes in the configurations of a tile; `index` says which those at its places are.
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
