//! The numbers whose tool is nearest to the real one, over the workspace.
//!
//! Gauss-Newton: with the tool's difference `r = X_real − X_table(x)`, an angle counting as the reach times itself, the step is
//!
//! ```text
//! δx = V Λ⁺ Vᵀ Jᵀ r         JᵀJ = V Λ Vᵀ
//! ```
//!
//! where `Λ⁺` leaves out what is hardly seen: a sum of numbers that does nothing, and what only numbers beyond all measure would
//! do. Those stay as they are. The column of a motion with prefix `(R, p)` is `(R e; 0)`, or `(R a × (p_T − p); R a)`.

use abbe::{Orientation, Pose, deviation};
use abbe_spec::DhNumber;
use abbe_spec::expr::Motion;
use nalgebra::{DMatrix, DVector, SymmetricEigen};

use super::rows::{Table, motion};
use crate::export::found::Found;

/// Singular values below this part of the largest are left out, squared.
const HARDLY_SEEN: f64 = 1e-6;

/// How many configurations are looked at: some hundred times the unknowns of a row.
const CONFIGURATIONS: usize = 200;

const STEPS: usize = 20;

pub(super) fn fit(table: &mut Table, found: &Found) {
    let count = 4 * table.rows.len();
    let reach = table.reach();
    for _ in 0..STEPS {
        let (mut square, mut right) = (DMatrix::zeros(count, count), DVector::zeros(count));
        let places = found.configurations.iter().zip(&found.real).take(CONFIGURATIONS);
        for (configuration, real) in places {
            let pose = table.pose(&configuration.q);
            let r = weighed(deviation(Orientation::RotationVector, &pose, real), reach);
            let columns = columns(table, &configuration.q, &pose, reach);
            for (i, column) in columns.iter().enumerate() {
                right[i] += dot(column, &r);
                for (j, other) in columns.iter().enumerate().take(i + 1) {
                    square[(i, j)] += dot(column, other);
                    square[(j, i)] = square[(i, j)];
                }
            }
        }
        let step = step(square, &right);
        for (row, step) in table.rows.iter_mut().zip(step.as_slice().chunks_exact(4)) {
            for (number, step) in DhNumber::ALL.into_iter().zip(step) {
                row.numbers[number as usize] += if is_turn(number) { step / reach } else { *step };
            }
        }
        if step.norm() <= 1e-15 * reach {
            break;
        }
    }
}

fn step(square: DMatrix<f64>, right: &DVector<f64>) -> DVector<f64> {
    let SymmetricEigen { eigenvectors, eigenvalues } = square.symmetric_eigen();
    let seen = eigenvalues.max() * HARDLY_SEEN;
    let mut shares = eigenvectors.transpose() * right;
    for (share, value) in shares.iter_mut().zip(&eigenvalues) {
        *share = if *value > seen { *share / value } else { 0.0 };
    }
    eigenvectors * shares
}

/// One column for every number: theta, d, a, alpha of each row. An angle counts by the reach.
fn columns(table: &Table, q: &[f64], tool: &Pose, reach: f64) -> Vec<[f64; 6]> {
    let mut columns = Vec::with_capacity(4 * table.rows.len());
    let mut prefix = table.base;
    for row in &table.rows {
        let mut of_row = [[0.0; 6]; 4];
        for (number, amount) in row.motions(table.convention, q) {
            let (kind, axis) = number.motion();
            let direction = prefix.0[axis];
            of_row[number as usize] = match kind {
                Motion::Translation => {
                    let [x, y, z] = direction;
                    [x, y, z, 0.0, 0.0, 0.0]
                }
                Motion::Rotation => {
                    let (p, t) = (prefix.position(), tool.position());
                    let lever: [f64; 3] = std::array::from_fn(|i| (t[i] - p[i]) / reach);
                    let [a, b, c] = cross(direction, lever);
                    // Weighed by the reach, per angle that counts by the reach.
                    let [x, y, z] = direction;
                    [a, b, c, x, y, z]
                }
            };
            prefix = prefix.then(&motion(number, amount));
        }
        columns.extend(of_row);
    }
    columns
}

fn weighed([x, y, z, a, b, c]: [f64; 6], reach: f64) -> [f64; 6] {
    [x, y, z, a * reach, b * reach, c * reach]
}

fn is_turn(number: DhNumber) -> bool {
    number.motion().0 == Motion::Rotation
}

fn dot(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
