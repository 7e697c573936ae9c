//! A rigid motion as the columns of its matrix.

use bytemuck::TransparentWrapper;

/// Rigid motion: the upper three rows of a homogeneous matrix, column-major (x, y, z axes and
/// position).
///
/// Lengths are in the manipulator's unit. The function that returns a pose documents its frames.
#[derive(Clone, Copy, Debug, PartialEq, TransparentWrapper)]
#[repr(transparent)]
pub struct Pose<T = f64>(pub [[T; 3]; 4]);

impl Pose {
    /// Identity.
    pub const IDENTITY: Self = Self([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0; 3]]);

    /// Returns the product `self · other`.
    pub fn then(&self, other: &Self) -> Self {
        let [x, y, z, position] = other.0.map(|column| self.turn(column));
        Self([x, y, z, add(position, self.position())])
    }

    /// Returns the inverse motion.
    pub fn inverse(&self) -> Self {
        let [x, y, z]: [[f64; 3]; 3] = core::array::from_fn(|i| core::array::from_fn(|j| self.0[j][i]));
        let turned = Self([x, y, z, [0.0; 3]]).turn(self.position());
        Self([x, y, z, turned.map(|v| -v)])
    }

    /// Returns the vector `R v`.
    pub fn turn(&self, v: [f64; 3]) -> [f64; 3] {
        core::array::from_fn(|i| self.0[0][i] * v[0] + self.0[1][i] * v[1] + self.0[2][i] * v[2])
    }

    /// Returns the point `R v + p`.
    pub fn apply(&self, point: [f64; 3]) -> [f64; 3] {
        add(self.turn(point), self.position())
    }

    /// Returns the four rows of the homogeneous matrix.
    pub fn rows(&self) -> [[f64; 4]; 4] {
        core::array::from_fn(|i| {
            if i == 3 { [0.0, 0.0, 0.0, 1.0] } else { core::array::from_fn(|j| self.0[j][i]) }
        })
    }
}

impl<T: Copy> Pose<T> {
    /// Returns the position: the image of the origin.
    pub fn position(&self) -> [T; 3] {
        self.0[3]
    }
}

fn add(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    core::array::from_fn(|i| a[i] + b[i])
}

#[cfg(test)]
mod tests;
