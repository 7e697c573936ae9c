//! Householder reflections that fold a block of rows into a triangle.
//!
//! For each column j, `H = I − β v vᵀ` with `v = (r_jj − ρ, w_j)` maps `(r_jj, w_j)` to `(ρ, 0)`,
//! where `w_j` is the column of the block and `ρ = −sign(r_jj) ‖(r_jj, w_j)‖`. It changes only row
//! j of the triangle.

use abbe_core::lanes::{Kernel, Register};

/// Rows per block: a block with the columns of a usual model fits in the first-level cache.
pub(super) const BLOCK: usize = 64;

/// Number of parallel partial sums. It is fixed, and products are not fused with sums, so results
/// are identical to the last bit on all machines.
const SIDE_BY_SIDE: usize = 8;

/// A triangle in row-major order and a block in column-major order; the block is overwritten.
pub(super) struct Fold<'a> {
    pub(super) triangle: &'a mut [f64],
    pub(super) block: &'a mut [[f64; BLOCK]],
}

impl Kernel for Fold<'_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Register>(self) {
        let width = self.block.len();
        for (j, row) in self.triangle.chunks_exact_mut(width).enumerate() {
            let (before, behind) = self.block.split_at_mut(j + 1);
            let (diagonal, others) = row[j..].split_at_mut(1);
            let (own, alpha) = (&before[j], diagonal[0]);
            let square = dot(own, own);
            if square == 0.0 {
                continue;
            }
            let rho = -(alpha * alpha + square).sqrt().copysign(alpha);
            let first = alpha - rho;
            let beta = 2.0 / (first * first + square);
            diagonal[0] = rho;
            for (entry, column) in others.iter_mut().zip(behind) {
                let along = beta * (first * *entry + dot(own, column));
                *entry -= along * first;
                for (value, own) in column.iter_mut().zip(own) {
                    *value -= along * own;
                }
            }
        }
    }
}

#[inline(always)]
fn dot(a: &[f64; BLOCK], b: &[f64; BLOCK]) -> f64 {
    let mut sums = [0.0; SIDE_BY_SIDE];
    for i in 0..BLOCK / SIDE_BY_SIDE {
        for lane in 0..SIDE_BY_SIDE {
            sums[lane] += a[SIDE_BY_SIDE * i + lane] * b[SIDE_BY_SIDE * i + lane];
        }
    }
    let [a, b, c, d, e, f, g, h] = sums;
    ((a + e) + (c + g)) + ((b + f) + (d + h))
}
