//! The principal axes of a covariance.

use nalgebra::{Matrix3, SymmetricEigen};

use abbe_kinematics::decompose::symmetric_eigen;

/// Relative variance below which an axis counts as constant: the error lies in a plane or on a
/// line.
pub const FLAT: f64 = 1e-12;

/// Principal axes of a covariance, the longest first.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Principal {
    /// Standard deviations along the axes. 0 along constant axes.
    pub deviations: [f64; 3],
    /// Directions of the axes, unit vectors.
    pub axes: [[f64; 3]; 3],
}

impl Principal {
    /// Decomposes a covariance, symmetric and positive semidefinite. If it is not finite, the
    /// deviations are infinite.
    pub fn new(covariance: [[f64; 3]; 3]) -> Self {
        let Some(SymmetricEigen { eigenvectors, eigenvalues }) = symmetric_eigen(Matrix3::from(covariance))
        else {
            return Self { deviations: [f64::INFINITY; 3], axes: Matrix3::identity().into() };
        };
        let mut order = [0, 1, 2];
        order.sort_by(|&i, &j| eigenvalues[j].total_cmp(&eigenvalues[i]));
        let least = FLAT * eigenvalues[order[0]];
        let deviation = |i: usize| if eigenvalues[i] > least { eigenvalues[i].sqrt() } else { 0.0 };
        Self {
            deviations: order.map(deviation),
            axes: order.map(|i| eigenvectors.column(i).into_owned().into()),
        }
    }

    /// Returns the number of axes with a variance, 0 to 3.
    pub fn rank(&self) -> usize {
        self.deviations.iter().filter(|deviation| **deviation > 0.0).count()
    }

    /// Returns the components of a vector along the axes.
    pub fn components(&self, vector: [f64; 3]) -> [f64; 3] {
        self.axes.map(|axis| axis.iter().zip(vector).map(|(a, v)| a * v).sum())
    }
}
