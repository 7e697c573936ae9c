//! Symmetric matrices of a thousand rows: sums of `BᵀB` and Cholesky factors `A = RᵀR`.
//!
//! Both spend their time in one loop, `C ± BᵀB` for a block `B` of [`DEPTH`] rows, whose columns
//! stand in panels of [`TILE`].

use abbe_core::lanes::{InstructionSet, Kernel, Register};

/// Rows of a block.
pub(super) const DEPTH: usize = 64;

/// Columns of a panel.
const TILE: usize = 8;

/// Rows of the tile of `C` whose sums stay in registers.
const HALF: usize = 4;

/// A block of rows, in panels of columns.
pub(super) struct Block {
    panels: Vec<[[f64; TILE]; DEPTH]>,
    filled: usize,
}

impl Block {
    /// Creates an empty block of `columns` columns.
    pub(super) fn new(columns: usize) -> Self {
        Self { panels: vec![[[0.0; TILE]; DEPTH]; columns.div_ceil(TILE)], filled: 0 }
    }

    /// Appends a row; returns whether the block is full.
    pub(super) fn push(&mut self, row: &[f64]) -> bool {
        for (panel, values) in self.panels.iter_mut().zip(row.chunks(TILE)) {
            panel[self.filled][..values.len()].copy_from_slice(values);
        }
        self.filled += 1;
        self.filled == DEPTH
    }

    /// Sets the values to zero for a block of other rows.
    fn clear(&mut self) {
        self.panels.iter_mut().for_each(|panel| *panel = [[0.0; TILE]; DEPTH]);
        self.filled = 0;
    }
}

/// A symmetric matrix, of which the upper triangle counts.
#[derive(Clone)]
pub(super) struct Symmetric {
    pub(super) size: usize,
    /// Length of a row: `size`, rounded up to whole panels.
    stride: usize,
    values: Vec<f64>,
}

impl Symmetric {
    pub(super) fn zeros(size: usize) -> Self {
        let stride = size.next_multiple_of(TILE);
        Self { size, stride, values: vec![0.0; stride * stride] }
    }

    /// Returns the entry of row i and column j, in any order.
    pub(super) fn at(&self, i: usize, j: usize) -> f64 {
        self.values[i.min(j) * self.stride + i.max(j)]
    }

    /// Adds to the entry of row i and column j, and to its mirror image.
    pub(super) fn add_at(&mut self, i: usize, j: usize, value: f64) {
        self.values[i.min(j) * self.stride + i.max(j)] += value;
    }

    /// Adds `BᵀB` and empties the block.
    pub(super) fn add(&mut self, block: &mut Block) {
        let update = Update { c: &mut self.values, stride: self.stride, first: 0, block, sign: 1.0 };
        InstructionSet::best().run(update);
        block.clear();
    }

    /// Adds another matrix, multiplied by `factor`.
    pub(super) fn add_times(&mut self, other: &Self, factor: f64) {
        self.values.iter_mut().zip(&other.values).for_each(|(own, other)| *own += factor * other);
    }

    /// Returns the product with a vector.
    pub(super) fn times(&self, x: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; self.size];
        for i in 0..self.size {
            let row = &self.values[i * self.stride..i * self.stride + self.size];
            let mut own = row[i] * x[i];
            for j in i + 1..self.size {
                own += row[j] * x[j];
                product[j] += row[j] * x[i];
            }
            product[i] += own;
        }
        product
    }

    /// Factorizes in place; none if the matrix is not positive definite.
    pub(super) fn cholesky(mut self) -> Option<Cholesky> {
        let (n, stride) = (self.size, self.stride);
        let smallest: Vec<f64> = (0..n).map(|i| 1e-14 * self.at(i, i)).collect();
        for start in (0..n).step_by(DEPTH) {
            let end = n.min(start + DEPTH);
            // R₁₁ and R₁₂, row by row.
            for k in start..end {
                let (above, own) = self.values.split_at_mut(k * stride);
                let own = &mut own[k..n];
                for i in start..k {
                    let row = &above[i * stride + k..i * stride + n];
                    let factor = row[0];
                    own.iter_mut().zip(row).for_each(|(own, value)| *own -= factor * value);
                }
                if own[0].is_nan() || own[0] <= smallest[k] {
                    return None;
                }
                let root = own[0].sqrt();
                own.iter_mut().for_each(|value| *value /= root);
            }
            if end < n {
                let mut block = Block::new(stride);
                for k in start..end {
                    block.push(&self.values[k * stride..(k + 1) * stride]);
                }
                let update =
                    Update { c: &mut self.values, stride, first: end / TILE, block: &block, sign: -1.0 };
                InstructionSet::best().run(update);
            }
        }
        Some(Cholesky(self))
    }
}

