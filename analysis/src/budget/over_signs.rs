//! The worst case over all signs: `max ‖Σ r + Σ ± b_k‖`.

use super::peak::{self, Peak};
use super::sums::Sums;
use crate::worst_case;
use abbe_core::lanes::{Lanes, Register};
use abbe_core::{Class, Scalar};
use abbe_kinematics::sampling::norm;

/// Steps of the search from each axis.
const STEPS: usize = 3;
/// Relative room for rounding when bounds are compared.
const ROUNDING: f64 = 1e-9;

/// Accumulates the worst case over all signs in lanes.
///
/// At most configurations `‖Σ r‖ + Σ ‖b_k‖` shows that their worst case is not the largest. At the
/// others it is searched: signs that agree with a direction give a longer vector, whose direction
/// gives the next signs. Such a vector may be short of the longest. Where a tolerance could make a
/// difference the longest is determined exactly.
pub(super) struct OverSignsAccumulator<R: Register> {
    tolerance: f64,
    found: Peak<R>,
    /// Largest value found in any lane.
    most: f64,
    /// Upper bound of the worst case of all configurations.
    bound: f64,
    /// Indicates that a source has an unknown sign.
    any: bool,
}

impl<R: Register> OverSignsAccumulator<R> {
    pub(super) fn new(classes: &[Class], tolerance: Option<f64>) -> Self {
        let tolerance = tolerance.map_or(f64::INFINITY, |tolerance| tolerance * (1.0 + ROUNDING));
        let any = classes.iter().any(|class| class.distribution().is_some());
        Self { tolerance, found: Peak::none(), most: -1.0, bound: 0.0, any }
    }

    /// Adds the configurations of a tile. `rows` are those of the sources before the calibration.
    #[inline(always)]
    pub(super) fn add(&mut self, classes: &[Class], rows: &[Lanes<R>], sums: &Sums<R>) {
        let simple = sums.repeatable_norm + sums.random_norms;
        let highest = peak::largest(simple);
        if !self.any || highest <= self.most {
            self.bound = self.bound.max(highest);
            // Ties go to the first configuration.
            if !self.any {
                self.found.add(simple, sums.place);
            }
            return;
        }
        let mut found = farthest(classes, rows, sums).sqrt() + sums.calibration;
        self.most = self.most.max(peak::largest(found));
        let mut bound = simple;
        if highest > self.tolerance && self.most <= self.tolerance {
            found = exact(classes, rows, sums, bound, self.tolerance).max(found);
            let open = bound.more_than(Lanes::constant(self.tolerance));
            bound = open.select(found, bound);
            self.most = self.most.max(peak::largest(found));
        }
        self.bound = self.bound.max(peak::largest(bound));
        self.found.add(found, sums.place);
    }

    /// Returns the largest worst case that was found, its place, and the upper bound.
    pub(super) fn finish(self) -> (Option<(f64, usize)>, f64) {
        (self.found.finish(), self.bound)
    }
}

/// Returns the squared norm of a long vector with some signs.
#[inline(always)]
fn farthest<R: Register>(classes: &[Class], rows: &[Lanes<R>], sums: &Sums<R>) -> Lanes<R> {
    let zero = Lanes::constant(0.0);
    let mut longest = zero;
    for axis in 0..3 {
        let mut direction = [zero; 3];
        direction[axis] = Lanes::constant(1.0).with_sign_of(sums.repeatable[axis]);
        for _ in 0..STEPS {
            let mut sum = sums.repeatable;
            for (class, v) in classes.iter().zip(rows.chunks(6)) {
                if class.distribution().is_some() {
                    let along = v[0].mul_add(direction[0], v[1].mul_add(direction[1], v[2] * direction[2]));
                    let sign = Lanes::constant(1.0).with_sign_of(along);
                    sum = core::array::from_fn(|i| v[i].mul_add(sign, sum[i]));
                }
            }
            direction = sum;
        }
        longest = longest.max(peak::square(direction));
    }
    longest
}

/// Returns the exact worst case in the lanes whose bound exceeds the tolerance, 0 in the others.
#[cold]
#[inline(never)]
fn exact<R: Register>(
    classes: &[Class],
    rows: &[Lanes<R>],
    sums: &Sums<R>,
    bound: Lanes<R>,
    tolerance: f64,
) -> Lanes<R> {
    Lanes::from_fn(|lane| {
        if bound.to_slice()[lane] <= tolerance {
            return 0.0;
        }
        let at = |row: &Lanes<R>| row.to_slice()[lane];
        let unknown = classes.iter().zip(rows.chunks(6)).filter(|(class, _)| class.distribution().is_some());
        let vectors: Vec<[f64; 3]> = unknown.map(|(_, v)| core::array::from_fn(|i| at(&v[i]))).collect();
        norm(worst_case(sums.repeatable.each_ref().map(at), &vectors)) + at(&sums.calibration)
    })
}
