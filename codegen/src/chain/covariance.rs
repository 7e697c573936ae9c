//! Computes `J_e diag(σ²) J_eᵀ` without `J_e`.

use super::{Accumulated, Local, Rows, vectors};
use crate::graph::{Graph, Node, Six, Vector, transposed};

type Matrix = [Vector; 3];

/// Covariance of the tool point's displacement δ and rotation θ, in 3 × 3 blocks; the diagonal
/// blocks are symmetric.
///
/// With `δ = … + d + θ × ρ` for the errors of a frame, and `L = −[ρ]` (so that `θ × ρ = L θ`), a
/// frame adds
///
/// ```text
/// PP += diag(σ_d²) + L diag(σ_θ²) Lᵀ        PR += L diag(σ_θ²)        RR += diag(σ_θ²)
/// ```
pub(crate) struct Covariance {
    /// Covariance of δ.
    pp: Matrix,
    /// Covariance of δ with θ.
    pr: Matrix,
    /// Covariance of θ.
    rr: Matrix,
}

impl Covariance {
    pub(super) fn none(graph: &mut Graph) -> Self {
        let zero = [[graph.zero(); 3]; 3];
        Self { pp: zero, pr: zero, rr: zero }
    }
}

/// Entries of the upper triangle of a symmetric block.
const UPPER: [(usize, usize); 6] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];

impl Accumulated for Covariance {
    const NUMBERS: usize = 21;

    /// Reads the upper triangle of PP, all of PR, and the upper triangle of RR.
    fn from_numbers(numbers: &[Node]) -> Self {
        let symmetric = |first: usize| {
            let mut block = [[numbers[0]; 3]; 3];
            for (k, (i, j)) in UPPER.into_iter().enumerate() {
                (block[i][j], block[j][i]) = (numbers[first + k], numbers[first + k]);
            }
            block
        };
        let pr = [0, 1, 2].map(|i| [0, 1, 2].map(|j| numbers[6 + 3 * i + j]));
        Self { pp: symmetric(0), pr, rr: symmetric(15) }
    }

    fn numbers(&self) -> Vec<Node> {
        let upper = |block: &Matrix| UPPER.map(|(i, j)| block[i][j]);
        upper(&self.pp).into_iter().chain(self.pr.concat()).chain(upper(&self.rr)).collect()
    }

    /// Returns the 6 × 6 covariance of ΔX, with `PR Bᵀ` and `B RR Bᵀ`, where B maps the small
    /// rotation to rows 4–6.
    fn rows(&self, graph: &mut Graph, rows: &Rows) -> Vec<Six> {
        let pr = self.pr.map(|row| rows.orientation_rows(graph, row));
        let half = transposed(&self.rr.map(|row| rows.orientation_rows(graph, row)));
        let rr = symmetric(half.map(|row| rows.orientation_rows(graph, row)));
        let upper = (0..3).map(|i| joined(self.pp[i], pr[i]));
        let lower = (0..3).map(|i| joined(transposed(&pr)[i], rr[i]));
        upper.chain(lower).collect()
    }

    fn add(&mut self, graph: &mut Graph, variances: Six, [x, y, z]: Vector) {
        let (shift, turn) = vectors(variances);
        let zero = graph.zero();
        let [minus_x, minus_y, minus_z] = graph.neg_vector([x, y, z]);
        let lever = [[zero, z, minus_y], [minus_z, zero, x], [y, minus_x, zero]];
        let swing = lever.map(|row: Vector| [0, 1, 2].map(|k| graph.mul(row[k], turn[k])));
        for (i, j) in UPPER {
            let part = graph.dot(swing[i], lever[j]);
            self.pp[i][j] = graph.add(self.pp[i][j], part);
            self.pp[j][i] = self.pp[i][j];
        }
        for i in 0..3 {
            self.pp[i][i] = graph.add(self.pp[i][i], shift[i]);
            self.pr[i] = graph.add_vectors(self.pr[i], swing[i]);
            self.rr[i][i] = graph.add(self.rr[i][i], turn[i]);
        }
    }

