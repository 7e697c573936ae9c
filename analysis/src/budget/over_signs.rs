//! The worst case over all signs: `max ‖Σ r + Σ ± b_k‖`.

use super::peak::{self, Peak};
use super::sums::{SourceKinds, Sums, plus};
use crate::worst_case;
use abbe_core::Scalar;
use abbe_core::lanes::{Lanes, Register};
use abbe_kinematics::sampling::norm;

/// Largest number of sources of unknown sign for which all pairs are tried in lanes.
const PAIRS: usize = 32;

/// Accumulates the worst case over all signs in lanes, which is exact.
///
/// At most configurations `‖Σ r‖ + Σ ‖b_k‖`, or the norm of the worst cases of the three rows,
/// shows that their worst case is not the largest. At the others it is determined as
/// [`worst_case`](crate::worst_case()) does it, by all pairs of sources.
pub(super) struct OverSignsAccumulator<R: Register> {
    /// First rows of the sources of unknown sign that are errors of their own, and what makes them
    /// distinct.
    unknown: Vec<(usize, [f64; 3])>,
    /// Largest worst case.
    pub(super) found: Peak<R>,
    /// Largest value in any lane.
    most: f64,
    /// Errors of these sources in a tile, and slightly different ones.
    vectors: Vec<[Lanes<R>; 3]>,
    distinct: Vec<[Lanes<R>; 3]>,
}

impl<R: Register> OverSignsAccumulator<R> {
    /// Creates the accumulator for sources.
    pub(super) fn new(SourceKinds { classes, is_part, .. }: &SourceKinds) -> Self {
        let unknown = classes.iter().enumerate();
        let unknown = unknown.filter(|(k, class)| class.distribution().is_some() && !is_part[*k]);
        let unknown: Vec<(usize, [f64; 3])> =
            unknown.enumerate().map(|(n, (k, _))| (6 * k, worst_case::apart(n))).collect();
        // A pair, at least.
        let vectors = vec![[Lanes::constant(0.0); 3]; unknown.len().max(2)];
        Self { unknown, found: Peak::none(), most: -1.0, distinct: vectors.clone(), vectors }
    }

    /// Adds the configurations of a tile.
    #[inline(always)]
    pub(super) fn add(&mut self, rows: &[Lanes<R>], sums: &Sums<R>) {
        let simple = sums.repeatable_norm + sums.random_norms;
        let bound = (peak::square(sums.worst_case).sqrt() + sums.with_parts).min(simple);
        if self.unknown.is_empty() {
            self.found.add(simple, simple * simple, sums.place);
        } else if peak::largest(bound) > self.most {
            let longest =
                if self.unknown.len() > PAIRS { self.apart(rows, sums) } else { self.pairs(rows, sums) };
            let worst = longest + sums.with_parts;
            self.most = self.most.max(peak::largest(worst));
            self.found.add(worst, worst * worst, sums.place);
        }
    }

    /// Returns the largest norm in each lane by all pairs of sources.
    #[inline(always)]
    fn pairs(&mut self, rows: &[Lanes<R>], sums: &Sums<R>) -> Lanes<R> {
        let Self { unknown, vectors, distinct, .. } = self;
        let zero = Lanes::constant(0.0);
        for (k, (first, [x, y, z])) in unknown.iter().enumerate() {
            let v = [rows[*first], rows[first + 1], rows[first + 2]];
            vectors[k] = v;
            let size = peak::square(v).sqrt();
            let [x, y, z] = [Lanes::constant(*x), Lanes::constant(*y), Lanes::constant(*z)];
            distinct[k] = plus(v, [size * x, size * y, size * z]);
        }
        let mut longest = zero;
        for i in 0..vectors.len() {
            for j in i + 1..vectors.len() {
                let ([ax, ay, az], [bx, by, bz]) = (distinct[i], distinct[j]);
                let normal = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
                let mut sum = [zero; 3];
                for k in 0..vectors.len() {
                    if k == i || k == j {
                        continue;
                    }
                    let ([x, y, z], d) = (vectors[k], distinct[k]);
                    let along = normal[0].mul_add(d[0], normal[1].mul_add(d[1], normal[2] * d[2]));
                    let sign = Lanes::constant(1.0).with_sign_of(along);
                    sum = [x.mul_add(sign, sum[0]), y.mul_add(sign, sum[1]), z.mul_add(sign, sum[2])];
                }
                let [both, apart] = [plus(vectors[i], vectors[j]), minus(vectors[i], vectors[j])];
                for side in [plus(sums.repeatable, sum), minus(sums.repeatable, sum)] {
                    longest =
                        longest.max(peak::square(plus(side, both))).max(peak::square(minus(side, both)));
                    longest =
                        longest.max(peak::square(plus(side, apart))).max(peak::square(minus(side, apart)));
                }
            }
        }
        longest.sqrt()
    }

    /// Returns the largest norm in each lane, for many sources.
    #[cold]
    #[inline(never)]
    fn apart(&self, rows: &[Lanes<R>], sums: &Sums<R>) -> Lanes<R> {
        Lanes::from_fn(|lane| {
            let at = |row: &Lanes<R>| row.as_slice()[lane];
            let vector = |(first, _): &(usize, [f64; 3])| core::array::from_fn(|i| at(&rows[first + i]));
            let vectors: Vec<[f64; 3]> = self.unknown.iter().map(vector).collect();
            norm(worst_case(sums.repeatable.each_ref().map(at), &vectors))
        })
    }
}

#[inline(always)]
fn minus<R: Register>(a: [Lanes<R>; 3], b: [Lanes<R>; 3]) -> [Lanes<R>; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
