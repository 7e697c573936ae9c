//! Closed form of the placement of robot and tool, where whole poses are measured.
//!
//! With `T_i` the pose of the tool in `F_0`, `S_i = B T_i M` is measured: of the rotations,
//! `R_Bᵀ R_S = R_T R_M`. With `K = Σ R_S ⊗ R_T`, `vec(R_Bᵀ)` and `vec(R_M)` are the first singular
//! vectors of `K`: Shah, *Solving the robot-world/hand-eye calibration problem using the Kronecker
//! product*, 2013. The translations then follow from `t_S = R_B (R_T t_M + t_T) + t_B`.

use nalgebra::{DMatrix, DVector, Matrix3, SMatrix, SVector, Vector3};

use super::{Measurement, Model, Observation, Result};
use abbe_analysis::decompose::{svd3, symmetric_eigen};
use abbe_core::Pose;

impl Model<'_> {
    /// Returns the pose of `F_0` at a station and the transform from the measured frame to that of
    /// the tool that explain measured poses best, without any start value.
    ///
    /// Returns none if the tool does not turn about two axes in these rows.
    pub fn hand_eye(&self, rows: &[Observation], station: usize) -> Result<Option<[Pose; 2]>> {
        let mut bare = Self { mountings: vec![Pose::IDENTITY; self.mountings.len()], ..self.clone() };
        bare.stations[station].pose = Pose::IDENTITY;
        let mut bare = bare.at(&vec![0.0; self.unknowns.len()]);
        let mut pairs = Vec::new();
        for row in rows.iter().filter(|row| row.station as usize == station) {
            if let Measurement::Pose(measured) = &row.measured {
                pairs.push((bare.pose(row)?, **measured));
            }
        }
        Ok(closed_form(&pairs))
    }
}

/// Solves `S = B T M` for `B` and `M`, from pairs `(T, S)`.
fn closed_form(pairs: &[(Pose, Pose)]) -> Option<[Pose; 2]> {
    let mut k = SMatrix::<f64, 9, 9>::zeros();
    for (tool, measured) in pairs {
        k += rotation(measured).kronecker(&rotation(tool));
    }
    let eigen = symmetric_eigen(k.transpose() * k)?;
    let m: SVector<f64, 9> = eigen.eigenvectors.column(eigen.eigenvalues.imax()).into();
    let b = k * m;
    // The sign of the singular vectors is that of a proper rotation.
    let as_rotation = |v: SVector<f64, 9>| {
        let matrix = Matrix3::from_column_slice(v.as_slice());
        let svd = svd3(matrix * matrix.determinant().signum())?;
        Some(svd.u? * svd.v_t?)
    };
    let (r_b, r_m) = (as_rotation(b)?.transpose(), as_rotation(m)?);
    let n = pairs.len();
    let (mut a, mut right) = (DMatrix::zeros(3 * n, 6), DVector::zeros(3 * n));
    for (i, (tool, measured)) in pairs.iter().enumerate() {
        a.view_mut((3 * i, 0), (3, 3)).copy_from(&(r_b * rotation(tool)));
        a.view_mut((3 * i, 3), (3, 3)).copy_from(&Matrix3::identity());
        let t = Vector3::from(measured.position()) - r_b * Vector3::from(tool.position());
        right.rows_mut(3 * i, 3).copy_from(&t);
    }
    let normal = a.tr_mul(&a);
    let eigen = symmetric_eigen(normal.clone())?;
    if eigen.eigenvalues.min() < 1e-6 * eigen.eigenvalues.max() {
        return None;
    }
    let t = normal.cholesky()?.solve(&a.tr_mul(&right));
    let pose =
        |r: Matrix3<f64>, t: [f64; 3]| Pose([r.column(0).into(), r.column(1).into(), r.column(2).into(), t]);
    Some([pose(r_b, [t[3], t[4], t[5]]), pose(r_m, [t[0], t[1], t[2]])])
}

fn rotation(pose: &Pose) -> Matrix3<f64> {
    Matrix3::from_columns(&[pose.0[0].into(), pose.0[1].into(), pose.0[2].into()])
}

#[cfg(test)]
mod tests;