    fn turn(&mut self, graph: &mut Graph, motion: &Local) {
        match motion {
            Local::Shift(_) => {}
            Local::Turn { axis, sine, cosine } => {
                let double = Double::new(graph, *sine, *cosine);
                self.pp = turned_symmetric(graph, motion, *axis, double, &self.pp);
                self.rr = turned_symmetric(graph, motion, *axis, double, &self.rr);
                self.pr = turned(graph, motion, *axis, double, &self.pr);
            }
            Local::Rotation(_) => {
                self.pp = symmetric(congruent(graph, motion, &self.pp));
                self.rr = symmetric(congruent(graph, motion, &self.rr));
                self.pr = congruent(graph, motion, &self.pr);
            }
        }
    }
}

/// `cos²`, `sin cos`, `cos 2θ` and `sin 2θ` of a rotation, shared by the blocks.
#[derive(Clone, Copy)]
struct Double {
    square: Node,
    product: Node,
    cosine: Node,
    sine: Node,
}

impl Double {
    fn new(graph: &mut Graph, sine: Node, cosine: Node) -> Self {
        let (square, product, one) =
            (graph.mul(cosine, cosine), graph.mul(sine, cosine), graph.constant(1.0));
        let twice = graph.add(square, square);
        Self { square, product, cosine: graph.sub(twice, one), sine: graph.add(product, product) }
    }
}

/// Returns `R S Rᵀ` of a symmetric S for a rotation about a coordinate axis. With `d = S_jj − S_kk`
/// and `m = S_jk`:
///
/// ```text
/// x = cos² d − sin 2θ m        S_jj ← S_kk + x        S_kk ← S_jj − x        S_jk ← sin cos d + cos 2θ m
/// ```
fn turned_symmetric(graph: &mut Graph, motion: &Local, axis: usize, double: Double, s: &Matrix) -> Matrix {
    let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut turned = *s;
    turned[axis] = motion.direction(graph, s[axis]);
    let (difference, mixed) = (graph.sub(s[j][j], s[k][k]), s[j][k]);
    let (first, second) = (graph.mul(double.square, difference), graph.mul(double.sine, mixed));
    let change = graph.sub(first, second);
    turned[j][j] = graph.add(s[k][k], change);
    turned[k][k] = graph.sub(s[j][j], change);
    let (first, second) = (graph.mul(double.product, difference), graph.mul(double.cosine, mixed));
    turned[j][k] = graph.add(first, second);
    turned[k][j] = turned[j][k];
    for i in [j, k] {
        turned[i][axis] = turned[axis][i];
    }
    turned
}

/// Returns `R M Rᵀ` of any M for a rotation about a coordinate axis. With `d = M_jj − M_kk` and `f
/// = M_jk + M_kj`:
///
/// ```text
/// x = cos² d − sin cos f       M_jj ← M_kk + x        M_kk ← M_jj − x
/// y = sin cos d + cos² f       M_jk ← y − M_kj        M_kj ← y − M_jk
/// ```
fn turned(graph: &mut Graph, motion: &Local, axis: usize, double: Double, m: &Matrix) -> Matrix {
    let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut turned = *m;
    turned[axis] = motion.direction(graph, m[axis]);
    let column = motion.direction(graph, transposed(m)[axis]);
    let (difference, sum) = (graph.sub(m[j][j], m[k][k]), graph.add(m[j][k], m[k][j]));
    let (first, second) = (graph.mul(double.square, difference), graph.mul(double.product, sum));
    let x = graph.sub(first, second);
    let (first, second) = (graph.mul(double.product, difference), graph.mul(double.square, sum));
    let y = graph.add(first, second);
    turned[j][j] = graph.add(m[k][k], x);
    turned[k][k] = graph.sub(m[j][j], x);
    turned[j][k] = graph.sub(y, m[k][j]);
    turned[k][j] = graph.sub(y, m[j][k]);
    for i in [j, k] {
        turned[i][axis] = column[i];
    }
    turned
}

/// Returns `R M Rᵀ`: transforms the columns, then the rows.
fn congruent(graph: &mut Graph, motion: &Local, m: &Matrix) -> Matrix {
    let columns = transposed(m).map(|column| motion.direction(graph, column));
    transposed(&columns).map(|row| motion.direction(graph, row))
}

/// Copies the upper triangle to the lower one.
fn symmetric(m: Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| m[i.min(j)][i.max(j)]))
}

fn joined([a, b, c]: Vector, [d, e, f]: Vector) -> Six {
    [a, b, c, d, e, f]
}
