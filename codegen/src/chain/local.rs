//! Local motions of a transform `A_i`, each cheap to apply to a vector or a tensor.
//!
//! A matrix that is a rotation about a coordinate axis, up to a permutation of axes, is decomposed
//! again. So is its position as far as it lies along the rotated axes: `(a cos q, a sin q, 0)` is a
//! translation by a constant after the rotation.

use abbe_spec::{Elementary, Factor, Motion};

use super::walk::about;
use crate::graph::{Frame, Graph, Node, Op, Vector};

/// One of the motions that make up a transform, in the axes that the preceding motions lead to.
pub(crate) enum Local {
    /// A translation.
    Shift(Vector),
    /// A rotation about coordinate axis 0, 1 or 2.
    Turn { axis: usize, sine: Node, cosine: Node },
    /// A general rotation, by columns; often a permutation of axes, which costs nothing.
    Rotation([Vector; 3]),
}

impl Local {
    /// Returns the motions of a product of factors, in its order.
    pub(super) fn motions(graph: &mut Graph, factors: &[Factor]) -> Vec<Self> {
        let mut motions = Vec::new();
        for factor in factors {
            match factor {
                Factor::Elementary(Elementary { motion, axis, amount }) => {
                    let amount = graph.lower(amount);
                    motions.push(elementary(graph, *motion, *axis, amount));
                }
                Factor::About { motion: Motion::Translation, axis, amount } => {
                    let amount = graph.lower(amount);
                    let axis = axis.map(|component| graph.constant(component));
                    motions.push(Self::Shift(graph.scale(amount, axis)));
                }
                Factor::About { motion: Motion::Rotation, axis, amount } => {
                    let amount = graph.lower(amount);
                    motions.push(Self::Rotation(about(graph, *axis, amount)));
                }
                Factor::Matrix(matrix) => {
                    let column = |graph: &mut Graph, j: usize| {
                        [0, 1, 2].map(|row: usize| graph.lower(&matrix.rows[row][j]))
                    };
                    let axes = [0, 1, 2].map(|j| column(graph, j));
                    let position = column(graph, 3);
                    taken_apart(graph, &Frame { axes, position }, &mut motions);
                }
            }
        }
        motions
    }

    /// Returns the motions of a rigid motion.
    pub(super) fn from_frame(graph: &mut Graph, motion: &Frame) -> Vec<Self> {
        let mut motions = Vec::new();
        taken_apart(graph, motion, &mut motions);
        motions
    }

    /// Transforms a direction to the axes before the motion.
    pub(crate) fn direction(&self, graph: &mut Graph, v: Vector) -> Vector {
        match self {
            Self::Shift(_) => v,
            Self::Turn { axis, sine, cosine } => {
                let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
                let [uc, us, vc, vs] = [(*cosine, v[j]), (*sine, v[j]), (*cosine, v[k]), (*sine, v[k])]
                    .map(|(factor, component)| graph.mul(factor, component));
                let mut turned = v;
                turned[j] = graph.sub(uc, vs);
                turned[k] = graph.add(us, vc);
                turned
            }
            Self::Rotation(axes) => graph.turn(axes, v),
        }
    }

    /// Transforms a direction from the axes before the motion to those behind it.
    pub(super) fn direction_behind(&self, graph: &mut Graph, v: Vector) -> Vector {
        match self {
            Self::Shift(_) => v,
            Self::Turn { axis, sine, cosine } => {
                let back = Self::Turn { axis: *axis, sine: graph.neg(*sine), cosine: *cosine };
                back.direction(graph, v)
            }
            Self::Rotation(axes) => axes.map(|axis| graph.dot(axis, v)),
        }
    }

    /// Returns the pose behind the motion from the pose before it.
    pub(super) fn behind(&self, graph: &mut Graph, frame: &Frame) -> Frame {
        match self {
            Self::Shift(shift) => {
                let offset = graph.turn(&frame.axes, *shift);
                Frame { position: graph.add_vectors(frame.position, offset), ..*frame }
            }
            Self::Turn { axis, sine, cosine } => graph.turned_by(frame, *axis, *sine, *cosine),
            Self::Rotation(axes) => {
                Frame { axes: axes.map(|column| graph.turn(&frame.axes, column)), ..*frame }
            }
        }
    }

