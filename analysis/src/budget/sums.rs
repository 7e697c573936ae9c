//! Combined errors of all sources at the configurations of one tile.

use super::{peak, variance};
use abbe_core::lanes::{Lanes, Register};
use abbe_core::{Class, Scalar};

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
    /// `|Σ r| + Σ |b|` row by row, and `Σ ‖b‖`; with the parts of a calibration as one error.
    pub(super) worst_case: [Lanes<R>; 3],
    pub(super) random_norms: Lanes<R>,
    /// Norm of the error of the calibration.
    pub(super) calibration: Lanes<R>,
    /// `Σ c b bᵀ` of the random sources: xx, yy, zz, xy, xz, yz.
    pub(super) covariance: [Lanes<R>; 6],
}

impl<R: Register> Sums<R> {
    /// Combines the rows of a tile, beginning with the first of the three rows of the first source,
    /// with six rows per source. The sources from `calibration` on are the parts of one.
    #[inline(always)]
    pub(super) fn new(
        classes: &[Class],
        calibration: usize,
        rows: &[Lanes<R>],
        place: Lanes<R>,
        weight: Lanes<R>,
    ) -> Self {
        let zero = Lanes::constant(0.0);
        let (mut repeatable, mut squares, mut worst_case) = ([zero; 3], [zero; 3], [zero; 3]);
        let (mut random_norms, mut covariance, mut parts) = (zero, [zero; 6], [zero; 3]);
        for (k, (class, rows)) in classes.iter().zip(rows.chunks(6)).enumerate() {
            let here = [rows[0], rows[1], rows[2]];
            let [x, y, z] = here;
            match class {
                Class::Repeatable => repeatable = plus(repeatable, here),
                Class::Tolerance(distribution) | Class::Random(distribution) => {
                    if k < calibration {
                        random_norms = random_norms + peak::square(here).sqrt();
                        worst_case = plus(worst_case, [x.abs(), y.abs(), z.abs()]);
                    } else {
                        parts = [x.mul_add(x, parts[0]), y.mul_add(y, parts[1]), z.mul_add(z, parts[2])];
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
        let calibration = (parts[0] + parts[1] + parts[2]).sqrt();
        let [x, y, z] = repeatable;
        worst_case = plus(worst_case, [x.abs(), y.abs(), z.abs()]);
        worst_case = plus(worst_case, [parts[0].sqrt(), parts[1].sqrt(), parts[2].sqrt()]);
        let repeatable_square = peak::square(repeatable);
        let random_square = squares[0] + squares[1] + squares[2];
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
            random_norms: random_norms + calibration,
            calibration,
            covariance,
        }
    }
}

#[inline(always)]
pub(super) fn plus<R: Register>(a: [Lanes<R>; 3], b: [Lanes<R>; 3]) -> [Lanes<R>; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}
