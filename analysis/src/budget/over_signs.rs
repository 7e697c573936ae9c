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
            bound = simple.min(weighted(classes, rows, sums).sqrt() + sums.calibration);
            if peak::largest(bound) > self.tolerance {
                found = exact(classes, rows, sums, bound, self.tolerance).max(found);
                let open = bound.more_than(Lanes::constant(self.tolerance));
                bound = open.select(found, bound);
                self.most = self.most.max(peak::largest(found));
            }
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

/// Returns an upper bound of the squared norm, `Σ ‖v‖ · λ` with the largest eigenvalue λ of
/// `M = Σ v vᵀ/‖v‖` over all vectors, Σ r among them: `(n·Σ ± v)² ≤ Σ ‖v‖ · Σ (n·v)²/‖v‖` by the
/// inequality of Cauchy and Schwarz. With the mean m and the variance s² of the eigenvalues,
/// `λ ≤ m + s √2`.
#[inline(always)]
fn weighted<R: Register>(classes: &[Class], rows: &[Lanes<R>], sums: &Sums<R>) -> Lanes<R> {
    let number = Lanes::<R>::constant;
    let (mut total, mut matrix) = (number(0.0), [number(0.0); 6]);
    let mut put = |v: [Lanes<R>; 3]| {
        let norm = peak::square(v).sqrt();
        total = total + norm;
        let [x, y, z] = v.map(|row| row / norm.max(number(f64::MIN_POSITIVE)).sqrt());
        let parts = [(x, x), (y, y), (z, z), (x, y), (x, z), (y, z)];
        matrix = core::array::from_fn(|i| parts[i].0.mul_add(parts[i].1, matrix[i]));
    };
    put(sums.repeatable);
    for (class, v) in classes.iter().zip(rows.chunks(6)) {
        if class.distribution().is_some() {
            put([v[0], v[1], v[2]]);
        }
    }
    let [xx, yy, zz, xy, xz, yz] = matrix;
    let mean = (xx + yy + zz) * number(1.0 / 3.0);
    let off = number(2.0) * (xy * xy + xz * xz + yz * yz);
    let square = [xx, yy, zz].map(|entry| (entry - mean) * (entry - mean));
    let variance = (square[0] + square[1] + square[2] + off) * number(1.0 / 3.0);
    total * (mean + (variance * number(2.0)).sqrt()) * number(1.0 + ROUNDING)
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
