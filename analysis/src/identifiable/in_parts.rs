//! The rank of a chain of any length, computed from parts with separate joints.
//!
//! As seen from the tool, an error `ε_i` before the transform `A_{i+1}` contributes
//! `P Ad(A_{i+1} … A_n T)⁻¹ ε_i`, where `P` projects to the measured rows. Let `A = A_1 … A_b` be
//! the first part, `M_i(q) = Ad(A_{i+1} … A_b)⁻¹`, and `S` the rest of the chain. The contributions
//! of unobservable errors add up to zero at every configuration, and therefore also if only the
//! first part moves from `q` to `q′`:
//!
//! ```text
//! D ε = P Ad(S)⁻¹ Σ_{i<b} (M_i(q) − M_i(q′)) ε_i = 0        for all q, q′, S
//! ```
//!
//! since the rest has not moved. Then the observable part of `μ = Σ_{i<b} M_i ε_i` is the same at
//! every configuration: the errors of the part act like `μ` at frame b, and it remains to determine
//! whether the rest of the chain observes `ε_b + μ, ε_{b+1}, …`. So the space of unobservable
//! errors is the product of that of `D` and that of the rest, and
//!
//! ```text
//! rank(chain) = rank(D) + rank(rest)
//! ```
//!
//! for any parts that share no variable. The last part has no rest to move against; its rank is
//! that of the sum itself. For a lower pair and measured poses, the kernel of `D` is that of its
//! `ad(S_i)`: 4 errors remain for each revolute joint, 2 for each prismatic one, 0 for a fixed
//! frame, and 6 for the last part.

use nalgebra::DMatrix;

use super::{Identifiability, Measurement, Parts, identifiable, not_finite, singular_values};
use crate::{Configuration, Unevaluated, sampling};
use abbe_core::{Component, Manipulator, Pose, Quantity, checks};

/// Computes the same as [`identifiable`](super::identifiable()), part by part. The work and the
/// rounding errors grow linearly with the length of the chain, not with its cube.
///
/// Each part moves through the configurations while the rest stays at others. The joint values must
/// therefore be independent, as those of [`random_joint_samples`](crate::random_joint_samples) are.
/// Three times [`Parts::longest`] configurations suffice: the rows then outnumber the unknowns of
/// every part by half if points are measured, and by more if poses are.
///
/// For a tree of frames this is [`identifiable`] itself.
///
/// Returns [`Error::Count`](abbe_core::Error::Count) if `parts` are not those of `A_1 … A_n, T`.
pub fn identifiable_in_parts(
    manipulator: &dyn Manipulator,
    parts: &Parts,
    configurations: &[Configuration],
    measurement: Measurement,
    base: bool,
) -> Result<Identifiability, Unevaluated> {
    let at = |configuration, error| Unevaluated { configuration, error };
    if !manipulator.description().is_chain() {
        return identifiable(manipulator, configurations, measurement, base);
    }
    let frames = manipulator.description().frames.len();
    checks::length(Quantity::Pose, [frames + 1, 1], parts.transforms()).map_err(|error| at(None, error))?;
    let mut transforms = vec![vec![Pose::IDENTITY; frames + 1]; configurations.len()];
    for (i, (Configuration { q, s, .. }, transforms)) in
        configurations.iter().zip(&mut transforms).enumerate()
    {
        manipulator.transforms(q, s, transforms).map_err(|error| at(Some(i), error))?;
    }

    let unknowns = 6 * (frames + usize::from(base));
    let mut values = Vec::with_capacity(unknowns);
    // Tool points relative to the end of the part.
    let mut points = vec![[0.0; 3]; configurations.len()];
    for range in parts.ranges.iter().rev() {
        // Products of its transforms from each one to the end of the part.
        let mut tails: Vec<Vec<Pose>> =
            transforms.iter().map(|transforms| transforms[range.clone()].to_vec()).collect();
        for tails in &mut tails {
            for i in (1..tails.len()).rev() {
                tails[i - 1] = tails[i - 1].then(&tails[i]);
            }
        }
        let is_last = range.end == frames + 1;
        // The first transform follows the base frame.
        let skipped = usize::from(range.start == 0 && !base);
        let matrix = part(&tails, &points, measurement, is_last, skipped);
        values.extend(singular_values(triangle(matrix)).ok_or_else(|| at(None, not_finite()))?);
        for (point, tails) in points.iter_mut().zip(&tails) {
            *point = tails[0].apply(*point);
        }
    }
    Ok(Identifiability::new(unknowns, values))
}

/// Returns `D`, or the sum itself for the last part: a block of rows per configuration, a column
/// per error. Lengths are relative to the size of the part, so that all columns of `M_i` are of
/// order 1. Rows are divided by the root of their number.
fn part(
    tails: &[Vec<Pose>],
    points: &[[f64; 3]],
    measurement: Measurement,
    is_last: bool,
    skipped: usize,
) -> DMatrix<f64> {
    let count = tails.len();
    let rows = measurement.rows();
    let columns = 6 * (tails.first().map_or(0, Vec::len) - skipped);
    let points: Vec<[f64; 3]> = match measurement {
        Measurement::Pose => vec![[0.0; 3]; count],
        Measurement::Point => points.to_vec(),
    };
    let origins = tails.iter().flatten().map(Pose::position).chain(points.iter().copied());
    let length = origins.map(sampling::norm).fold(0.0, f64::max);
    let length = if length > 0.0 { length } else { 1.0 };
    let weight = 1.0 / (count as f64).sqrt();
    let mut matrix = DMatrix::zeros(rows * count, columns);
    for j in 0..count {
        let (moved, point) = (&tails[(j + 1) % count], points[(j + 2) % count]);
        let each = tails[j].iter().zip(moved).skip(skipped);
        for (i, (tail, moved)) in each.enumerate() {
            for component in Component::ALL {
                let here = motion(tail, component, point, length);
                let there = if is_last { [0.0; 6] } else { motion(moved, component, point, length) };
                for k in 0..rows {
                    let column = 6 * i + component.index();
                    matrix[(rows * j + k, column)] = weight * (here[k] - there[k]);
                }
            }
        }
    }
    matrix
}

/// Returns the velocity of a point of the frame at `tail` by an error, and its rotation, in the
/// axes of that frame.
fn motion(tail: &Pose, component: Component, point: [f64; 3], length: f64) -> [f64; 6] {
    let axis = component.axis();
    let [x, y, z, _] = tail.0;
    let along = [x[axis], y[axis], z[axis]];
    if !component.is_rotation() {
        return [along[0], along[1], along[2], 0.0, 0.0, 0.0];
    }
    let lever = tail.apply(point);
    let mut velocity = [0.0; 3];
    let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
    velocity[next] = -lever[last] / length;
    velocity[last] = lever[next] / length;
    let turned = [x, y, z].map(|axis| (0..3).map(|k| axis[k] * velocity[k]).sum());
    let [u, v, w] = turned;
    [u, v, w, along[0], along[1], along[2]]
}

/// Returns a matrix with the same singular values and at most as many rows as columns.
fn triangle(matrix: DMatrix<f64>) -> DMatrix<f64> {
    if matrix.is_empty() { matrix } else { matrix.qr().r() }
}
