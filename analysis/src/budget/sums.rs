//! Combined errors of all sources at the configurations of one tile.

use super::{peak, variance};
use crate::parts::{self, ErrorParts};
use abbe_core::lanes::{Lanes, Register};
use abbe_core::{Class, Description, Scalar};

/// Combined errors of all sources at the configurations of one tile, in three rows.
pub(super) struct Sums<R: Register> {
    /// Places of the configurations in their chunk.
    pub(super) place: Lanes<R>,
    /// Weight: 1, or 0 in lanes that repeat the last configuration.
    pub(super) weight: Lanes<R>,
    /// Σ r of the repeatable sources, the square of its norm, and its norm.
    pub(super) repeatable: [Lanes<R>; 3],
    pub(super) repeatable_square: Lanes<R>,
    pub(super) repeatable_norm: Lanes<R>,
    /// Σ b² of the random sources row by row, the sum of the three rows, and its root.
    pub(super) squares: [Lanes<R>; 3],
    pub(super) random_square: Lanes<R>,
    pub(super) random_norm: Lanes<R>,
    /// ‖Σ r‖ + √Σ b².
    pub(super) radius: Lanes<R>,
    /// `|Σ r| + Σ |b|` row by row, and `Σ ‖b‖`; with the parts of an error as one.
    pub(super) worst_case: [Lanes<R>; 3],
    pub(super) random_norms: Lanes<R>,
    /// Σ of the largest norms of errors with several parts.
    pub(super) with_parts: Lanes<R>,
    /// `Σ c b bᵀ` of the random sources: xx, yy, zz, xy, xz, yz.
    pub(super) covariance: [Lanes<R>; 6],
}

impl<R: Register> Sums<R> {
    /// Combines the rows of a tile, beginning with the first of the three rows of the first source,
    /// with six rows per source.
    #[inline(always)]
    pub(super) fn new(
        SourceKinds { classes, with_parts: all, is_part }: &SourceKinds,
        rows: &[Lanes<R>],
        place: Lanes<R>,
        weight: Lanes<R>,
    ) -> Self {
        let zero = Lanes::constant(0.0);
        let (mut repeatable, mut squares, mut worst_case) = ([zero; 3], [zero; 3], [zero; 3]);
        let (mut random_norms, mut covariance, mut random_square) = (zero, [zero; 6], zero);
        for (k, (class, rows)) in classes.iter().zip(rows.chunks(6)).enumerate() {
            let here = [rows[0], rows[1], rows[2]];
            let [x, y, z] = here;
            match class {
                Class::Repeatable => repeatable = plus(repeatable, here),
                Class::Tolerance(distribution) | Class::Random(distribution) => {
                    if !is_part[k] {
                        random_norms = random_norms + peak::square(here).sqrt();
                        random_square = random_square + peak::square(here);
                        worst_case = plus(worst_case, [x.abs(), y.abs(), z.abs()]);
                    }
                    squares = [x.mul_add(x, squares[0]), y.mul_add(y, squares[1]), z.mul_add(z, squares[2])];
                    let variance = Lanes::constant(variance(*distribution));
                    let [vx, vy, vz] = [x * variance, y * variance, z * variance];
                    let [xx, yy, zz, xy, xz, yz] = covariance;
                    covariance = [
                        vx.mul_add(x, xx),
                        vy.mul_add(y, yy),
                        vz.mul_add(z, zz),
                        vx.mul_add(y, xy),
                        vx.mul_add(z, xz),
                        vy.mul_add(z, yz),
                    ];
                }
            }
        }
        let mut with_parts = zero;
        for parts in all {
            let (along, norm) = error_with_parts(parts, rows);
            (with_parts, random_square) = (with_parts + norm, norm.mul_add(norm, random_square));
            worst_case = plus(worst_case, along);
        }
        let [x, y, z] = repeatable;
        worst_case = plus(worst_case, [x.abs(), y.abs(), z.abs()]);
        let repeatable_square = peak::square(repeatable);
        let (repeatable_norm, random_norm) = (repeatable_square.sqrt(), random_square.sqrt());
        Self {
            place,
            weight,
            repeatable,
            repeatable_square,
            repeatable_norm,
            squares,
            random_square,
            random_norm,
            radius: repeatable_norm + random_norm,
            worst_case,
            random_norms: random_norms + with_parts,
            with_parts,
            covariance,
        }
    }
}

/// Classes of the sources, and which of them are parts of one error.
#[derive(Clone, Debug)]
pub(super) struct SourceKinds {
    pub(super) classes: Vec<Class>,
    /// Sources of each error with several parts.
    pub(super) with_parts: Vec<Vec<usize>>,
    pub(super) is_part: Vec<bool>,
}

impl SourceKinds {
    pub(super) fn new(description: &Description) -> Self {
        let parts = ErrorParts::new(description);
        let with_parts: Vec<Vec<usize>> = parts.with_parts().map(<[usize]>::to_vec).collect();
        let is_part = |k: usize| with_parts.iter().any(|parts| parts.contains(&k));
        let is_part = (0..description.sources.len()).map(is_part).collect();
        Self { classes: description.sources.iter().map(|source| source.class).collect(), with_parts, is_part }
    }
}

/// Returns the largest values along the rows and the largest norm of an error with several parts.
#[cold]
#[inline(never)]
fn error_with_parts<R: Register>(parts: &[usize], rows: &[Lanes<R>]) -> ([Lanes<R>; 3], Lanes<R>) {
    let at = |lane: usize| {
        let part = |k: &usize| [0, 1, 2].map(|row| rows[6 * k + row].as_slice()[lane]);
        parts::outer_sum(parts.iter().map(part))
    };
    let along = [0, 1, 2].map(|row| Lanes::from_fn(|lane| at(lane)[row][row].sqrt()));
    (along, Lanes::from_fn(|lane| parts::longest(at(lane))))
}

#[inline(always)]
pub(super) fn plus<R: Register>(a: [Lanes<R>; 3], b: [Lanes<R>; 3]) -> [Lanes<R>; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}
