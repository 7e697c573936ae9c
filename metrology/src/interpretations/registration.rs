//! Fits base and tool in closed form, or from there by least squares.
//!
//! The measurements are `M_i = X P_i Y` with predicted poses `P_i`. The rotations between rows do
//! not depend on Y: `log(M_i M_jᵀ) = R_X log(P_i P_jᵀ)`. So `R_X` is the rotation between two sets
//! of vectors, `R_Y` the mean of the remaining rotations, and both translations follow from linear
//! equations. With positions alone, base and tool point are fitted together from the base alone:
//! with `x_i = X P_i y` and the rotation `R_i` of `X P_i`, `δx_i = δθ × (x_i − c) + δb + R_i δy`
//! about the centroid c (Levenberg and Marquardt).

use abbe::Pose;
use nalgebra::{DMatrix, DVector, Matrix3, Rotation3, SMatrix, SVector, Vector3};

/// Largest number of steps.
const STEPS: usize = 30;

/// Returns the predicted poses with base, tool or both fitted; and the fitted pose of `F_0` in the
/// frame of the rows and that of the tool in the tool frame of the spec.
pub(super) fn registered(
    predicted: &[Pose],
    measured: &[Pose],
    oriented: bool,
    lever: f64,
    [base, tool]: [bool; 2],
) -> Option<(Vec<Pose>, [Pose; 2])> {
    let (moved, tool) = match (base, tool, oriented) {
        (false, false, _) => (predicted.to_vec(), Pose::IDENTITY),
        (true, false, _) => (with_base(predicted, measured, oriented, lever)?, Pose::IDENTITY),
        (false, true, _) => with_tool(predicted, measured, oriented)?,
        (true, true, true) => with_base_and_tool(predicted, measured)?,
        (true, true, false) => with_base_and_point(predicted, measured, lever)?,
    };
    let base = moved.first()?.then(&predicted.first()?.then(&tool).inverse());
    let mut numbers = moved.iter().flat_map(|pose| pose.0.as_flattened());
    numbers.all(|x| x.is_finite()).then_some((moved, [base, tool]))
}

/// Returns `X P_i Y` with a translation Y, fitted to positions, and Y.
fn with_base_and_point(predicted: &[Pose], measured: &[Pose], lever: f64) -> Option<(Vec<Pose>, Pose)> {
    let (mut moved, mut tool) = (with_base(predicted, measured, false, lever)?, Pose::IDENTITY);
    let away = |moved: &[Pose]| -> f64 {
        moved.iter().zip(measured).map(|(a, b)| (vector(b.0[3]) - vector(a.0[3])).norm_squared()).sum()
    };
    let (mut squares, mut damping) = (away(&moved), 1e-3);
    for _ in 0..STEPS {
        let centre = moved.iter().map(|pose| vector(pose.0[3])).sum::<Vector3<f64>>() / moved.len() as f64;
        let (mut normal, mut right) = (SMatrix::<f64, 9, 9>::zeros(), SVector::<f64, 9>::zeros());
        for (moved, measured) in moved.iter().zip(measured) {
            let mut rows = SMatrix::<f64, 3, 9>::zeros();
            let arm = vector(moved.0[3]) - centre;
            rows.fixed_view_mut::<3, 3>(0, 0).copy_from(&-arm.cross_matrix());
            rows.fixed_view_mut::<3, 3>(0, 3).copy_from(&Matrix3::identity());
            rows.fixed_view_mut::<3, 3>(0, 6).copy_from(&rotation(moved));
            normal += rows.transpose() * rows;
            right += rows.transpose() * (vector(measured.0[3]) - vector(moved.0[3]));
        }
        let diagonal = normal.diagonal();
        (0..9).for_each(|i| normal[(i, i)] += damping * diagonal[i] + f64::MIN_POSITIVE);
        let Some(step) = normal.cholesky().map(|root| root.solve(&right)) else { break };
        let turn = Rotation3::from_scaled_axis(step.fixed_rows::<3>(0).into_owned()).into_inner();
        let base = pose(&turn, centre - turn * centre + step.fixed_rows::<3>(3));
        let point = pose(&Matrix3::identity(), step.fixed_rows::<3>(6).into_owned());
        let next: Vec<Pose> = moved.iter().map(|pose| base.then(pose).then(&point)).collect();
        let left = away(&next);
        if left < squares {
            let is_done = squares - left <= 1e-6 * squares;
            (moved, tool, squares, damping) = (next, tool.then(&point), left, 0.1 * damping);
            if is_done {
                break;
            }
        } else if damping > 1e6 {
            break;
        } else {
            damping *= 10.0;
        }
    }
    Some((moved, tool))
}

fn vector(v: [f64; 3]) -> Vector3<f64> {
    v.into()
}

fn rotation(pose: &Pose) -> Matrix3<f64> {
    Matrix3::from_columns(&[vector(pose.0[0]), vector(pose.0[1]), vector(pose.0[2])])
}

