//! Equations (2) and (6): the product of all motions, without and with errors.

use super::Motion;
use super::vector::{identity, then};
use crate::Scalar;

/// `A_1 … A_n T`.
#[inline(always)]
pub fn pose<T: Scalar>(transforms: &[Motion<T>], pose: &mut Motion<T>) {
    let mut frame = identity();
    for transform in transforms {
        frame = then(&frame, transform);
    }
    *pose = frame;
}

/// `A_1 E_1 … A_n E_n T`, exactly.
#[inline(always)]
pub fn real_pose<T: Scalar>(transforms: &[Motion<T>], errors: &[[T; 6]], pose: &mut Motion<T>) {
    let mut frame = identity();
    for (i, transform) in transforms.iter().enumerate() {
        frame = then(&frame, transform);
        if i < errors.len() {
            frame = then(&frame, &error(&errors[i]));
        }
    }
    *pose = frame;
}

/// `E`: translation `(e_x, e_y, e_z)` and `R = R_y(e_s) R_z(e_r) R_x(e_p)`.
#[inline(always)]
fn error<T: Scalar>(errors: &[T; 6]) -> Motion<T> {
    let [x, y, z, spin, roll, pitch] = *errors;
    let [(ss, cs), (sr, cr), (sp, cp)] = T::sin_cos_each([spin, roll, pitch]);
    [
        [cs * cr, sr, -(ss * cr)],
        [ss.mul_sub(sp, cs * (sr * cp)), cr * cp, cs.mul_add(sp, ss * (sr * cp))],
        [ss.mul_add(cp, cs * (sr * sp)), -(cr * sp), cs.mul_sub(cp, ss * (sr * sp))],
        [x, y, z],
    ]
}