    /// Transforms a point to the frame before the motion.
    pub(crate) fn point(&self, graph: &mut Graph, p: Vector) -> Vector {
        match self {
            Self::Shift(shift) => graph.add_vectors(*shift, p),
            _ => self.direction(graph, p),
        }
    }
}

fn elementary(graph: &mut Graph, motion: Motion, axis: usize, amount: Node) -> Local {
    match motion {
        Motion::Translation => {
            let mut shift = [graph.zero(); 3];
            shift[axis] = amount;
            Local::Shift(shift)
        }
        Motion::Rotation => {
            let (sine, cosine) = (graph.sin(amount), graph.cos(amount));
            if graph.value(sine).is_some_and(|sine| sine.fract() == 0.0) {
                let identity = graph.identity();
                return Local::Rotation(graph.turned(&identity, axis, amount).axes);
            }
            Local::Turn { axis, sine, cosine }
        }
    }
}

/// Decomposes `T(t) R = T(t − R u) R T(u)`, and R into a rotation about a coordinate axis and a
/// permutation of axes if possible.
fn taken_apart(graph: &mut Graph, matrix: &Frame, motions: &mut Vec<Local>) {
    let (before, after) = shifts(graph, matrix);
    motions.push(Local::Shift(before));
    match turn(graph, &matrix.axes) {
        Some((turn, exchange)) => motions.extend([turn, Local::Rotation(exchange)]),
        None => motions.push(Local::Rotation(matrix.axes)),
    }
    motions.push(Local::Shift(after));
}

/// Splits the position into a translation before the rotation and one along its columns after it.
fn shifts(graph: &mut Graph, matrix: &Frame) -> (Vector, Vector) {
    let zero = graph.zero();
    let (mut before, mut after) = (matrix.position, [zero; 3]);
    for (j, axis) in matrix.axes.iter().enumerate() {
        let rows: Vec<usize> = (0..3).filter(|&i| axis[i] != zero && before[i] != zero).collect();
        // A single product would not get cheaper.
        if rows.len() < 2 {
            continue;
        }
        let candidates = match graph.op(before[rows[0]]) {
            Op::Mul(a, b) => vec![a, b],
            _ => continue,
        };
        let signed: Vec<Node> = candidates.into_iter().flat_map(|a| [a, graph.neg(a)]).collect();
        let amount = signed.into_iter().find(|&amount| {
            (0..3).filter(|&i| axis[i] != zero).all(|i| graph.mul(amount, axis[i]) == before[i])
        });
        if let Some(amount) = amount {
            after[j] = amount;
            rows.into_iter().for_each(|i| before[i] = zero);
        }
    }
    (before, after)
}

/// Decomposes a rotation into a rotation about a coordinate axis and a permutation of axes after
/// it, if possible.
///
/// Some entry (i, j) is ±1, so column j is ± axis i. Another column k holds the cosine and sine of
/// the angle by which axis i + 1 is rotated, and the last column is ± the rotated axis i + 2.
fn turn(graph: &mut Graph, axes: &[Vector; 3]) -> Option<(Local, [Vector; 3])> {
    let zero = graph.zero();
    let unit = |graph: &Graph, node: Node| graph.value(node).filter(|value| value.abs() == 1.0);
    let (i, j, sign) =
        (0..9).find_map(|at| unit(graph, axes[at / 3][at % 3]).map(|sign| (at % 3, at / 3, sign)))?;
    let (k, l) = ((j + 1) % 3, (j + 2) % 3);
    let (y, z) = ((i + 1) % 3, (i + 2) % 3);
    let (cosine, sine) = (axes[k][y], axes[k][z]);
    let minus = graph.neg(sine);
    let last = if [axes[l][y], axes[l][z]] == [minus, cosine] {
        1.0
    } else if [graph.neg(axes[l][y]), graph.neg(axes[l][z])] == [minus, cosine] {
        -1.0
    } else {
        return None;
    };
    let mut exchange = [[zero; 3]; 3];
    exchange[j][i] = graph.constant(sign);
    exchange[k][y] = graph.constant(1.0);
    exchange[l][z] = graph.constant(last);
    Some((Local::Turn { axis: i, sine, cosine }, exchange))
}

#[cfg(test)]
mod tests;
