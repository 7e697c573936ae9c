//! `∂X_T/∂x` for joint variables and structural parameters, rotation-vector rows.

use super::Motion;
use super::vector::{add, cross, identity, then, turn};
use crate::Scalar;

/// Pose and Jacobian. `places` says which transform (from 0, the tool the last) moves which column, in the order of
/// transforms; `twists` are the velocity of the point in the origin of the frame before the transform, and the
/// rotation, both in its axes:
///
/// ```text
/// ω = R ω_l        v = R v_l + ω × (p_T − p)
/// ```
#[inline(always)]
pub fn symbol_jacobian<T: Scalar>(
    transforms: &[Motion<T>],
    places: &[(usize, usize)],
    twists: &[[T; 6]],
    pose: &mut Motion<T>,
    columns: &mut [[T; 6]],
) {
    let mut frame = identity();
    for column in &mut *columns {
        *column = [T::constant(0.0); 6];
    }
    let mut next = 0;
    for (i, transform) in transforms.iter().enumerate() {
        while next < places.len() && places[next].0 == i {
            let [a, b, c, d, e, f] = twists[next];
            let (rotation, position) = (turn(&frame, [d, e, f]), frame[3]);
            // As seen from the origin of F_0: ω × p_T is added when p_T is known.
            let velocity = add(turn(&frame, [a, b, c]), cross(position, rotation));
            let column = &mut columns[places[next].1];
            let [x, y, z, u, v, w] = *column;
            let ([x, y, z], [u, v, w]) = (add([x, y, z], velocity), add([u, v, w], rotation));
            *column = [x, y, z, u, v, w];
            next += 1;
        }
        frame = then(&frame, transform);
    }
    for column in columns {
        let [x, y, z, u, v, w] = *column;
        let [x, y, z] = add([x, y, z], cross([u, v, w], frame[3]));
        *column = [x, y, z, u, v, w];
    }
    *pose = frame;
}
