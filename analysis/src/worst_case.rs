//! The worst case over all signs: the farthest point of a zonotope.

use abbe_kinematics::sampling::norm;

/// Largest count of vectors whose signs are tried one by one.
const FEW: usize = 3;
/// Relative size of the differences that make vectors in a common plane distinct.
const DISTINCT: f64 = 1e-9;

/// Returns the longest vector `c + Σ ± v_k` over all signs.
///
/// It is a vertex of the zonotope around `c`. Each vertex is on a face, whose normal is
/// perpendicular to two of the vectors: `n = v_i × v_j` gives the signs of all others, and four
/// combinations remain. So that no other vector is perpendicular to it, the signs are those of
/// vectors that differ by 1e-9 of their lengths, which lessens the norm by no more than that.
pub fn worst_case(center: [f64; 3], vectors: &[[f64; 3]]) -> [f64; 3] {
    let vectors: Vec<[f64; 3]> = vectors.iter().copied().filter(|v| *v != [0.0; 3]).collect();
    let (mut longest, mut square) = (center, -1.0);
    let mut put = |vector: [f64; 3]| {
        if dot(vector, vector) > square {
            (longest, square) = (vector, dot(vector, vector));
        }
    };
    if vectors.len() <= FEW {
        for signs in 0..1_usize << vectors.len() {
            let sign = |(k, v): (usize, &[f64; 3])| scaled(*v, if signs >> k & 1 == 0 { 1.0 } else { -1.0 });
            put(vectors.iter().enumerate().map(sign).fold(center, plus));
        }
        return longest;
    }
    let distinct: Vec<[f64; 3]> = vectors
        .iter()
        .enumerate()
        .map(|(k, v)| {
            let phase = |step: f64| DISTINCT * norm(*v) * (step * (k + 1) as f64).sin();
            plus(*v, [phase(1.3), phase(2.1), phase(3.7)])
        })
        .collect();
    for i in 0..vectors.len() {
        for j in i + 1..vectors.len() {
            let normal = cross(distinct[i], distinct[j]);
            let mut sum = [0.0; 3];
            for k in (0..vectors.len()).filter(|k| *k != i && *k != j) {
                let sign = 1.0_f64.copysign(dot(normal, distinct[k]));
                sum = plus(sum, scaled(vectors[k], sign));
            }
            for (side, a, b) in SIGNS {
                let others = plus(scaled(vectors[i], a), scaled(vectors[j], b));
                put(plus(center, plus(scaled(sum, side), others)));
            }
        }
    }
    longest
}

/// Signs of the two sides of a zonotope and of the two vectors of a face.
const SIGNS: [(f64, f64, f64); 8] = [
    (1.0, 1.0, 1.0),
    (1.0, 1.0, -1.0),
    (1.0, -1.0, 1.0),
    (1.0, -1.0, -1.0),
    (-1.0, 1.0, 1.0),
    (-1.0, 1.0, -1.0),
    (-1.0, -1.0, 1.0),
    (-1.0, -1.0, -1.0),
];

fn plus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    core::array::from_fn(|i| a[i] + b[i])
}

fn scaled(a: [f64; 3], factor: f64) -> [f64; 3] {
    a.map(|row| factor * row)
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross([ax, ay, az]: [f64; 3], [bx, by, bz]: [f64; 3]) -> [f64; 3] {
    [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]
}

#[cfg(test)]
mod tests;
