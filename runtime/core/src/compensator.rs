//! Compensated joint commands: the `q′` that solves `A_1 E_1(q′) … A_n E_n(q′) · T = X*`.
//!
//! With `d = q′ − q`, every iteration solves `min ‖X_real(q′) ⊖ X*‖² + λ ‖d‖²` on the nominal
//! `J_q`: `d ← (JᵀJ + λ)⁻¹ Jᵀ (r + J d)`, `r = X* ⊖ X_real(q′)`. This yields the exact solution for
//! six independent joints, the solution nearest to `q` for redundant arms, the least-squares
//! solution for fewer joints, and a bounded step where `J` loses rank. The real Jacobian differs
//! from `J` by rotations of the size of the errors, so each iteration reduces the residual by about
//! the ratio of the errors' angles to the smallest singular value of `J` (in metres and rad).
//!
//! Residuals on the exact chain after [`ITERATIONS`], as tested: less than 0.001 mm and 1 µrad
//! within the limits, for errors of millimetres and milliradians, where that singular value is
//! above 0.1. For the paper's positioner over its treatment volume, 5.4 mm become less than 10⁻⁵
//! mm, and a rotation remains only where a joint is at its limit. The cost is fixed, and nothing is
//! allocated. At limits and near singularities more iterations may be needed;
//! [`Compensated::converged`] tells.

use crate::{Description, Error, Orientation, Pose, Scalar, Variable, VariableKind, deviation};

/// Number of iterations. The real chain is evaluated once more, for the remaining error.
pub const ITERATIONS: usize = 6;

/// Largest step of a converged iteration, in rad and metres.
pub const REST: f64 = 1e-7;

/// λ, in rad² and m². It leaves an error of at most `√λ ‖d‖`: a nanometre for a correction of 10
/// mm.
pub const DAMPING: f64 = 1e-14;

/// Metres that weigh as much as one rad. The small value gives the position of the tool point
/// priority.
pub const LEVER: f64 = 1e-3;

pub use crate::chain::LEAST_SINE;

/// Compensated joint commands, with the errors before and after.
///
/// Errors are ΔX, real minus target: three lengths in `F_0`, then the rotation vector in rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compensated<Q> {
    /// Commands within the limits.
    pub q: Q,
    /// ΔX at the original commands.
    pub before: [f64; 6],
    /// ΔX at `q`.
    pub after: [f64; 6],
    /// `true` if the last iteration moved no variable by more than [`REST`]. If `false`, more than
    /// [`ITERATIONS`] are needed.
    pub converged: bool,
}

/// Returns the norms of the position and of the rotation of a ΔX, in the manipulator's length unit
/// and in rad.
pub fn norms(rows: &[f64; 6]) -> (f64, f64) {
    let norm = |v: &[f64]| Scalar::sqrt(dot(v, v));
    (norm(&rows[..3]), norm(&rows[3..]))
}

/// Computes commands that bring the real tool to `target`, near `start` and within the limits of
/// the variables.
///
/// `step` returns the real pose at a configuration and fills in the nominal `J_q` with
/// rotation-vector rows, one column per variable, as a generated `compensator_step` does. It is
/// called `ITERATIONS + 1` times, with `columns` as scratch space. The result is the best
/// configuration evaluated; it is never worse than `start` if `start` is within the limits. Where
/// position and rotation cannot both be reached, position has priority (1 rad weighs as much as 1
/// mm).
///
/// [`Compensated::after`] is the remaining error. It is not zero where a limit, too few joints or a
/// singularity prevents reaching the target, or where more iterations are needed
/// ([`Compensated::converged`] is `false`). `abbe::analysis::compensated` iterates as often as
/// necessary. Returns an error only if `step` does.
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

/// Least-squares problem, with lengths in metres and angles in rad.
struct Problem<'a> {
    variables: &'a [Variable],
    /// One metre in the manipulator's unit.
    metre: f64,
}

impl Problem<'_> {
    fn weighted(&self, [x, y, z, a, b, c]: [f64; 6]) -> [f64; 6] {
        let (length, angle) = (1.0 / self.metre, LEVER);
        [x * length, y * length, z * length, a * angle, b * angle, c * angle]
    }

    /// Returns one metre or one rad in the unit of the variable.
    fn unit(&self, j: usize) -> f64 {
        match self.variables[j].kind {
            VariableKind::Revolute => 1.0,
            VariableKind::Prismatic => self.metre,
        }
    }

    /// Returns the largest change of a variable, in metres and rad.
    fn largest_step(&self, from: &[f64], to: &[f64]) -> f64 {
        let steps = from.iter().zip(to).enumerate();
        steps.map(|(j, (from, to))| Scalar::abs(to - from) / self.unit(j)).fold(0.0, f64::max)
    }

    fn within(&self, q: &[f64]) -> bool {
        self.variables.iter().zip(q).all(|(variable, value)| clamped(variable, *value) == *value)
    }

    /// Sets `q` to `start + d`. Clamps the variable furthest beyond a limit, then solves again for
    /// the others, until all are within their limits. Consumes the columns.
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
                // Clamped, or without effect on the tool.
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

/// Solution of `(JᵀJ + λ)⁻¹ Jᵀ b = Jᵀ (J Jᵀ + λ)⁻¹ b`, from the smaller of the two matrices.
enum Departure {
    /// `d` itself, for six joints or fewer.
    Primal([f64; 6]),
    /// `(J Jᵀ + λ)⁻¹ b`, for more than six joints.
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

/// Returns `(M + λ)⁻¹ b` by the Cholesky decomposition `L Lᵀ`, for M positive semidefinite. Reads
/// only its lower triangle.
fn solve(mut m: [[f64; 6]; 6], mut b: [f64; 6]) -> [f64; 6] {
    for i in 0..6 {
        for j in 0..=i {
            let rest = m[i][j] - dot(&m[i][..j], &m[j][..j]);
            // Rounding must not make a pivot smaller than λ.
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

    /// Returns arbitrary columns of full rank.
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

    /// Fewer joints: the residual is orthogonal to all columns.
    #[test]
    fn fewer_than_six_are_least_squares() {
        let (columns, b) = (columns::<4>(), [1.0, -2.0, 3.0, 0.5, 0.0, 7.0]);
        let d = departure(&columns, &b);
        let left: [f64; 6] =
            core::array::from_fn(|i| b[i] - columns.iter().zip(d).map(|(c, d)| c[i] * d).sum::<f64>());
        columns.iter().for_each(|column| assert!(dot(column, &left).abs() < 1e-6));
    }

    /// More joints: the shortest solution is orthogonal to the null space.
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
