//! Pose error of a chain of lower pairs, its joint Jacobian, and the damped step: in lanes.

// Loops instead of closures, which could be compiled without the instruction set.
#![allow(clippy::needless_range_loop)]

use super::lane_chain::{LaneChain, Vector, apply, then};
use abbe_core::Scalar;
use abbe_core::lanes::{Lanes, Mask, Register};

/// Regularization added to `J Jᵀ`, relative to its trace: immobile directions take no part.
const FLOOR: f64 = 1e-13;
/// Smallest cosine of half the rotation angle used as a divisor.
const LEAST_COSINE: f64 = 1e-3;

/// Rows 1–3 in arm lengths. Rows 4–6, for poses, are the axis of the remaining rotation times
/// `2 sin θ/2`.
pub(super) struct PoseError<R: Register, const ROWS: usize> {
    pub(super) rows: [Lanes<R>; ROWS],
    /// Norm of the rows. Its rotation part is exact beyond a right angle, too.
    pub(super) norm: Lanes<R>,
    /// `J_q`: one column per joint.
    columns: Vec<[Lanes<R>; ROWS]>,
    /// Axes of the joints, and points on them, in `F_0`.
    axes: Vec<[Vector<R>; 2]>,
}

impl<R: Register, const ROWS: usize> PoseError<R, ROWS> {
    pub(super) fn new(joints: usize) -> Self {
        let zero = Lanes::constant(0.0);
        Self {
            rows: [zero; ROWS],
            norm: zero,
            columns: vec![[zero; ROWS]; joints],
            axes: vec![[[zero; 3]; 2]; joints],
        }
    }

    /// Copies `other` in the lanes set in `there`.
    #[inline(always)]
    pub(super) fn replace(&mut self, other: &Self, there: Mask<R>) {
        for i in 0..ROWS {
            self.rows[i] = there.select(other.rows[i], self.rows[i]);
        }
        self.norm = there.select(other.norm, self.norm);
        for (column, other) in self.columns.iter_mut().zip(&other.columns) {
            for i in 0..ROWS {
                column[i] = there.select(other[i], column[i]);
            }
        }
    }

    /// Evaluates the residual of a chain at joint values `q` for a target.
    #[inline(always)]
    pub(super) fn evaluate(&mut self, chain: &LaneChain<R>, q: &[Lanes<R>], target: &[Vector<R>; 4]) {
        let zero = Lanes::constant(0.0);
        let mut frame = chain.base;
        for (i, joint) in chain.joints.iter().enumerate() {
            self.axes[i] = [frame[2], frame[3]];
            joint.pass(&mut frame, q[i]);
        }
        if ROWS == 6 {
            then(&mut frame, &chain.tool);
        } else {
            frame[3] = apply(&frame, &chain.tool[3]);
        }
        let tool = frame[3];
        for (i, joint) in chain.joints.iter().enumerate() {
            let [axis, at] = self.axes[i];
            let lever = [tool[0] - at[0], tool[1] - at[1], tool[2] - at[2]];
            let moment = cross(&axis, &lever);
            for row in 0..ROWS {
                self.columns[i][row] = match (joint.turns, row < 3) {
                    (true, true) => moment[row],
                    (true, false) => axis[row % 3],
                    (false, true) => axis[row],
                    (false, false) => zero,
                };
            }
        }
        let mut squares = zero;
        for row in 0..3 {
            self.rows[row] = target[3][row] - tool[row];
            squares = self.rows[row].mul_add(self.rows[row], squares);
        }
        if ROWS == 6 {
            squares = squares + self.turn(&frame, target);
        }
        self.norm = squares.sqrt();
    }

    /// Computes rows 4–6, and returns their square, from the trace `1 + 2 cos θ` and the skew part,
    /// the axis times `sin θ`.
    #[inline(always)]
    fn turn(&mut self, frame: &[Vector<R>; 4], target: &[Vector<R>; 4]) -> Lanes<R> {
        let (zero, one, half) = (Lanes::constant(0.0), Lanes::constant(1.0), Lanes::constant(0.5));
        let (mut trace, mut skew) = (zero, [zero; 3]);
        for axis in 0..3 {
            let product = cross(&frame[axis], &target[axis]);
            for row in 0..3 {
                trace = frame[axis][row].mul_add(target[axis][row], trace);
                skew[row] = skew[row] + product[row];
            }
        }
        let cosine = (trace + one).max(zero).sqrt() * half;
        let scale = half / cosine.max(Lanes::constant(LEAST_COSINE));
        let mut squares = zero;
        for row in 0..3 {
            let turn = skew[row] * scale;
            self.rows[3 + row] = turn;
            squares = turn.mul_add(turn, squares);
        }
        one.more_than(trace).select(Lanes::constant(3.0) - trace, squares)
    }

    /// Computes `Jᵀ (J Jᵀ + λ)⁻¹ r` with the active columns, by an `L D Lᵀ` decomposition.
    #[inline(always)]
    pub(super) fn damped_step(&self, damping: Lanes<R>, active: &[Lanes<R>], step: &mut [Lanes<R>]) {
        let zero = Lanes::<R>::constant(0.0);
        let mut m = [[zero; ROWS]; ROWS];
        for (column, active) in self.columns.iter().zip(active) {
            for i in 0..ROWS {
                let value = column[i] * *active;
                for j in 0..=i {
                    m[i][j] = value.mul_add(column[j], m[i][j]);
                }
            }
        }
        let mut trace = zero;
        for (i, row) in m.iter().enumerate() {
            trace = trace + row[i];
        }
        let floor = trace.mul_add(Lanes::constant(FLOOR), Lanes::constant(1e-200));
        let mut y = self.rows;
        let mut inverse = [zero; ROWS];
        for j in 0..ROWS {
            // m holds L below its diagonal, and L D in the remaining columns.
            let pivot = (m[j][j] + damping + floor).max(floor);
            inverse[j] = Lanes::constant(1.0) / pivot;
            for i in j + 1..ROWS {
                let l = m[i][j] * inverse[j];
                for k in j + 1..=i {
                    m[i][k] = l.neg_mul_add(m[k][j], m[i][k]);
                }
                y[i] = l.neg_mul_add(y[j], y[i]);
            }
        }
        for j in (0..ROWS).rev() {
            let mut value = y[j];
            for i in j + 1..ROWS {
                value = m[i][j].neg_mul_add(y[i], value);
            }
            y[j] = value * inverse[j];
        }
        for ((column, active), step) in self.columns.iter().zip(active).zip(step) {
            let mut value = zero;
            for i in 0..ROWS {
                value = column[i].mul_add(y[i], value);
            }
            *step = value * *active;
        }
    }
}

#[inline(always)]
fn cross<R: Register>(a: &Vector<R>, b: &Vector<R>) -> Vector<R> {
    [a[1].mul_sub(b[2], a[2] * b[1]), a[2].mul_sub(b[0], a[0] * b[2]), a[0].mul_sub(b[1], a[1] * b[0])]
}
