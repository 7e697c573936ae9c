//! Joint commands that put the real tool where the ideal one should be: `A_1 E_1(q′) … A_n E_n(q′) · T = X*` for q′.
//!
//! With `d = q′ − q` every iteration solves `min ‖X_real(q′) ⊖ X*‖² + λ ‖d‖²` on the nominal `J_q`,
//! `d ← (JᵀJ + λ)⁻¹ Jᵀ (r + J d)`, `r = X* ⊖ X_real(q′)`. The one formula gives the exact solution where there are six joints
//! that move the tool in six ways, the one nearest to `q` where there are more, least squares where there are fewer, and
//! a bounded step where `J` loses rank. As the real Jacobian differs from `J` by what the errors turn, what is missing
//! shrinks each time to a share of about the errors' angles over the least singular value of `J` (in metres and rad).
//!
//! What is left after [`ITERATIONS`], on the exact chain, as the tests hold it: less than 0.001 mm and 1 µrad within the
//! limits, for errors of millimetres and milliradians, where that singular value is above 0.1; of the paper's positioner
//! over its treatment volume, 5.4 mm become less than 10⁻⁵ mm, and a turn is left only where a joint is at its limit. The cost is
//! fixed, and nothing is allocated; at limits and near singularities more steps may be needed, and [`Compensated::converged`]
//! says so.

use crate::{Description, Error, Orientation, Pose, Scalar, Variable, VariableKind, deviation};

/// How many times the real chain is improved on; it is evaluated once more to know what is left.
pub const ITERATIONS: usize = 6;

/// A step below this is rest, in rad and metres.
pub const REST: f64 = 1e-7;

/// λ, in rad and metres: `√λ ‖d‖` bounds what it leaves, a nanometre where the correction is a millimetre.
pub const DAMPING: f64 = 1e-14;

/// What a rad counts as, in metres: so little that the tool point comes first where not all can be had.
pub const LEVER: f64 = 1e-3;

pub use crate::chain::LEAST_SINE;

/// Corrected joint commands, and what they gain.
///
/// Errors are ΔX, real minus wanted: three lengths in `F_0`, then the rotation vector in rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compensated<Q> {
    /// The commands, within the limits.
    pub q: Q,
    /// ΔX at the commands that were given.
    pub before: [f64; 6],
    /// ΔX at `q`.
    pub after: [f64; 6],
    /// Whether the steps came to rest: the last one moved no variable by more than [`REST`]. If not, more of them were needed
    /// than there are.
    pub converged: bool,
}

/// The norms of the position and of the rotation of a ΔX: in the manipulator's length unit, and in rad.
pub fn norms(rows: &[f64; 6]) -> (f64, f64) {
    let norm = |v: &[f64]| Scalar::sqrt(dot(v, v));
    (norm(&rows[..3]), norm(&rows[3..]))
}

/// Commands that bring the real tool to `target`, close to `start` and within the limits of the variables.
///
/// `step` gives the real pose at a configuration and fills in the nominal `J_q` with rotation-vector rows, one column
/// for each variable: what a generated `compensator_step` computes; `columns` is room for them. It is asked
/// `ITERATIONS + 1` times. The best configuration that was seen is returned: it is never worse than `start`, if that
/// is within the limits. Where not all can be had the tool point comes first (1 rad counts as 1 mm). Whether the
/// target is reached is what [`Compensated::after`] says: it is not where a limit, too few joints, or a singularity
/// forbid it, or where more steps were needed, which [`Compensated::converged`] says; `abbe::analysis::compensated` takes as
/// many as it needs. An error is what `step` returns as such.
pub fn compensate<Q, C>(
    description: &Description,
    target: &Pose,
    start: &Q,
    mut columns: C,
    mut step: impl FnMut(&Q, &mut C) -> Result<Pose, Error>,
) -> Result<Compensated<Q>, Error>
where
    Q: Clone + AsRef<[f64]> + AsMut<[f64]>,
    C: AsMut<[[f64; 6]]>,
{
    let Description { variables, length, .. } = description;
    let problem = Problem { variables, metre: 1.0 / length.in_metres() };
    let error = |real: &Pose| deviation(Orientation::RotationVector, target, real);

    let before = error(&step(start, &mut columns)?);
    let mut best = Compensated { q: start.clone(), before, after: before, converged: false };
    let cost = |after: &[f64; 6]| problem.weighted(*after).iter().map(|v| v * v).sum::<f64>();
    let mut least = if problem.within(start.as_ref()) { cost(&before) } else { f64::INFINITY };

    let (mut q, mut after, mut moved) = (start.clone(), before, 0.0);
    for _ in 0..ITERATIONS {
        let from = q.clone();
        problem.depart(start.as_ref(), q.as_mut(), columns.as_mut(), &after);
        moved = problem.largest_step(from.as_ref(), q.as_ref());
        after = error(&step(&q, &mut columns)?);
        if cost(&after) < least {
            least = cost(&after);
            best = Compensated { q: q.clone(), before, after, converged: false };
        }
    }
    Ok(Compensated { converged: moved <= REST, ..best })
}