/// Factor `R` of `A = RᵀR`.
pub(super) struct Cholesky(Symmetric);

impl Cholesky {
    fn row(&self, i: usize) -> &[f64] {
        &self.0.values[i * self.0.stride + i..i * self.0.stride + self.0.size]
    }

    /// Solves `A x = g`.
    pub(super) fn solve(&self, g: &[f64]) -> Vec<f64> {
        let mut x = g.to_vec();
        for i in 0..x.len() {
            let row = self.row(i);
            x[i] /= row[0];
            let own = x[i];
            x[i + 1..].iter_mut().zip(&row[1..]).for_each(|(x, value)| *x -= own * value);
        }
        for i in (0..x.len()).rev() {
            let row = self.row(i);
            let known: f64 = row[1..].iter().zip(&x[i + 1..]).map(|(value, x)| value * x).sum();
            x[i] = (x[i] - known) / row[0];
        }
        x
    }

    /// Computes `R⁻¹`, of which the rows `w_i` give `A⁻¹`: its entries are `w_i · w_j`.
    pub(super) fn inverse_root(&self) -> InverseRoot {
        let Symmetric { size, stride, .. } = self.0;
        let mut values = vec![0.0; stride * size];
        for i in (0..size).rev() {
            let (own, behind) = values[i * stride..].split_at_mut(stride);
            let row = self.row(i);
            own[i] = 1.0;
            for (k, factor) in (i + 1..size).zip(&row[1..]) {
                let other = &behind[(k - i - 1) * stride + k..(k - i - 1) * stride + size];
                own[k..size].iter_mut().zip(other).for_each(|(own, value)| *own -= factor * value);
            }
            own[i..size].iter_mut().for_each(|value| *value /= row[0]);
        }
        InverseRoot { size, stride, values }
    }
}

/// `R⁻¹` of `A = RᵀR`.
pub(super) struct InverseRoot {
    size: usize,
    stride: usize,
    values: Vec<f64>,
}

impl InverseRoot {
    /// Returns the entry of `A⁻¹` of row i and column j.
    pub(super) fn inverse_at(&self, i: usize, j: usize) -> f64 {
        let from = i.max(j);
        let row = |i: usize| &self.values[i * self.stride + from..i * self.stride + self.size];
        row(i).iter().zip(row(j)).map(|(a, b)| a * b).sum()
    }
}

/// `C ± BᵀB` on the upper triangle, from a panel on.
struct Update<'a> {
    c: &'a mut [f64],
    stride: usize,
    first: usize,
    block: &'a Block,
    sign: f64,
}

impl Kernel for Update<'_> {
    type Output = ();

    // Loops over lanes are loops: iterators may stay compiled for the oldest machine.
    #[expect(clippy::needless_range_loop)]
    #[inline(always)]
    fn run<R: Register>(self) {
        let panels = &self.block.panels;
        for i in self.first..panels.len() {
            for j in i..panels.len() {
                for half in [0, HALF] {
                    let mut sums = [[0.0; TILE]; HALF];
                    for k in 0..DEPTH {
                        let (left, right) = (&panels[i][k], &panels[j][k]);
                        for row in 0..HALF {
                            for column in 0..TILE {
                                sums[row][column] += left[half + row] * right[column];
                            }
                        }
                    }
                    for row in 0..HALF {
                        let at = (i * TILE + half + row) * self.stride + j * TILE;
                        let values = &mut self.c[at..at + TILE];
                        for column in 0..TILE {
                            values[column] += self.sign * sums[row][column];
                        }
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests;
