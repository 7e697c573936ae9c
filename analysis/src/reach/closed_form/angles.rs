//! Angles that solve equations in their sines and cosines.

use nalgebra::{Matrix4, Vector3};

/// Norm below which a vector has no direction, and coefficients are zero.
const NOTHING: f64 = 1e-10;
/// Excess of a cosine over 1 that counts as a rounding error.
const ROUNDING: f64 = 1e-9;

/// Returns the angle about a unit vector that turns the part of `from` perpendicular to it in the
/// direction of that of `to`. Returns `None` if any angle does.
pub(super) fn angle(along: Vector3<f64>, from: Vector3<f64>, to: Vector3<f64>) -> Option<f64> {
    let cross = along.cross(&from);
    let sine = cross.dot(&to);
    let cosine = cross.dot(&along.cross(&to));
    (sine.hypot(cosine) > NOTHING * NOTHING && cross.norm() > NOTHING).then(|| sine.atan2(cosine))
}

/// Returns the angles about `along` for which `normal · turned = height`, at most two. If any angle
/// does, returns `free`.
pub(super) fn angles_to_plane(
    along: Vector3<f64>,
    from: Vector3<f64>,
    normal: Vector3<f64>,
    height: f64,
    free: f64,
) -> impl Iterator<Item = f64> {
    let fixed = normal.dot(&along) * along.dot(&from);
    let cosine = normal.dot(&from) - fixed;
    let sine = normal.dot(&along.cross(&from));
    linear([fixed - height, cosine, sine], free)
}

/// Returns the solutions of `k + c cos θ + s sin θ = 0`, at most two. If every θ is one, returns
/// `free`.
pub(super) fn linear([k, c, s]: [f64; 3], free: f64) -> impl Iterator<Item = f64> {
    let amplitude = c.hypot(s);
    let pair = if amplitude < NOTHING {
        [(k.abs() < NOTHING).then_some(free), None]
    } else {
        let cosine = -k / amplitude;
        let (middle, half) = (s.atan2(c), cosine.clamp(-1.0, 1.0).acos());
        let is_real = cosine.abs() <= 1.0 + ROUNDING;
        [is_real.then_some(middle + half), (is_real && half != 0.0).then_some(middle - half)]
    };
    pair.into_iter().flatten()
}

/// Polynomial of second degree in cos θ and sin θ, as a sum of products of linear ones.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Quadratic {
    constant: f64,
    cosine: f64,
    sine: f64,
    /// Coefficients of cos², cos sin and sin².
    squares: [f64; 3],
}

impl Quadratic {
    /// Adds `factor · a(θ) b(θ)`.
    pub(super) fn add(&mut self, factor: f64, a: [f64; 3], b: [f64; 3]) {
        self.constant += factor * a[0] * b[0];
        self.cosine += factor * (a[0] * b[1] + a[1] * b[0]);
        self.sine += factor * (a[0] * b[2] + a[2] * b[0]);
        self.squares[0] += factor * a[1] * b[1];
        self.squares[1] += factor * (a[1] * b[2] + a[2] * b[1]);
        self.squares[2] += factor * a[2] * b[2];
    }

    fn at(&self, angle: f64) -> f64 {
        let (s, c) = angle.sin_cos();
        let [cc, cs, ss] = self.squares;
        self.constant + self.cosine * c + self.sine * s + cc * c * c + cs * c * s + ss * s * s
    }

    fn slope(&self, angle: f64) -> f64 {
        let (s, c) = angle.sin_cos();
        let [cc, cs, ss] = self.squares;
        self.sine * c - self.cosine * s + 2.0 * (ss - cc) * c * s + cs * (c * c - s * s)
    }

    /// Returns the polynomial of θ − `by`.
    fn shifted(&self, by: f64) -> Self {
        let (s, c) = by.sin_cos();
        let [cc, cs, ss] = self.squares;
        Self {
            constant: self.constant,
            cosine: self.cosine * c + self.sine * s,
            sine: self.sine * c - self.cosine * s,
            squares: [
                cc * c * c + cs * c * s + ss * s * s,
                2.0 * (ss - cc) * c * s + cs * (c * c - s * s),
                cc * s * s - cs * c * s + ss * c * c,
            ],
        }
    }