/// What lengths and angles count: all in metres and rad.
struct Problem<'a> {
    variables: &'a [Variable],
    /// A metre in the manipulator's unit.
    metre: f64,
}

impl Problem<'_> {
    fn weighted(&self, [x, y, z, a, b, c]: [f64; 6]) -> [f64; 6] {
        let (length, angle) = (1.0 / self.metre, LEVER);
        [x * length, y * length, z * length, a * angle, b * angle, c * angle]
    }

    /// One metre or one rad, in the unit of the variable.
    fn unit(&self, j: usize) -> f64 {
        match self.variables[j].kind {
            VariableKind::Revolute => 1.0,
            VariableKind::Prismatic => self.metre,
        }
    }

    /// In metres and rad.
    fn largest_step(&self, from: &[f64], to: &[f64]) -> f64 {
        let steps = from.iter().zip(to).enumerate();
        steps.map(|(j, (from, to))| Scalar::abs(to - from) / self.unit(j)).fold(0.0, f64::max)
    }

    fn within(&self, q: &[f64]) -> bool {
        self.variables.iter().zip(q).all(|(variable, value)| clamped(variable, *value) == *value)
    }

    /// `q` becomes `start + d`. A variable that would go beyond a limit is held there, the one furthest beyond it
    /// first, and the others solved for again. Consumes the columns.
    fn depart(&self, start: &[f64], q: &mut [f64], columns: &mut [[f64; 6]], after: &[f64; 6]) {
        // r + J d
        let mut wanted = self.weighted(*after).map(|row| -row);
        for (j, column) in columns.iter_mut().enumerate() {
            *column = self.weighted(column.map(|entry| entry * self.unit(j)));
            add(&mut wanted, column, (q[j] - start[j]) / self.unit(j));
        }
        for _ in 0..=columns.len() {
            let d = Departure::shortest(columns, &wanted);
            let mut furthest = (0.0, 0);
            for (j, column) in columns.iter().enumerate() {
                // Held, or of no use to the tool.
                if *column == [0.0; 6] {
                    continue;
                }
                q[j] = start[j] + d.component(j, column) * self.unit(j);
                let beyond = Scalar::abs(q[j] - clamped(&self.variables[j], q[j])) / self.unit(j);
                if beyond > furthest.0 {
                    furthest = (beyond, j);
                }
            }
            let (beyond, j) = furthest;
            if beyond == 0.0 {
                break;
            }
            q[j] = clamped(&self.variables[j], q[j]);
            add(&mut wanted, &columns[j], (start[j] - q[j]) / self.unit(j));
            columns[j] = [0.0; 6];
        }
        for (variable, value) in self.variables.iter().zip(q) {
            *value = clamped(variable, *value);
        }
    }
}

/// `(JᵀJ + λ)⁻¹ Jᵀ b = Jᵀ (J Jᵀ + λ)⁻¹ b`: by the smaller of the two matrices.
enum Departure {
    /// d itself, of six joints or fewer.
    Primal([f64; 6]),
    /// `(J Jᵀ + λ)⁻¹ b`.
    Dual([f64; 6]),
}