fn pose(rotation: &Matrix3<f64>, position: Vector3<f64>) -> Pose {
    let column = |i: usize| rotation.column(i).into_owned().into();
    Pose([column(0), column(1), column(2), position.into()])
}

/// Returns the rotation nearest to `Σ b aᵀ`, which rotates the vectors a onto the vectors b.
fn nearest(sum: &Matrix3<f64>) -> Option<Matrix3<f64>> {
    let svd = sum.try_svd(true, true, f64::EPSILON, 100)?;
    let (u, vt) = (svd.u?, svd.v_t?);
    let sign = (u * vt).determinant().signum();
    Some(u * Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, sign)) * vt)
}

/// Returns `X P_i`, fitted to the positions and, with orientations, to points on the three axes at
/// the lever distance.
fn with_base(predicted: &[Pose], measured: &[Pose], oriented: bool, lever: f64) -> Option<Vec<Pose>> {
    let rows = predicted.len() as f64;
    let mean = |poses: &[Pose]| poses.iter().map(|pose| vector(pose.0[3])).sum::<Vector3<f64>>() / rows;
    let (from, to) = (mean(predicted), mean(measured));
    let mut sum = Matrix3::zeros();
    for (predicted, measured) in predicted.iter().zip(measured) {
        sum += (vector(measured.0[3]) - to) * (vector(predicted.0[3]) - from).transpose();
        if oriented {
            sum += lever * lever * rotation(measured) * rotation(predicted).transpose();
        }
    }
    let turn = nearest(&sum)?;
    let base = pose(&turn, to - turn * from);
    Some(predicted.iter().map(|predicted| base.then(predicted)).collect())
}

/// Returns `P_i Y` and Y.
fn with_tool(predicted: &[Pose], measured: &[Pose], oriented: bool) -> Option<(Vec<Pose>, Pose)> {
    let rows = predicted.len() as f64;
    let pairs = || predicted.iter().zip(measured);
    let point = pairs()
        .map(|(predicted, measured)| {
            rotation(predicted).transpose() * (vector(measured.0[3]) - vector(predicted.0[3]))
        })
        .sum::<Vector3<f64>>()
        / rows;
    let turn = match oriented {
        true => nearest(
            &pairs().map(|(predicted, measured)| rotation(predicted).transpose() * rotation(measured)).sum(),
        )?,
        false => Matrix3::identity(),
    };
    let tool = pose(&turn, point);
    Some((predicted.iter().map(|predicted| predicted.then(&tool)).collect(), tool))
}

/// Returns `X P_i Y` of poses, and Y.
fn with_base_and_tool(predicted: &[Pose], measured: &[Pose]) -> Option<(Vec<Pose>, Pose)> {
    let count = predicted.len();
    let turns = |poses: &[Pose]| -> Vec<Matrix3<f64>> { poses.iter().map(rotation).collect() };
    let (predicted_rotations, measured_rotations) = (turns(predicted), turns(measured));
    let mut sum = Matrix3::zeros();
    for i in 0..count {
        for j in 0..i {
            let a = skew_part(&(predicted_rotations[i] * predicted_rotations[j].transpose()));
            let b = skew_part(&(measured_rotations[i] * measured_rotations[j].transpose()));
            sum += b * a.transpose();
        }
    }
    let base = nearest(&sum)?;
    let rest = |i: usize| (base * predicted_rotations[i]).transpose() * measured_rotations[i];
    let tool = nearest(&(0..count).map(rest).sum())?;
    // m = R_X (p + R_P t) + b is linear in t and b.
    let (mut matrix, mut right) = (DMatrix::zeros(3 * count, 6), DVector::zeros(3 * count));
    for i in 0..count {
        matrix.view_mut((3 * i, 0), (3, 3)).copy_from(&(base * predicted_rotations[i]));
        matrix.view_mut((3 * i, 3), (3, 3)).copy_from(&Matrix3::identity());
        right.rows_mut(3 * i, 3).copy_from(&(vector(measured[i].0[3]) - base * vector(predicted[i].0[3])));
    }
    let svd = matrix.try_svd(true, true, f64::EPSILON, 200)?;
    let solution = svd.solve(&right, 1e-9 * svd.singular_values.max()).ok()?;
    let point = Vector3::new(solution[0], solution[1], solution[2]);
    let place = Vector3::new(solution[3], solution[4], solution[5]);
    let (base, tool) = (pose(&base, place), pose(&tool, point));
    Some((predicted.iter().map(|predicted| base.then(predicted).then(&tool)).collect(), tool))
}

/// Returns `sin θ` times the axis of a rotation. It is zero at θ = π, where the sign of the axis is
/// undefined.
fn skew_part(turn: &Matrix3<f64>) -> Vector3<f64> {
    0.5 * Vector3::new(turn[(2, 1)] - turn[(1, 2)], turn[(0, 2)] - turn[(2, 0)], turn[(1, 0)] - turn[(0, 1)])
}
