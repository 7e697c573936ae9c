//! Base and tool that fit best, in closed form.
//!
//! Seen are `M_i = X P_i Y` for predicted `P_i`. Of poses, the turns between rows are those of the machine turned by X:
//! `log(M_i M_jᵀ) = R_X log(P_i P_jᵀ)`, whatever Y is; so `R_X` is the turn between two sets of vectors, `R_Y` the mean of what
//! is left, and both translations follow from linear equations. Of positions alone, the point and the place of the base are found in
//! turns.

use abbe::Pose;
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

/// How often point and base are found in turns.
const TURNS: usize = 12;

/// The predictions with the base, the tool or both where they fit best, and that tool as the one of the spec sees it.
pub(super) fn registered(
    predicted: &[Pose],
    seen: &[Pose],
    oriented: bool,
    lever: f64,
    [base, tool]: [bool; 2],
) -> Option<(Vec<Pose>, Pose)> {
    let (moved, tool) = match (base, tool, oriented) {
        (false, false, _) => (predicted.to_vec(), Pose::IDENTITY),
        (true, false, _) => (placed(predicted, seen, oriented, lever)?, Pose::IDENTITY),
        (false, true, _) => held(predicted, seen, oriented)?,
        (true, true, true) => both(predicted, seen)?,
        (true, true, false) => {
            let (mut moved, mut tool) = (placed(predicted, seen, false, lever)?, Pose::IDENTITY);
            for _ in 0..TURNS {
                let (next, step) = held(&moved, seen, false)?;
                (moved, tool) = (placed(&next, seen, false, lever)?, tool.then(&step));
            }
            (moved, tool)
        }
    };
    moved.iter().all(|pose| pose.0.as_flattened().iter().all(|x| x.is_finite())).then_some((moved, tool))
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

/// The rotation nearest to `Σ b aᵀ`: it turns the vectors a to the vectors b.
fn nearest(sum: &Matrix3<f64>) -> Option<Matrix3<f64>> {
    let svd = sum.try_svd(true, true, f64::EPSILON, 100)?;
    let (u, vt) = (svd.u?, svd.v_t?);
    let sign = (u * vt).determinant().signum();
    Some(u * Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, sign)) * vt)
}

/// `X P_i`, by the points of all poses: their positions, and on three axes at the lever if they were seen.
fn placed(predicted: &[Pose], seen: &[Pose], oriented: bool, lever: f64) -> Option<Vec<Pose>> {
    let rows = predicted.len() as f64;
    let mean = |poses: &[Pose]| poses.iter().map(|pose| vector(pose.0[3])).sum::<Vector3<f64>>() / rows;
    let (from, to) = (mean(predicted), mean(seen));
    let mut sum = Matrix3::zeros();
    for (predicted, seen) in predicted.iter().zip(seen) {
        sum += (vector(seen.0[3]) - to) * (vector(predicted.0[3]) - from).transpose();
        if oriented {
            sum += lever * lever * rotation(seen) * rotation(predicted).transpose();
        }
    }
    let turn = nearest(&sum)?;
    let base = pose(&turn, to - turn * from);
    Some(predicted.iter().map(|predicted| base.then(predicted)).collect())
}

/// `P_i Y`, and Y.
fn held(predicted: &[Pose], seen: &[Pose], oriented: bool) -> Option<(Vec<Pose>, Pose)> {
    let rows = predicted.len() as f64;
    let pairs = || predicted.iter().zip(seen);
    let point = pairs()
        .map(|(predicted, seen)| {
            rotation(predicted).transpose() * (vector(seen.0[3]) - vector(predicted.0[3]))
        })
        .sum::<Vector3<f64>>()
        / rows;
    let turn = match oriented {
        true => {
            nearest(&pairs().map(|(predicted, seen)| rotation(predicted).transpose() * rotation(seen)).sum())?
        }
        false => Matrix3::identity(),
    };
    let tool = pose(&turn, point);
    Some((predicted.iter().map(|predicted| predicted.then(&tool)).collect(), tool))
}

/// `X P_i Y` of poses, and Y.
fn both(predicted: &[Pose], seen: &[Pose]) -> Option<(Vec<Pose>, Pose)> {
    let count = predicted.len();
    let turns = |poses: &[Pose]| -> Vec<Matrix3<f64>> { poses.iter().map(rotation).collect() };
    let (of_predicted, of_seen) = (turns(predicted), turns(seen));
    let mut sum = Matrix3::zeros();
    for i in 0..count {
        for j in 0..i {
            let a = skew_part(&(of_predicted[i] * of_predicted[j].transpose()));
            let b = skew_part(&(of_seen[i] * of_seen[j].transpose()));
            sum += b * a.transpose();
        }
    }
    let base = nearest(&sum)?;
    let rest = |i: usize| (base * of_predicted[i]).transpose() * of_seen[i];
    let tool = nearest(&(0..count).map(rest).sum())?;
    // m = R_X (p + R_P t) + b, linear in t and b.
    let (mut matrix, mut right) = (DMatrix::zeros(3 * count, 6), DVector::zeros(3 * count));
    for i in 0..count {
        matrix.view_mut((3 * i, 0), (3, 3)).copy_from(&(base * of_predicted[i]));
        matrix.view_mut((3 * i, 3), (3, 3)).copy_from(&Matrix3::identity());
        right.rows_mut(3 * i, 3).copy_from(&(vector(seen[i].0[3]) - base * vector(predicted[i].0[3])));
    }
    let svd = matrix.try_svd(true, true, f64::EPSILON, 200)?;
    let solution = svd.solve(&right, 1e-9 * svd.singular_values.max()).ok()?;
    let point = Vector3::new(solution[0], solution[1], solution[2]);
    let place = Vector3::new(solution[3], solution[4], solution[5]);
    let (base, tool) = (pose(&base, place), pose(&tool, point));
    Some((predicted.iter().map(|predicted| base.then(predicted).then(&tool)).collect(), tool))
}

/// `sin θ` times the axis of a turn: turned as the axis is, and nothing where the axis has no sign.
fn skew_part(turn: &Matrix3<f64>) -> Vector3<f64> {
    0.5 * Vector3::new(turn[(2, 1)] - turn[(1, 2)], turn[(0, 2)] - turn[(2, 0)], turn[(1, 0)] - turn[(0, 1)])
}
