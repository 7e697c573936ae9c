//! Pose of the measured frame from the pixels of one view of a board.
//!
//! With `(x, y)` the undistorted corners and `(X, Y)` their coordinates in a plane of the board,
//! `(x, y, 1) ∝ H (X, Y, 1)` and `H ∝ [r_1 r_2 t]`: Zhang, *A flexible new technique for camera
//! calibration*, 2000. Corners that lie in no plane give `x (1 + ε) = (r_x P + t_x) / t_z` with
//! `ε = r_z P / t_z`, and with y alike: DeMenthon and Davis, *Model-based object pose in 25 lines of
//! code*, 1995. Gauss-Newton steps then minimize the distances in the image plane.

use std::borrow::Cow;

use nalgebra::{Matrix3, Matrix4, Matrix6, SMatrix, Vector3, Vector4, Vector6};

use super::{Measurement, Model, Observation};
use abbe_analysis::decompose::{svd3, symmetric_eigen};
use abbe_analysis::sampling::vectors::{cross, dot};
use abbe_core::{Pose, displacement};

/// Corner on the board, and `(x, y)` of its line of sight.
type Sight = ([f64; 3], [f64; 2]);

/// Number of iterations for corners in no plane.
const ITERATIONS: usize = 50;

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
        let corners = corners.filter_map(|(pixel, corner)| match (pixel, corner[0].corner) {
            ([Some(u), Some(v)], corner) => Some((corner, [*u, *v])),
            _ => None,
        });
        let corners: Vec<([f64; 3], [f64; 2])> = corners.collect();
        let sight = |(corner, pixel): &([f64; 3], [f64; 2])| (*corner, camera.undistorted(*pixel));
        let sights: Vec<Sight> = corners.iter().map(sight).collect();
        let board = placed(&sights)?;
        let square = |(corner, [u, v]): &([f64; 3], [f64; 2])| {
            let [a, b] = camera.pixel(board.apply(*corner));
            (a - u).powi(2) + (b - v).powi(2)
        };
        let square = corners.iter().map(square).sum::<f64>() / corners.len() as f64;
        let (_, size) = scaling(corners.iter().map(|(_, pixel)| *pixel))?;
        let pose = if camera.is_on_tool { board.inverse() } else { board };
        Some(BoardView { pose, rms: square.sqrt(), extent: size.recip() })
    }
}

/// Returns the mean of points, and the reciprocal of their root mean square distance from it.
fn scaling(points: impl Iterator<Item = [f64; 2]> + Clone) -> Option<([f64; 2], f64)> {
    let n = points.clone().count() as f64;
    let mean = [0, 1].map(|k| points.clone().map(|point| point[k]).sum::<f64>() / n);
    let square = points.map(|[x, y]| (x - mean[0]).powi(2) + (y - mean[1]).powi(2)).sum::<f64>() / n;
    (square > 0.0).then(|| (mean, square.sqrt().recip()))
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
    let axes = svd3(scatter.sum())?.u?;
    let [x, y] = [0, 1].map(|k| axes.column(k).into_owned());
    let plane = Pose([x.into(), y.into(), x.cross(&y).into(), mean.into()]).inverse();
    let in_plane: Vec<Sight> = sights.iter().map(|(corner, sight)| (plane.apply(*corner), *sight)).collect();
    let starts = [from_homography(&in_plane), from_perspective(&in_plane)].into_iter().flatten();
    let starts = starts.flat_map(|start| [start, mirrored(&start)]);
    let ends = starts.filter_map(|start| refined(start.then(&plane), sights));
    let left = |board: &Pose| -> f64 {
        let off = sights.iter().map(|(corner, sight)| {
            let [x, y, z] = board.apply(*corner);
            (x / z - sight[0]).powi(2) + (y / z - sight[1]).powi(2)
        });
        off.sum()
    };
    ends.min_by(|a, b| left(a).total_cmp(&left(b)))
}

/// Returns the pose from which corners in the plane z = 0 look alike far away: the normal of the
/// plane is mirrored in the line of sight.
fn mirrored(&Pose([x, y, z, position]): &Pose) -> Pose {
    let along = |axis: [f64; 3]| 2.0 * dot(axis, position) / dot(position, position);
    let less = |axis: [f64; 3]| core::array::from_fn(|k| axis[k] - along(axis) * position[k]);
    Pose([less(x), less(y), less(z).map(|part: f64| -part), position])
}

