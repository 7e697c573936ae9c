//! Combined errors of all sources over the workspace.

use super::Ellipsoid;
use super::extreme::{Extreme, comparable};
use super::over_signs::OverSignsAccumulator;
use super::peak::{self, Peak};
use super::sums::{SourceKinds, Sums};
use abbe_core::Scalar;
use abbe_core::lanes::{Lanes, Register};

/// Combined errors of all sources over the workspace.
///
/// | method | repeatable sources r_k | random sources with bounds b_k |
/// |---|---|---|
/// | the paper's | Σ r_k, with signs | root sum of squares of the b_k |
/// | GUM | | standard deviation: root sum of squares of b_k/√3 (uniform), b_k/√6 (triangular), b_k/√2 (arcsine), b_k/3 (normal) |
/// | worst case | Σ r_k, with signs | Σ ± b_k, with the signs that make the norm largest |
///
/// Positions are in the length unit, orientations in rad. All figures are 0 for an empty workspace.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Combined {
    /// max ‖Σ repeatable‖: radius of the error sphere about zero.
    pub repeatable_radius: Extreme,
    /// max ‖RSS random‖.
    pub random_radius: Extreme,
    /// max over the configurations of ‖Σ repeatable‖ + ‖RSS random‖.
    pub radius: Extreme,
    /// Largest \|Σ repeatable\| along x, y, z of `F_0`.
    pub repeatable: [f64; 3],
    /// Largest root sum of squares along x, y, z of `F_0`.
    pub random: [f64; 3],
    /// Root mean squares over the configurations of the three norms: repeatable, random, and their
    /// sum.
    pub rms: [f64; 3],
    /// Largest standard deviation along x, y, z of `F_0`.
    pub standard_deviation: [f64; 3],
    /// max √(tr Σ): standard deviation of the position.
    pub standard_radius: Extreme,
    /// Largest worst case along x, y, z of `F_0`: \|Σ repeatable\| + Σ \|b_k\|.
    pub worst_case: [f64; 3],
    /// max ‖Σ repeatable + Σ ± b_k‖ over all signs: repeatable sources at their values, the others
    /// at their bounds. No draw exceeds it if these are bounded; the bound of a normal one is 3σ,
    /// which 0.27 % of its draws exceed. The parts of a calibration are one error, with the root
    /// sum of their squares in any direction.
    pub worst_case_radius: Extreme,
    /// 95 % ellipsoid at the configuration with the largest standard deviation in any direction.
    pub ellipsoid: Ellipsoid,
}

/// Relative difference of two variances whose [`comparable`] deviations are equal, if one of them
/// is that of a comparable deviation itself.
const ALIKE: f64 = 7e-9;

impl Combined {
    /// Merges the figures of other configurations, except for the root mean squares.
    pub(super) fn merge(&mut self, other: &Self) {
        for (here, other) in [
            (&mut self.repeatable_radius, &other.repeatable_radius),
            (&mut self.random_radius, &other.random_radius),
            (&mut self.radius, &other.radius),
            (&mut self.standard_radius, &other.standard_radius),
            (&mut self.worst_case_radius, &other.worst_case_radius),
        ] {
            here.merge(other);
        }
        for (here, other) in [
            (&mut self.repeatable, other.repeatable),
            (&mut self.random, other.random),
            (&mut self.standard_deviation, other.standard_deviation),
            (&mut self.worst_case, other.worst_case),
        ] {
            *here = core::array::from_fn(|i| here[i].max(other[i]));
        }
        self.ellipsoid.add(&other.ellipsoid);
    }

    /// Returns the indices of the configurations in the result.
    pub fn indices(&self) -> impl Iterator<Item = usize> + use<> {
        let radii = [self.repeatable_radius, self.random_radius, self.radius];
        let others = [self.standard_radius, self.worst_case_radius];
        let extremes = radii.into_iter().chain(others).map(|extreme| extreme.configuration);
        extremes.chain([self.ellipsoid.configuration]).flatten()
    }
}

/// Accumulates the combined errors in lanes.
pub(super) struct CombinedAccumulator<R: Register> {
    ellipsoid: Ellipsoid,
    repeatable_square: Peak<R>,
    random_square: Peak<R>,
    radius: Peak<R>,
    trace: Peak<R>,
    over_signs: OverSignsAccumulator<R>,
    repeatable: [Lanes<R>; 3],
    random: [Lanes<R>; 3],
    variance: [Lanes<R>; 3],
    worst_case: [Lanes<R>; 3],
    squares: [Lanes<R>; 3],
}