    /// Returns the zeros, at most four: those of a quartic polynomial in tan(θ/2), which are
    /// eigenvalues of its companion matrix. If every angle is one, returns `free`; if a coefficient
    /// is not finite, none.
    pub(super) fn zeros(&self, free: f64) -> Vec<f64> {
        let [cc, cs, ss] = self.squares;
        let size =
            [self.constant, self.cosine, self.sine, cc, cs, ss].iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        if cs.abs().max((cc - ss).abs()) <= NOTHING * size {
            return linear([self.constant + ss, self.cosine, self.sine], free).collect();
        }
        // The leading coefficient is the value at π: not zero everywhere.
        let largest = |a: &f64, b: &f64| {
            self.at(a + core::f64::consts::PI).abs().total_cmp(&self.at(b + core::f64::consts::PI).abs())
        };
        let by = (0..5).map(f64::from).max_by(largest).unwrap_or(0.0);
        let Self { constant: k, cosine: c, sine: s, squares: [cc, cs, ss] } = self.shifted(by);
        let leading = k - c + cc;
        let [a3, a2, a1, a0] =
            [2.0 * (s - cs), 2.0 * (k - cc) + 4.0 * ss, 2.0 * (s + cs), k + c + cc].map(|x| -x / leading);
        #[rustfmt::skip]
        let companion = Matrix4::new(
            a3, a2, a1, a0,
            1.0, 0.0, 0.0, 0.0,
            0.0, 1.0, 0.0, 0.0,
            0.0, 0.0, 1.0, 0.0,
        );
        // Without this, the iteration would not end.
        if !companion.iter().all(|entry| entry.is_finite()) {
            return Vec::new();
        }
        let roots = companion.complex_eigenvalues();
        // Double roots are accurate to half of the digits.
        let real = roots.iter().filter(|root| root.im.abs() <= 1e-6 * (1.0 + root.re.abs()));
        real.map(|root| self.polished(2.0 * root.re.atan() + by)).collect()
    }

    /// Improves a zero by Newton's steps, as long as the value decreases.
    fn polished(&self, mut angle: f64) -> f64 {
        for _ in 0..3 {
            let next = angle - self.at(angle) / self.slope(angle);
            let is_nearer = self.at(next).abs() < self.at(angle).abs();
            if !is_nearer {
                break;
            }
            angle = next;
        }
        angle
    }
}

#[cfg(test)]
mod tests {
    use super::super::line::turned;
    use super::*;
    use crate::sampling::halton;

    #[test]
    fn zeros_are_all_zeros() {
        for index in 1..2000 {
            let number = |i| 2.0 * halton(index, i) - 1.0;
            // A product of two linear ones with known zeros.
            let [a, b, c, d] = [0, 1, 2, 3].map(|i| 3.0 * number(i));
            let factor = |a: f64, b: f64| {
                let (middle, half) = ((a + b) / 2.0, (a - b) / 2.0);
                [-half.cos(), middle.cos(), middle.sin()]
            };
            let mut quadratic = Quadratic::default();
            quadratic.add(1.0 + number(4), factor(a, b), factor(c, d));
            let zeros = quadratic.zeros(0.0);
            for expected in [a, b, c, d] {
                let near = zeros.iter().map(|zero| ((zero - expected) / 2.0).sin().abs()).fold(1.0, f64::min);
                assert!(near < 1e-6, "{index}: {expected} of {zeros:?}");
            }
        }
    }

    #[test]
    fn angles_turn_to_planes_and_directions() {
        for index in 1..500 {
            let vector = |first: usize| Vector3::from_fn(|i, _| halton(index, first + i) - 0.5);
            let (along, from, normal) = (vector(0).normalize(), vector(3), vector(6));
            let expected = 6.0 * halton(index, 9) - 3.0;
            let to = turned(along, expected, from);
            let found = angle(along, from, to).unwrap();
            assert!(((found - expected) / 2.0).sin().abs() < 1e-12);
            let found = angles_to_plane(along, from, normal, normal.dot(&to), 0.0);
            assert!(found.into_iter().any(|found| ((found - expected) / 2.0).sin().abs() < 1e-6));
        }
    }
}
