//! Fits the zeros of joints from a few evaluations.
//!
//! If one joint turns by δ, every point behind it moves on a circle. The sum of squared residuals
//! is `a + b cos δ + c sin δ`; for a prismatic joint it is `a + b δ + c δ²`. For two joints it is a
//! product of two such forms with nine coefficients, so that nine evaluations determine it. Sums
//! over rows, positions and orientations have the same form.

use std::f64::consts::FRAC_PI_2;

use abbe::analysis::sampling::vectors::dot;

/// Dependence of the sum of squares on the zero of one joint.
#[derive(Clone, Copy, Debug)]
pub(super) enum ZeroForm {
    /// Revolute joint.
    Circle,
    /// Prismatic joint, with the distance between nodes.
    Line(f64),
}

impl ZeroForm {
    /// Returns the zeros at which the sum is evaluated.
    pub(super) fn nodes(self) -> [f64; 3] {
        match self {
            Self::Circle => [0.0, FRAC_PI_2, 2.0 * FRAC_PI_2],
            Self::Line(h) => [0.0, h, -h],
        }
    }

    /// Computes the coefficients from the values at the nodes.
    fn coefficients(self, [first, second, third]: [f64; 3]) -> [f64; 3] {
        match self {
            Self::Circle => {
                let a = 0.5 * (first + third);
                [a, 0.5 * (first - third), second - a]
            }
            Self::Line(h) => {
                [first, 0.5 * (second - third) / h, 0.5 * (second + third - 2.0 * first) / (h * h)]
            }
        }
    }

    /// Returns the functions that the coefficients multiply.
    fn basis(self, offset: f64) -> [f64; 3] {
        match self {
            Self::Circle => [1.0, offset.cos(), offset.sin()],
            Self::Line(_) => [1.0, offset, offset * offset],
        }
    }

    /// Returns the zero with the smallest sum.
    fn minimum(self, [_, b, c]: [f64; 3]) -> f64 {
        match self {
            Self::Circle => (-c).atan2(-b),
            Self::Line(_) if c > 0.0 => -0.5 * b / c,
            Self::Line(_) => 0.0,
        }
    }
}

/// Returns the zeros with the smallest sum, and that sum. `values` are those at all nodes, the last
/// joint's nodes varying fastest. Two zeros are fitted alternately, at most `turns` times.
pub(super) fn minimum(forms: &[ZeroForm], values: &[f64], turns: usize) -> (Vec<f64>, f64) {
    match (forms, values) {
        ([form], &[a, b, c]) => {
            let coefficients = form.coefficients([a, b, c]);
            let offset = form.minimum(coefficients);
            (vec![offset], dot(coefficients, form.basis(offset)))
        }
        ([first, second], &[a, b, c, d, e, f, g, h, i]) => {
            let rows = [[a, b, c], [d, e, f], [g, h, i]].map(|row| second.coefficients(row));
            let column = |k: usize| first.coefficients([rows[0][k], rows[1][k], rows[2][k]]);
            // [i][k]: basis function i of the first joint, k of the second.
            let columns = [column(0), column(1), column(2)];
            let of_first =
                |v: [f64; 3]| [0, 1, 2].map(|i| dot([columns[0][i], columns[1][i], columns[2][i]], v));
            let of_second = |u: [f64; 3]| [0, 1, 2].map(|k| dot(columns[k], u));
            let mut best = (vec![0.0, 0.0], f64::INFINITY);
            for start in 0..4 {
                let mut y = match second {
                    ZeroForm::Circle => f64::from(start) * FRAC_PI_2,
                    ZeroForm::Line(_) => 0.0,
                };
                let mut x = 0.0;
                for _ in 0..turns {
                    x = first.minimum(of_first(second.basis(y)));
                    let before = std::mem::replace(&mut y, second.minimum(of_second(first.basis(x))));
                    if before == y {
                        break;
                    }
                }
                let sum = dot(of_first(second.basis(y)), first.basis(x));
                if sum < best.1 {
                    best = (vec![x, y], sum);
                }
            }
            best
        }
        _ => (Vec::new(), values.first().copied().unwrap_or(f64::INFINITY)),
    }
}

#[cfg(test)]
mod tests;
