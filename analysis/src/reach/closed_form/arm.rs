//! Three revolute joints with skew axes that bring a point to its place.

use nalgebra::{Matrix3, Vector3};

use super::angles::{Quadratic, angle};
use super::line::{Line, TOLERANCE, common_perpendicular, turn, turned};

/// Axes of three revolute joints, the first two skew, and a point that they move. The points on the
/// first two axes are the feet of their common perpendicular.
#[derive(Clone, Debug)]
pub(super) struct Arm {
    axes: [Line; 3],
    /// Vector from the first axis to the second.
    between: Vector3<f64>,
    /// Vectors of u = fixed + across cos q_3 + beyond sin q_3, from the second axis to the point.
    fixed: Vector3<f64>,
    across: Vector3<f64>,
    beyond: Vector3<f64>,
    /// |u|² and h_2 · u: coefficients of 1, cos q_3 and sin q_3.
    square: [f64; 3],
    along: [f64; 3],
}

impl Arm {
    /// Returns `None` if the first two axes are not skew, or if the arm cannot bring the point to
    /// any place around it: if q_3 changes nothing that the first two joints keep.
    pub(super) fn new([first, second, third]: [Line; 3], point: Vector3<f64>) -> Option<Self> {
        let [on_first, on_second] = common_perpendicular(&first, &second);
        let between = on_second - on_first;
        if first.is_parallel(&second) || between.norm() < TOLERANCE {
            return None;
        }
        let [first, second] = [(first, on_first), (second, on_second)].map(|(line, at)| Line { at, ..line });
        let across = third.offset(point);
        let beyond = third.along.cross(&across);
        let fixed = point - across - second.at;
        let product = |v: Vector3<f64>| [v.dot(&fixed), v.dot(&across), v.dot(&beyond)];
        let [k, cosine, sine] = product(fixed);
        let square = [k + across.norm_squared(), 2.0 * cosine, 2.0 * sine];
        let along = product(second.along);
        let changes = |form: [f64; 3]| form[1].hypot(form[2]) > TOLERANCE;
        let axes = [first, second, third];
        let is_determined = changes(along) || changes(square);
        is_determined.then_some(Self { axes, between, fixed, across, beyond, square, along })
    }

    /// Returns the rotation by these angles.
    pub(super) fn rotation(&self, [q1, q2, q3]: [f64; 3]) -> Matrix3<f64> {
        let [first, second, third] = self.axes.map(|line| line.along);
        turn(first, q1) * turn(second, q2) * turn(third, q3)
    }

    /// Returns the angles, at most four sets, that bring the point to `to`. Joints that are
    /// free to move stay at `free`.
    ///
    /// With u = R_3 u_0 from the second axis to the point and c from the first axis to the second, the
    /// first joint keeps `|c + R_2 u|²` and `h_1 · R_2 u`; the second keeps `|u|²` and `h_2 · u`.
    /// Both products of R_2 u are linear in the cosine and sine of q_3, and so are its coordinates
    /// across the second axis, whose squares must add up (Pieper's equation).
    pub(super) fn solve(&self, to: Vector3<f64>, free: [f64; 3]) -> Vec<[f64; 3]> {
        let Self { axes: [first, second, _], between: c, fixed, across, beyond, square, along, .. } = *self;
        let (h1, h2) = (first.along, second.along);
        let height = h1.dot(&(to - second.at));
        let reach = (to - first.at).norm_squared() - c.norm_squared();
        // c · R_2 u, as a linear form.
        let radial = [(reach - square[0]) / 2.0, -square[1] / 2.0, -square[2] / 2.0];
        let (x, y) = self.coordinates(radial, along, height);
        let mut quadratic = Quadratic::default();
        [x, y, along].into_iter().for_each(|form| quadratic.add(1.0, form, form));
        quadratic.add(-1.0, square, [1.0, 0.0, 0.0]);
        let x_axis = c.normalize();
        let found = quadratic.zeros(free[2]).into_iter().map(|q3| {
            let (s, cosine) = q3.sin_cos();
            let value = |form: [f64; 3]| form[0] + form[1] * cosine + form[2] * s;
            let u = fixed + across * cosine + beyond * s;
            let image = x_axis * value(x) + h2.cross(&x_axis) * value(y);
            let q2 = angle(h2, u, image).unwrap_or(free[1]);
            let q1 = angle(h1, c + turned(h2, q2, u), to - first.at).unwrap_or(free[0]);
            [q1, q2, q3]
        });
        found.collect()
    }

    /// Returns the coordinates of `R_2 u` along c and along `h_2 × c`.
    fn coordinates(&self, radial: [f64; 3], along: [f64; 3], height: f64) -> ([f64; 3], [f64; 3]) {
        let [h1, h2] = [self.axes[0].along, self.axes[1].along];
        let length = self.between.norm();
        let (cosine, sine) = (h1.dot(&h2), h1.dot(&h2.cross(&(self.between / length))));
        let y = [(height - cosine * along[0]) / sine, -cosine * along[1] / sine, -cosine * along[2] / sine];
        (radial.map(|x| x / length), y)
    }
}