/// Returns the pose of corners in no plane.
fn from_perspective(sights: &[Sight]) -> Option<Pose> {
    let point = |corner: &[f64; 3]| Vector4::new(corner[0], corner[1], corner[2], 1.0);
    let normal: Matrix4<f64> =
        sights.iter().map(|(corner, _)| point(corner) * point(corner).transpose()).sum();
    let inverse = normal.try_inverse()?;
    let (mut toward, mut found) = (Vector4::new(0.0, 0.0, 0.0, 1.0), None);
    for _ in 0..ITERATIONS {
        let row = |k: usize| {
            let scaled = sights.iter().map(|(corner, sight)| {
                let point = point(corner);
                point * (sight[k] * toward.dot(&point))
            });
            inverse * scaled.sum::<Vector4<f64>>()
        };
        let [across, down] = [0, 1].map(row);
        let [x, y]: [Vector3<f64>; 2] = [across.xyz(), down.xyz()];
        let depth = (x.norm() * y.norm()).sqrt().recip();
        let svd = svd3(Matrix3::from_columns(&[x * depth, y * depth, x.cross(&y) * (depth * depth)]))?;
        let rotation = (svd.u? * svd.v_t?).transpose();
        let [a, b, c] = [0, 1, 2].map(|k| rotation.column(k).into());
        found = Some(Pose([a, b, c, [across[3] * depth, down[3] * depth, depth]]));
        let along = rotation.row(2) / depth;
        toward = Vector4::new(along[0], along[1], along[2], 1.0);
    }
    found
}

/// Returns the pose of corners in the plane z = 0 from their homography; none if they are
/// collinear.
fn from_homography(sights: &[Sight]) -> Option<Pose> {
    let (from, a) = scaling(sights.iter().map(|([x, y, _], _)| [*x, *y]))?;
    let (to, b) = scaling(sights.iter().map(|(_, sight)| *sight))?;
    let mut normal = SMatrix::<f64, 9, 9>::zeros();
    for ([x, y, _], [u, v]) in sights {
        let (x, y) = (a * (x - from[0]), a * (y - from[1]));
        let (u, v) = (b * (u - to[0]), b * (v - to[1]));
        for row in
            [[x, y, 1.0, 0.0, 0.0, 0.0, -u * x, -u * y, -u], [0.0, 0.0, 0.0, x, y, 1.0, -v * x, -v * y, -v]]
        {
            let row = SMatrix::<f64, 9, 1>::from(row);
            normal += row * row.transpose();
        }
    }
    let eigen = symmetric_eigen(normal)?;
    let mut order: Vec<usize> = (0..9).collect();
    order.sort_by(|i, j| eigen.eigenvalues[*i].total_cmp(&eigen.eigenvalues[*j]));
    if eigen.eigenvalues[order[1]] < 1e-9 * eigen.eigenvalues[order[8]] {
        return None;
    }
    let h = Matrix3::from_row_slice(eigen.eigenvectors.column(order[0]).as_slice());
    // Back to the coordinates before scaling: H = S_to⁻¹ h S_from.
    let scale = |k: f64, [x, y]: [f64; 2]| Matrix3::new(k, 0.0, -k * x, 0.0, k, -k * y, 0.0, 0.0, 1.0);
    let h = scale(b, to).try_inverse()? * h * scale(a, from);
    let size = (h.column(0).norm() * h.column(1).norm()).sqrt();
    // The board is in front of the camera.
    let h = h / if h[(2, 2)] < 0.0 { -size } else { size };
    let (first, second): (Vector3<f64>, Vector3<f64>) = (h.column(0).into(), h.column(1).into());
    let svd = svd3(Matrix3::from_columns(&[first, second, first.cross(&second)]))?;
    let rotation = svd.u? * svd.v_t?;
    let [x, y, z] = [0, 1, 2].map(|k| rotation.column(k).into());
    Some(Pose([x, y, z, h.column(2).into()]))
}

/// Minimizes the distances in the image plane.
fn refined(mut board: Pose, sights: &[Sight]) -> Option<Pose> {
    for _ in 0..20 {
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
                let gradient: [f64; 3] = core::array::from_fn(|i| {
                    if i == k {
                        1.0 / z
                    } else if i == 2 {
                        -point[k] / (z * z)
                    } else {
                        0.0
                    }
                });
                let about = cross(arm, gradient);
                let row = Vector6::new(gradient[0], gradient[1], gradient[2], about[0], about[1], about[2]);
                normal += row * row.transpose();
                right += row * (sight[k] - point[k] / z);
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
    board.0.as_flattened().iter().all(|value| value.is_finite()).then_some(board)
}

#[cfg(test)]
mod tests;
