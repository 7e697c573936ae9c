//! `J_e`, rotation-vector rows: for an axis e of frame i `(e ; 0)` and `(e × (p_T − p_i) ; e)`.

use super::Motion;
use super::vector::{cross, identity, sub, then};
use crate::Scalar;

/// Pose and `J_e`, six columns per frame.
#[inline(always)]
pub fn error_jacobian<T: Scalar>(transforms: &[Motion<T>], pose: &mut Motion<T>, columns: &mut [[T; 6]]) {
    let (frames, _) = columns.as_chunks_mut::<6>();
    let zero = T::constant(0.0);
    let mut frame = identity();
    for (i, transform) in transforms.iter().enumerate() {
        frame = then(&frame, transform);
        if i < frames.len() {
            let [x, y, z, p] = frame;
            let [along_x, along_y, along_z, about_y, ..] = &mut frames[i];
            *along_x = [x[0], x[1], x[2], zero, zero, zero];
            *along_y = [y[0], y[1], y[2], zero, zero, zero];
            *along_z = [z[0], z[1], z[2], zero, zero, zero];
            // The origin waits here until the tool point is known.
            *about_y = [p[0], p[1], p[2], zero, zero, zero];
        }
    }
    let tool = frame[3];
    for six in frames {
        let [x, y, z, p, ..] = *six;
        let ([x, y, z], p) = ([first(x), first(y), first(z)], first(p));
        let lever = sub(tool, p);
        six[3] = joined(cross(y, lever), y);
        six[4] = joined(cross(z, lever), z);
        six[5] = joined(cross(x, lever), x);
    }
    *pose = frame;
}

/// Pose and the axes x y z of every frame, then the moments of `e_s e_r e_p`; beyond these `D` leaves what is there.
#[inline(always)]
pub fn distinct<T: Scalar, const D: usize>(
    transforms: &[Motion<T>],
    pose: &mut Motion<T>,
    distinct: &mut [[[T; 3]; D]],
) {
    const { assert!(D >= 6, "three axes, three moments") };
    let mut frame = identity();
    for (i, transform) in transforms.iter().enumerate() {
        frame = then(&frame, transform);
        if i < distinct.len() {
            // The origin waits in the fourth place until the tool point is known.
            distinct[i][..4].copy_from_slice(&frame);
        }
    }
    let tool = frame[3];
    for vectors in distinct {
        let (x, y, z) = (vectors[0], vectors[1], vectors[2]);
        let lever = sub(tool, vectors[3]);
        vectors[3] = cross(y, lever);
        vectors[4] = cross(z, lever);
        vectors[5] = cross(x, lever);
    }
    *pose = frame;
}

#[inline(always)]
fn first<T: Scalar>([a, b, c, ..]: [T; 6]) -> [T; 3] {
    [a, b, c]
}

#[inline(always)]
fn joined<T: Scalar>([a, b, c]: [T; 3], [d, e, f]: [T; 3]) -> [T; 6] {
    [a, b, c, d, e, f]
}
