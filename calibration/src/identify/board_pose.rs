//! Pose of the measured frame from the pixels of one view of a board.
//!
//! Far away, the image of corners about their mean is a projection along the line of sight: it has
//! two poses (DeMenthon and Davis, *Model-based object pose in 25 lines of code*, 1995).
//! Gauss-Newton steps from both, and from those that mirror what they find, minimize the distances
//! in the image.

use std::borrow::Cow;

use nalgebra::{Matrix6, Vector2, Vector3, Vector6};

use super::{Measurement, Model, Observation};
use abbe_analysis::decompose::svd3;
use abbe_analysis::sampling::vectors::{cross, dot};
use abbe_core::{Pose, displacement};

/// Corner on the board, and `(x, y)` of its line of sight.
type Sight = ([f64; 3], [f64; 2]);

/// Variance of corners beside their line, relative to the one along it, below which they have none.
const COLLINEAR: f64 = 1e-9;

/// Board in one view, fitted without the machine.
#[derive(Clone, Debug)]
pub struct BoardView {
    /// Pose of the measured frame in the frame of the instrument.
    pub pose: Pose,
    /// Root mean square distance of the pixels from those of the fitted board.
    pub rms: f64,
    /// Root mean square distance of the pixels from their mean.
    pub extent: f64,
}

impl Model<'_> {
    /// Returns rows with the poses that the camera measured, without views of fewer than four
    /// corners; without a camera, the rows themselves.
    pub fn as_poses<'o>(&self, rows: &'o [Observation]) -> Cow<'o, [Observation]> {
        if self.camera.is_none() {
            return Cow::Borrowed(rows);
        }
        let pose = |row: &Observation| {
            let measured = Measurement::Pose(Box::new(self.board_view(row)?.pose));
            Some(Observation { measured, ..row.clone() })
        };
        Cow::Owned(rows.iter().filter_map(pose).collect())
    }

    /// Fits the board to one view.
    ///
    /// Returns none without a camera, for fewer than four corners, and if they are collinear.
    pub fn board_view(&self, row: &Observation) -> Option<BoardView> {
        let (Some(camera), Measurement::Readings(readings)) = (&self.camera, &row.measured) else {
            return None;
        };
        let corners = readings.chunks_exact(2).zip(self.observables.chunks_exact(2));
        let seen = corners.filter_map(|(pixel, corner)| match (pixel, corner[0].corner) {
            ([Some(u), Some(v)], corner) => Some((corner, [*u, *v])),
            _ => None,
        });
        let corners: Vec<([f64; 3], [f64; 2])> = seen.collect();
        let sight = |(corner, pixel): &([f64; 3], [f64; 2])| (*corner, camera.undistorted(*pixel));
        let sights: Vec<Sight> = corners.iter().map(sight).collect();
        let board = placed(&sights)?;
        let square = |(corner, [u, v]): &([f64; 3], [f64; 2])| {
            let [a, b] = camera.pixel(board.apply(*corner));
            (a - u).powi(2) + (b - v).powi(2)
        };
        let square = corners.iter().map(square).sum::<f64>() / corners.len() as f64;
        let mean =
            [0, 1].map(|k| corners.iter().map(|(_, pixel)| pixel[k]).sum::<f64>() / corners.len() as f64);
        let spread = |(_, [u, v]): &([f64; 3], [f64; 2])| (u - mean[0]).powi(2) + (v - mean[1]).powi(2);
        let spread = corners.iter().map(spread).sum::<f64>() / corners.len() as f64;
        let pose = if camera.is_on_tool { board.inverse() } else { board };
        Some(BoardView { pose, rms: square.sqrt(), extent: spread.sqrt() })
    }
}

/// Returns the pose of the board in the camera; none for fewer than four corners, or if they are
/// collinear.
///
/// Corners near a plane look nearly alike from a mirrored pose: of all starts, the end that leaves
/// least counts.
fn placed(sights: &[Sight]) -> Option<Pose> {
    if sights.len() < 4 {
        return None;
    }
    let sum = sights.iter().map(|(corner, _)| Vector3::from(*corner)).sum::<Vector3<f64>>();
    let mean = sum / sights.len() as f64;
    let about = |corner: &[f64; 3]| Vector3::from(*corner) - mean;
    let scatter = sights.iter().map(|(corner, _)| about(corner) * about(corner).transpose());
    let svd = svd3(scatter.sum())?;
    let (axes, variances) = (svd.u?, svd.singular_values);
    if variances[1] < COLLINEAR * variances[0] {
        return None;
    }
    let [x, y] = [0, 1].map(|k| axes.column(k).into_owned());
    let plane = Pose([x.into(), y.into(), x.cross(&y).into(), mean.into()]).inverse();
    let in_plane: Vec<Sight> = sights.iter().map(|(corner, sight)| (plane.apply(*corner), *sight)).collect();
    let refine = |start: &Pose| refined(start.then(&plane), sights);
    let ends: Vec<(f64, Pose)> = from_far_away(&in_plane)?.iter().filter_map(refine).collect();
    let others = ends.iter().filter_map(|(_, end)| refine(&mirrored(&end.then(&plane.inverse()))));
    ends.iter().copied().chain(others).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, board)| board)
}