impl<R: Register> CombinedAccumulator<R> {
    /// Initializes the accumulation with the ellipsoid of a sample of configurations.
    pub(super) fn new(ellipsoid: Ellipsoid, kinds: &SourceKinds) -> Self {
        let zero = Lanes::constant(0.0);
        Self {
            ellipsoid,
            repeatable_square: Peak::none(),
            random_square: Peak::none(),
            radius: Peak::none(),
            trace: Peak::none(),
            over_signs: OverSignsAccumulator::new(kinds),
            repeatable: [zero; 3],
            random: [zero; 3],
            variance: [zero; 3],
            worst_case: [zero; 3],
            squares: [zero; 3],
        }
    }

    /// Adds the configurations of a tile. `index` maps places to indices of configurations.
    #[inline(always)]
    pub(super) fn add(&mut self, sums: &Sums<R>, rows: &[Lanes<R>], index: impl Fn(usize) -> usize) {
        let &Sums { place, weight, .. } = sums;
        self.repeatable_square.add(sums.repeatable_square, sums.repeatable_square, place);
        self.random_square.add(sums.random_square, sums.random_square, place);
        let norms = [sums.repeatable_norm, sums.random_norm, sums.radius];
        self.radius.add(sums.radius, sums.radius * sums.radius, place);
        self.over_signs.add(rows, sums);
        for (sum, norm) in self.squares.iter_mut().zip(norms) {
            *sum = (norm * norm).mul_add(weight, *sum);
        }
        let covariance = &sums.covariance;
        let diagonal = [covariance[0], covariance[1], covariance[2]];
        let trace = diagonal[0] + diagonal[1] + diagonal[2];
        self.trace.add(trace, trace, place);
        #[expect(clippy::needless_range_loop, reason = "four arrays go side by side")]
        for i in 0..3 {
            self.repeatable[i] = sums.repeatable[i].abs().max(self.repeatable[i]);
            self.random[i] = sums.squares[i].max(self.random[i]);
            self.variance[i] = diagonal[i].max(self.variance[i]);
            self.worst_case[i] = sums.worst_case[i].max(self.worst_case[i]);
        }
        let [longest, ..] = self.ellipsoid.principal.deviations;
        let longest = comparable(longest);
        let minor = least_minor(covariance, longest * longest * (1.0 + ALIKE));
        // Without random errors all are 0, and the ellipsoid is unchanged.
        if Lanes::constant(0.0).more_than(minor).any() {
            self.longer(sums, minor.as_slice(), &index);
        }
    }

    #[cold]
    #[inline(never)]
    fn longer(&mut self, sums: &Sums<R>, minors: &[f64], index: &dyn Fn(usize) -> usize) {
        let [xx, yy, zz, xy, xz, yz] = sums.covariance.each_ref().map(Lanes::as_slice);
        for (lane, place) in sums.place.as_slice().iter().enumerate() {
            if minors[lane] >= 0.0 || sums.weight.as_slice()[lane] == 0.0 {
                continue;
            }
            let covariance = [
                [xx[lane], xy[lane], xz[lane]],
                [xy[lane], yy[lane], yz[lane]],
                [xz[lane], yz[lane], zz[lane]],
            ];
            self.ellipsoid.add(&Ellipsoid::new(covariance, index(*place as usize)));
        }
    }

    /// Returns the partial result, with indices of configurations, and the sums of squares of the
    /// three norms.
    pub(super) fn finish(self, index: impl Fn(usize) -> usize) -> (Combined, [f64; 3]) {
        let roots = |largest: [Lanes<R>; 3]| largest.map(|square| peak::largest(square).sqrt());
        let combined = Combined {
            repeatable_radius: self.repeatable_square.finish(&index).root(),
            random_radius: self.random_square.finish(&index).root(),
            radius: self.radius.finish(&index),
            repeatable: self.repeatable.map(peak::largest),
            random: roots(self.random),
            standard_deviation: roots(self.variance),
            standard_radius: self.trace.finish(&index).root(),
            worst_case: self.worst_case.map(peak::largest),
            worst_case_radius: self.over_signs.found.finish(&index),
            ellipsoid: self.ellipsoid,
            ..Combined::default()
        };
        (combined, self.squares.map(peak::sum))
    }
}

/// Returns the least leading minor of `λ I − Σ`, which is negative unless the matrix is positive
/// semidefinite (Sylvester's criterion): then no eigenvalue of the covariance exceeds λ.
#[inline(always)]
fn least_minor<R: Register>(covariance: &[Lanes<R>; 6], limit: f64) -> Lanes<R> {
    let [xx, yy, zz, xy, xz, yz] = *covariance;
    let [a, b, c] = [xx, yy, zz].map(|variance| Lanes::constant(limit) - variance);
    let minor = a * b - xy * xy;
    let determinant = c * minor - yz * (a * yz + xy * xz) - xz * (b * xz + xy * yz);
    a.min(minor).min(determinant)
}

#[cfg(test)]
mod tests;
