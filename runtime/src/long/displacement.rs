//! `ΔX = J_e ε`, rotation-vector rows.

use super::Motion;
use super::vector::{Vector, add, carry, cross, turn, vectors, zero};
use crate::{Effect, Scalar};

/// From the tip to the base, with the lever `ρ = p_T − p_i`:
///
/// ```text
/// δ ← R_i (δ + d_i + θ_i × ρ)        θ ← R_i (θ + θ_i)        ρ ← t_i + R_i ρ
/// ```
#[inline(always)]
pub fn displacement<T: Scalar>(transforms: &[Motion<T>], errors: &[[T; 6]], displacement: &mut [T; 6]) {
    let [mut shift, mut rotation]: [Vector<T>; 2] = [zero(); 2];
    let mut lever = match transforms.last() {
        Some(tool) => tool[3],
        None => zero(),
    };
    for (transform, errors) in transforms.iter().zip(errors).rev() {
        let [along, about] = vectors(errors);
        shift = turn(transform, add(add(shift, along), cross(about, lever)));
        rotation = turn(transform, add(rotation, about));
        lever = carry(transform, lever);
    }
    let ([x, y, z], [u, v, w]) = (shift, rotation);
    *displacement = [x, y, z, u, v, w];
}

/// ΔX of each source by itself from the columns of `J_e`, whatever their rows are.
#[inline(always)]
pub fn by_source<T: Scalar>(
    effects: &[Effect],
    values: &[T],
    columns: &[[T; 6]],
    displacements: &mut [[T; 6]],
) {
    for displacement in &mut *displacements {
        *displacement = [T::constant(0.0); 6];
    }
    for (effect, value) in effects.iter().zip(values) {
        let column = &columns[6 * effect.frame + effect.component.index()];
        let sum = &mut displacements[effect.source];
        for (sum, entry) in sum.iter_mut().zip(column) {
            *sum = entry.mul_add(*value, *sum);
        }
    }
}