/// Returns the pose from which corners in the plane z = 0 look alike far away: the normal of the
/// plane is mirrored in the line of sight.
fn mirrored(&Pose([x, y, z, position]): &Pose) -> Pose {
    let along = |axis: [f64; 3]| 2.0 * dot(axis, position) / dot(position, position);
    let less = |axis: [f64; 3]| core::array::from_fn(|k| axis[k] - along(axis) * position[k]);
    Pose([less(x), less(y), less(z).map(|part: f64| -part), position])
}

/// Returns the two poses whose images far away are those of the corners; none if these are one
/// point of the image.
///
/// The origin is the mean of the corners, the axes are the principal ones. With the change `a_k` of
/// the image along the axis k and the size s of the image, `(a_1, c_1)` and `(a_2, c_2)` are
/// orthogonal and have the length s: `c_1 c_2 = −a_1 a_2`, `c_2² − c_1² = a_1² − a_2²`.
fn from_far_away(sights: &[Sight]) -> Option<[Pose; 2]> {
    let n = sights.len() as f64;
    let mean = [0, 1].map(|i| sights.iter().map(|(_, sight)| sight[i]).sum::<f64>() / n);
    let change = |k: usize, i: usize| {
        let parts =
            sights.iter().map(|(corner, sight)| (corner[k] * (sight[i] - mean[i]), corner[k] * corner[k]));
        let (sum, squares) = parts.fold((0.0, 0.0), |sums, part| (sums.0 + part.0, sums.1 + part.1));
        sum / squares
    };
    let [a, b] = [0, 1].map(|k| Vector2::new(change(k, 0), change(k, 1)));
    let (product, difference): (f64, f64) = (a.dot(&b), a.norm_squared() - b.norm_squared());
    let longer = (0.5 * (difference.abs() + difference.hypot(2.0 * product))).sqrt();
    let shorter = if longer > 0.0 { -product / longer } else { 0.0 };
    let (c, d) = if difference > 0.0 { (shorter, longer) } else { (longer, shorter) };
    let depth = a.push(c).norm().recip();
    let pose = |side: f64| {
        let [x, y] = [a.push(side * c) * depth, b.push(side * d) * depth];
        Pose([x.into(), y.into(), x.cross(&y).into(), [mean[0] * depth, mean[1] * depth, depth]])
    };
    depth.is_finite().then(|| [pose(1.0), pose(-1.0)])
}

/// Minimizes the distances in the image plane; returns the sum of their squares with the pose.
fn refined(mut board: Pose, sights: &[Sight]) -> Option<(f64, Pose)> {
    let mut left = 0.0;
    for _ in 0..20 {
        left = 0.0;
        let (mut normal, mut right) = (Matrix6::zeros(), Vector6::zeros());
        for (corner, sight) in sights {
            // A further displacement (d, ω) of the board moves its corner P by d + ω × P.
            let arm = board.turn(*corner);
            let point: [f64; 3] = core::array::from_fn(|i| arm[i] + board.0[3][i]);
            let z = point[2];
            if z <= 0.0 {
                return None;
            }
            for k in 0..2 {
                let mut gradient = [0.0, 0.0, -point[k] / (z * z)];
                gradient[k] = 1.0 / z;
                let about = cross(arm, gradient);
                let row = Vector6::new(gradient[0], gradient[1], gradient[2], about[0], about[1], about[2]);
                normal += row * row.transpose();
                right += row * (sight[k] - point[k] / z);
                left += (sight[k] - point[k] / z).powi(2);
            }
        }
        let step = normal.cholesky()?.solve(&right);
        let turn = displacement(&[0.0, 0.0, 0.0, step[4], step[5], step[3]]);
        let position = board.position();
        board.0[3] = [0.0; 3];
        board = turn.then(&board);
        board.0[3] = core::array::from_fn(|i| position[i] + step[i]);
        let angle = dot([step[3], step[4], step[5]], [step[3], step[4], step[5]]).sqrt();
        if angle < 1e-12 {
            break;
        }
    }
    board.0.as_flattened().iter().all(|value| value.is_finite()).then_some((left, board))
}

#[cfg(test)]
mod tests;
