//! Least-squares fit of the numbers to the real poses of the tool over the workspace.
//!
//! Gauss-Newton: with the residual `r = X_real − X_table(x)`, whose angles are multiplied by the
//! reach, the step is
//!
//! ```text
//! δx = V Λ⁺ Vᵀ Jᵀ r         JᵀJ = V Λ Vᵀ
//! ```
//!
//! where the pseudo-inverse `Λ⁺` leaves out small singular values. They belong to combinations of
//! numbers that hardly move the tool, which keep their nominal values. The column of a motion with
//! prefix `(R, p)` is `(R e; 0)`, or `(R a × (p_T − p); R a)`.

use abbe::{Orientation, Pose, deviation};
use abbe_spec::{DhNumber, expr::Motion};
use nalgebra::{DMatrix, DVector, SymmetricEigen};

use crate::dh::table::{DhTable, motion};
use crate::export::RealMachine;
use abbe::analysis::sampling::vectors::{cross, dot};

/// Largest ratio of an eigenvalue of JᵀJ to the largest one at which it is left out.
const NEGLIGIBLE: f64 = 1e-6;

/// Configurations that are fitted; each gives six residuals.
const CONFIGURATIONS: usize = 200;

/// Largest number of steps.
const STEPS: usize = 20;

/// Fits the numbers of a table to a machine, starting from its numbers.
pub(super) fn fit(table: &mut DhTable, machine: &RealMachine) {
    let count = 4 * table.rows.len();
    let reach = table.reach();
    for _ in 0..STEPS {
        let (mut square, mut right) = (DMatrix::zeros(count, count), DVector::zeros(count));
        let pairs = machine.configurations.iter().zip(&machine.real).take(CONFIGURATIONS);
        for (configuration, real) in pairs {
            let pose = table.pose(&configuration.q);
            let r = weighted(deviation(Orientation::RotationVector, &pose, real), reach);
            let columns = columns(table, &configuration.q, &pose, reach);
            for (i, column) in columns.iter().enumerate() {
                right[i] += dot(*column, r);
                for (j, other) in columns.iter().enumerate().take(i + 1) {
                    square[(i, j)] += dot(*column, *other);
                    square[(j, i)] = square[(i, j)];
                }
            }
        }
        let step = step(square, &right);
        for (row, step) in table.rows.iter_mut().zip(step.as_slice().chunks_exact(4)) {
            for (number, step) in DhNumber::ALL.into_iter().zip(step) {
                row.numbers[number as usize] += if is_angle(number) { step / reach } else { *step };
            }
        }
        if step.norm() <= 1e-15 * reach {
            break;
        }
    }
}

/// Returns the step of the fit.
fn step(square: DMatrix<f64>, right: &DVector<f64>) -> DVector<f64> {
    let SymmetricEigen { eigenvectors, eigenvalues } = square.symmetric_eigen();
    let threshold = eigenvalues.max() * NEGLIGIBLE;
    let mut shares = eigenvectors.transpose() * right;
    for (share, value) in shares.iter_mut().zip(&eigenvalues) {
        *share = if *value > threshold { *share / value } else { 0.0 };
    }
    eigenvectors * shares
}

/// Returns a column of J for theta, d, a and alpha of each row; angles of columns and numbers are
/// multiplied by the reach.
fn columns(table: &DhTable, q: &[f64], tool: &Pose, reach: f64) -> Vec<[f64; 6]> {
    let mut columns = Vec::with_capacity(4 * table.rows.len());
    let mut prefix = table.base;
    for row in &table.rows {
        let mut of_numbers = [[0.0; 6]; 4];
        for (number, amount) in row.motions(table.convention, q) {
            let (kind, axis) = number.motion();
            let direction = prefix.0[axis];
            of_numbers[number as usize] = match kind {
                Motion::Translation => {
                    let [x, y, z] = direction;
                    [x, y, z, 0.0, 0.0, 0.0]
                }
                Motion::Rotation => {
                    let (p, t) = (prefix.position(), tool.position());
                    let lever: [f64; 3] = std::array::from_fn(|i| (t[i] - p[i]) / reach);
                    let [a, b, c] = cross(direction, lever);
                    // The factor of the rows and that of the number cancel.
                    let [x, y, z] = direction;
                    [a, b, c, x, y, z]
                }
            };
            prefix = prefix.then(&motion(number, amount));
        }
        columns.extend(of_numbers);
    }
    columns
}

/// Multiplies the angles of a residual by the reach.
fn weighted([x, y, z, a, b, c]: [f64; 6], reach: f64) -> [f64; 6] {
    [x, y, z, a * reach, b * reach, c * reach]
}

fn is_angle(number: DhNumber) -> bool {
    number.motion().0 == Motion::Rotation
}
