//! Rows 4–6 from rotation-vector rows to changes of spin σ, roll ρ and pitch π.
//!
//! With `R_T x̂ = (r11, r21, r31)`:
//!
//! ```text
//! π̇ = (r11 ωx + r31 ωz) / cos² ρ      ρ̇ = (r11 ωz − r31 ωx) / cos ρ      σ̇ = ωy − r21 π̇
//! ```
//!
//! All return the margin `cos ρ = √(r11² + r31²)`: where it is 0 there are no rows.

use super::Motion;
use super::vector::{Vector, turn};
use crate::Scalar;

struct Euler<T> {
    margin: T,
    roll: [T; 2],
    pitch: [T; 2],
    sine: T,
}

impl<T: Scalar> Euler<T> {
    #[inline(always)]
    fn new([r11, r21, r31]: Vector<T>) -> Self {
        let margin = r11.mul_add(r11, r31 * r31).sqrt();
        let inverse = T::constant(1.0) / margin;
        let roll = [r11 * inverse, r31 * inverse];
        Self { margin, roll, pitch: [roll[0] * inverse, roll[1] * inverse], sine: r21 }
    }

    #[inline(always)]
    fn euler_rows(&self, [x, y, z]: Vector<T>) -> Vector<T> {
        let pitch = self.pitch[0].mul_add(x, self.pitch[1] * z);
        let roll = self.roll[0].mul_sub(z, self.roll[1] * x);
        [self.sine.neg_mul_add(pitch, y), roll, pitch]
    }

    #[inline(always)]
    fn column(&self, column: &mut [T; 6]) {
        let [x, y, z, u, v, w] = *column;
        let [u, v, w] = self.euler_rows([u, v, w]);
        *column = [x, y, z, u, v, w];
    }

    /// Of the tool in `F_0`, from the tip to the base.
    #[inline(always)]
    fn of_chain(transforms: &[Motion<T>]) -> Self {
        let (zero, one) = (T::constant(0.0), T::constant(1.0));
        let mut axis = [one, zero, zero];
        for transform in transforms.iter().rev() {
            axis = turn(transform, axis);
        }
        Self::new(axis)
    }
}

/// The columns of a Jacobian at this pose.
#[inline(always)]
pub fn euler_columns<T: Scalar>(pose: &Motion<T>, columns: &mut [[T; 6]]) -> T {
    let euler = Euler::new(pose[0]);
    for column in columns {
        euler.column(column);
    }
    euler.margin
}

/// The last three of nine distinct vectors of every frame: rows 4–6 of `e_s e_r e_p`, whose axes are y, z, x.
#[inline(always)]
pub fn euler_distinct<T: Scalar>(pose: &Motion<T>, distinct: &mut [[[T; 3]; 9]]) -> T {
    let euler = Euler::new(pose[0]);
    for vectors in distinct {
        vectors[6] = euler.euler_rows(vectors[1]);
        vectors[7] = euler.euler_rows(vectors[2]);
        vectors[8] = euler.euler_rows(vectors[0]);
    }
    euler.margin
}

/// One displacement.
#[inline(always)]
pub fn euler_displacement<T: Scalar>(transforms: &[Motion<T>], displacement: &mut [T; 6]) -> T {
    let euler = Euler::of_chain(transforms);
    euler.column(displacement);
    euler.margin
}

/// A covariance: `B M Bᵀ`, first the columns, then the rows.
#[inline(always)]
pub fn euler_covariance<T: Scalar>(transforms: &[Motion<T>], covariance: &mut [[T; 6]; 6]) -> T {
    let euler = Euler::of_chain(transforms);
    for column in &mut *covariance {
        euler.column(column);
    }
    let [.., first, second, third] = covariance;
    for ((a, b), c) in first.iter_mut().zip(second).zip(third) {
        [*a, *b, *c] = euler.euler_rows([*a, *b, *c]);
    }
    euler.margin
}
