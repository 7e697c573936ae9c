//! The zeros of joints that fit best, from a few evaluations.
//!
//! As one joint turns by δ, every point of what it carries goes round a circle: the sum of squares of what is left is
//! `a + b cos δ + c sin δ`, and of a slide `a + b δ + c δ²`. With two joints it is a product of two such sums, so that nine values tell all
//! of it. What several rows, positions and orientations add are sums of the same form.

use std::f64::consts::FRAC_PI_2;

/// How the sum of squares depends on the zero of one joint.
#[derive(Clone, Copy, Debug)]
pub(super) enum Form {
    /// It turns.
    Circle,
    /// It slides; zeros are tried at this distance.
    Line(f64),
}

impl Form {
    /// Where the sum is evaluated.
    pub(super) fn nodes(self) -> [f64; 3] {
        match self {
            Self::Circle => [0.0, FRAC_PI_2, 2.0 * FRAC_PI_2],
            Self::Line(h) => [0.0, h, -h],
        }
    }

    /// The coefficients by the values there.
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

    /// What the coefficients are multiplied by.
    fn basis(self, offset: f64) -> [f64; 3] {
        match self {
            Self::Circle => [1.0, offset.cos(), offset.sin()],
            Self::Line(_) => [1.0, offset, offset * offset],
        }
    }

    /// Where the sum is least.
    fn least(self, [_, b, c]: [f64; 3]) -> f64 {
        match self {
            Self::Circle => (-c).atan2(-b),
            Self::Line(_) if c > 0.0 => -0.5 * b / c,
            Self::Line(_) => 0.0,
        }
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The zeros with the least sum, and that sum; values at all nodes, the last joint's nodes first. Two zeros are found in turns, so often.
pub(super) fn least(forms: &[Form], values: &[f64], turns: usize) -> (Vec<f64>, f64) {
    match (forms, values) {
        ([form], &[a, b, c]) => {
            let coefficients = form.coefficients([a, b, c]);
            let offset = form.least(coefficients);
            (vec![offset], dot(coefficients, form.basis(offset)))
        }
        ([first, second], &[a, b, c, d, e, f, g, h, i]) => {
            let rows = [[a, b, c], [d, e, f], [g, h, i]].map(|row| second.coefficients(row));
            let column = |k: usize| first.coefficients([rows[0][k], rows[1][k], rows[2][k]]);
            // [i][k]: of basis i of the first, k of the second.
            let columns = [column(0), column(1), column(2)];
            let of_first =
                |v: [f64; 3]| [0, 1, 2].map(|i| dot([columns[0][i], columns[1][i], columns[2][i]], v));
            let of_second = |u: [f64; 3]| [0, 1, 2].map(|k| dot(columns[k], u));
            let mut best = (vec![0.0, 0.0], f64::INFINITY);
            for start in 0..4 {
                let mut y = match second {
                    Form::Circle => f64::from(start) * FRAC_PI_2,
                    Form::Line(_) => 0.0,
                };
                let mut x = 0.0;
                for _ in 0..turns {
                    x = first.least(of_first(second.basis(y)));
                    let before = std::mem::replace(&mut y, second.least(of_second(first.basis(x))));
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
mod tests {
    use super::{Form, least};

    /// Of sums whose form is known the least is found.
    #[test]
    fn the_least_sum() {
        let one = |x: f64| 3.0 + 2.0 * (x - 0.7).cos();
        let values = Form::Circle.nodes().map(one);
        let (found, sum) = least(&[Form::Circle], &values, 1);
        assert!((one(found[0]) - 1.0).abs() < 1e-12 && (sum - 1.0).abs() < 1e-12, "{found:?} {sum}");

        let two = |x: f64, y: f64| (1.5 - (x - 0.7).cos()) * (2.0 + (y - 30.0) * (y - 30.0));
        let line = Form::Line(100.0);
        let mut values = Vec::new();
        for x in Form::Circle.nodes() {
            values.extend(line.nodes().map(|y| two(x, y)));
        }
        let (found, sum) = least(&[Form::Circle, line], &values, 100);
        assert!((sum - 1.0).abs() < 1e-6, "{found:?} {sum}");
        assert!((found[0] - 0.7).abs() < 1e-6 && (found[1] - 30.0).abs() < 1e-6, "{found:?}");
    }
}
