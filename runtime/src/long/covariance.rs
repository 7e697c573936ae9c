//! `J_e diag(σ²) J_eᵀ`, rotation-vector rows.

use super::Motion;
use super::vector::{Vector, carry, cross, turn, vectors, zero};
use crate::Scalar;

/// A 3 × 3 matrix by rows; the symmetric ones are so by rows and columns.
type Matrix<T> = [Vector<T>; 3];

/// From the tip to the base, in blocks of displacement δ and turn θ. With `L = −[ρ]`, so that `θ × ρ = L θ`, a frame adds
///
/// ```text
/// PP += diag(σ_d²) + L diag(σ_θ²) Lᵀ        PR += L diag(σ_θ²)        RR += diag(σ_θ²)
/// ```
///
/// and every block M becomes `R M Rᵀ`. The covariance is column-major.
#[inline(always)]
pub fn covariance<T: Scalar>(transforms: &[Motion<T>], variances: &[[T; 6]], covariance: &mut [[T; 6]; 6]) {
    let [mut pp, mut pr, mut rr]: [Matrix<T>; 3] = [[zero(); 3]; 3];
    let mut lever = match transforms.last() {
        Some(tool) => tool[3],
        None => zero(),
    };
    for (transform, variances) in transforms.iter().zip(variances).rev() {
        let [along, about] = vectors(variances);
        for k in 0..3 {
            // Column k of L is e_k × ρ.
            let mut unit = zero();
            unit[k] = T::constant(1.0);
            let swing = cross(unit, lever);
            for i in 0..3 {
                let part = swing[i] * about[k];
                pr[i][k] = pr[i][k] + part;
                for j in 0..3 {
                    pp[i][j] = part.mul_add(swing[j], pp[i][j]);
                }
            }
            pp[k][k] = pp[k][k] + along[k];
            rr[k][k] = rr[k][k] + about[k];
        }
        pp = congruent(transform, &pp);
        pr = congruent(transform, &pr);
        rr = congruent(transform, &rr);
        lever = carry(transform, lever);
    }
    for i in 0..3 {
        for j in 0..3 {
            // The upper triangle on both sides of the diagonal.
            let (first, last) = if i < j { (i, j) } else { (j, i) };
            covariance[i][j] = pp[first][last];
            covariance[i + 3][j + 3] = rr[first][last];
            covariance[j + 3][i] = pr[i][j];
            covariance[i][j + 3] = pr[i][j];
        }
    }
}

/// `R M Rᵀ`: first the columns of M, then its rows.
#[inline(always)]
fn congruent<T: Scalar>(motion: &Motion<T>, m: &Matrix<T>) -> Matrix<T> {
    let columns = transposed(m);
    let columns = [turn(motion, columns[0]), turn(motion, columns[1]), turn(motion, columns[2])];
    let rows = transposed(&columns);
    [turn(motion, rows[0]), turn(motion, rows[1]), turn(motion, rows[2])]
}

#[inline(always)]
fn transposed<T: Scalar>(m: &Matrix<T>) -> Matrix<T> {
    [[m[0][0], m[1][0], m[2][0]], [m[0][1], m[1][1], m[2][1]], [m[0][2], m[1][2], m[2][2]]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quarter_turn_exchanges_rows_and_columns() {
        let quarter = [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [5.0, 0.0, 0.0]];
        let m = congruent(&quarter, &[[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]]);
        assert_eq!(m, [[5.0, -4.0, -6.0], [-2.0, 1.0, 3.0], [-8.0, 7.0, 9.0]]);
    }
}
