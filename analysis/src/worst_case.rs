//! The worst case over all signs: the farthest point of a zonotope.

use core::f64::consts::PI;

use abbe_kinematics::sampling::vectors::{add as plus, cross, dot, norm, scale as scaled};

/// Relative size of the differences that make vectors in a common plane distinct.
const DISTINCT: f64 = 1e-9;

/// Returns the longest vector `c + Σ ± v_k` over all signs.
///
/// It is a vertex of the zonotope around `c`. Each vertex is at the end of an edge along some
/// `v_i`, and is farthest in a direction n perpendicular to it. As n turns about `v_i`, the sign of
/// each other vector changes once in half a turn. So that no two change at once, the signs are
/// those of vectors that differ by 1e-9 of their lengths, which lessens the norm by no more than
/// that.
pub fn worst_case(center: [f64; 3], vectors: &[[f64; 3]]) -> [f64; 3] {
    let vectors: Vec<[f64; 3]> = vectors.iter().copied().filter(|v| *v != [0.0; 3]).collect();
    let (mut longest, mut square) = (center, if vectors.is_empty() { f64::INFINITY } else { -1.0 });
    let mut put = |sum: [f64; 3], own: [f64; 3]| {
        for (side, end) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
            let vector = plus(center, plus(scaled(sum, side), scaled(own, end)));
            if dot(vector, vector) > square {
                (longest, square) = (vector, dot(vector, vector));
            }
        }
    };
    let distinct = vectors.iter().enumerate().map(|(k, v)| plus(*v, scaled(apart(k), norm(*v))));
    let distinct: Vec<[f64; 3]> = distinct.collect();
    let mut turns = Vec::with_capacity(vectors.len());
    for (i, own) in distinct.iter().enumerate() {
        let least = (0..3).min_by(|a, b| own[*a].abs().total_cmp(&own[*b].abs())).unwrap_or_default();
        let across = cross(*own, core::array::from_fn(|row| f64::from(u8::from(row == least))));
        let up = scaled(cross(*own, across), 1.0 / norm(*own));
        let (mut sum, others) = ([0.0; 3], (0..vectors.len()).filter(|k| *k != i));
        turns.clear();
        for k in others {
            let [x, y] = [across, up].map(|axis| dot(axis, distinct[k]));
            let signed = scaled(vectors[k], 1.0_f64.copysign(x));
            sum = plus(sum, signed);
            turns.push((((-x).atan2(y) + PI).rem_euclid(PI), signed));
        }
        turns.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        put(sum, vectors[i]);
        for (_, signed) in &turns {
            sum = plus(sum, scaled(*signed, -2.0));
            put(sum, vectors[i]);
        }
    }
    longest
}

/// Returns what makes vector k distinct from others, times its length.
pub(crate) fn apart(k: usize) -> [f64; 3] {
    [1.3, 2.1, 3.7].map(|step| DISTINCT * (step * (k + 1) as f64).sin())
}

#[cfg(test)]
mod tests;