impl Departure {
    fn shortest(columns: &[[f64; 6]], b: &[f64; 6]) -> Self {
        let mut matrix = [[0.0; 6]; 6];
        if columns.len() > 6 {
            for column in columns {
                for (row, entry) in matrix.iter_mut().zip(column) {
                    add(row, column, *entry);
                }
            }
            return Self::Dual(solve(matrix, *b));
        }
        let mut projected = [0.0; 6];
        for (i, column) in columns.iter().enumerate() {
            projected[i] = dot(column, b);
            for (j, other) in columns[..=i].iter().enumerate() {
                matrix[i][j] = dot(column, other);
            }
        }
        Self::Primal(solve(matrix, projected))
    }

    fn component(&self, j: usize, column: &[f64; 6]) -> f64 {
        match self {
            Self::Primal(d) => d[j],
            Self::Dual(z) => dot(column, z),
        }
    }
}

/// `(M + λ)⁻¹ b` by Cholesky's `L Lᵀ`, for M positive semidefinite; its lower triangle is read.
fn solve(mut m: [[f64; 6]; 6], mut b: [f64; 6]) -> [f64; 6] {
    for i in 0..6 {
        for j in 0..=i {
            let rest = m[i][j] - dot(&m[i][..j], &m[j][..j]);
            // Rounding must not make a pivot smaller than it can be.
            m[i][j] = if i == j { Scalar::sqrt(rest.max(0.0) + DAMPING) } else { rest / m[j][j] };
        }
        b[i] = (b[i] - dot(&m[i][..i], &b[..i])) / m[i][i];
    }
    for i in (0..6).rev() {
        let known: f64 = (i + 1..6).map(|j| m[j][i] * b[j]).sum();
        b[i] = (b[i] - known) / m[i][i];
    }
    b
}

fn clamped(variable: &Variable, value: f64) -> f64 {
    value.max(variable.limits[0]).min(variable.limits[1])
}

fn add(sum: &mut [f64; 6], column: &[f64; 6], factor: f64) {
    for (sum, entry) in sum.iter_mut().zip(column) {
        *sum += entry * factor;
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::{Departure, dot, solve};

    /// Columns that nobody chose.
    fn columns<const N: usize>() -> [[f64; 6]; N] {
        core::array::from_fn(|j| core::array::from_fn(|i| (1.0 + i as f64 * 1.7 + j as f64 * 2.3).sin()))
    }

    fn departure<const N: usize>(columns: &[[f64; 6]; N], b: &[f64; 6]) -> [f64; N] {
        let d = Departure::shortest(columns, b);
        core::array::from_fn(|j| d.component(j, &columns[j]))
    }

    #[test]
    fn cholesky_solves() {
        let b = [1.0, -2.0, 3.0, 0.5, 0.0, 7.0];
        let matrix: [[f64; 6]; 6] =
            core::array::from_fn(|i| core::array::from_fn(|j| 1.0 / (1.0 + i.abs_diff(j) as f64)));
        let x = solve(matrix, b);
        matrix.iter().zip(b).for_each(|(row, b)| assert!((dot(row, &x) - b).abs() < 1e-9));
    }

    /// Fewer joints: what is left is orthogonal to all that they can do.
    #[test]
    fn fewer_than_six_are_least_squares() {
        let (columns, b) = (columns::<4>(), [1.0, -2.0, 3.0, 0.5, 0.0, 7.0]);
        let d = departure(&columns, &b);
        let left: [f64; 6] =
            core::array::from_fn(|i| b[i] - columns.iter().zip(d).map(|(c, d)| c[i] * d).sum::<f64>());
        columns.iter().for_each(|column| assert!(dot(column, &left).abs() < 1e-6));
    }

    /// More joints: the shortest departure that does it is orthogonal to all that leave the tool where it is.
    #[test]
    fn lost_rank_stays_bounded() {
        let [a, b, ..] = columns::<2>();
        let d = departure(&[a, b, a, b, a, b, a, b], &a);
        d.iter().enumerate().for_each(|(j, d)| {
            let expected = if j % 2 == 0 { 0.25 } else { 0.0 };
            assert!((d - expected).abs() < 1e-3, "{d}, not {expected}");
        });
    }
}
