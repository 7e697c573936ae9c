//! Two revolute joints and a slide that bring a point to its place.

use nalgebra::{Matrix3, Vector3};

use super::angles::{angle, angles_to_plane};
use super::line::{Line, TOLERANCE, common_perpendicular, turn, turned};

/// Axes of the joints, of which the first two intersect or are parallel, and a point that they
/// move. The points on the first two axes are the feet of their common perpendicular.
#[derive(Clone, Debug)]
pub(super) struct Polar {
    axes: [Line; 2],
    slide: Vector3<f64>,
    /// Vector from the first axis to the second; zero if they intersect.
    between: Vector3<f64>,
    is_parallel: bool,
    /// Vector from the second axis to the point with the slide at zero.
    start: Vector3<f64>,
}

impl Polar {
    /// Returns `None` if the first two axes are skew or the same, or if the slide changes nothing
    /// that they keep.
    pub(super) fn new([first, second, slide]: [Line; 3], point: Vector3<f64>) -> Option<Self> {
        let [on_first, on_second] = common_perpendicular(&first, &second);
        let between = on_second - on_first;
        let (is_parallel, is_intersecting) = (first.is_parallel(&second), between.norm() < TOLERANCE);
        let moves_along = second.along.dot(&slide.along).abs() > TOLERANCE;
        if is_parallel == is_intersecting || is_parallel && !moves_along {
            return None;
        }
        let axes = [Line { at: on_first, ..first }, Line { at: on_second, ..second }];
        Some(Self { axes, slide: slide.along, between, is_parallel, start: point - on_second })
    }

    /// Returns the rotation by these joints.
    pub(super) fn rotation(&self, [q1, q2, _]: [f64; 3]) -> Matrix3<f64> {
        turn(self.axes[0].along, q1) * turn(self.axes[1].along, q2)
    }

    /// Returns the joints, at most four sets, that bring the point to `to`. The slide gives the
    /// height along parallel axes, or the distance from the point where they intersect. Revolute
    /// joints that are free to move stay at `free`.
    pub(super) fn solve(&self, to: Vector3<f64>, free: [f64; 3]) -> Vec<[f64; 3]> {
        let Self { axes: [first, second], slide, between: c, is_parallel, start } = *self;
        let (h1, h2) = (first.along, second.along);
        let height = h1.dot(&(to - second.at));
        let reach = (to - first.at).norm_squared() - c.norm_squared();
        let travels = if is_parallel {
            let travel = (height * h1.dot(&h2) - h2.dot(&start)) / h2.dot(&slide);
            [Some(travel), None]
        } else {
            // |start + d slide|² = reach
            let middle = -start.dot(&slide);
            let square = middle * middle + reach - start.norm_squared();
            let half = (square > -TOLERANCE).then(|| square.max(0.0).sqrt());
            [half.map(|half| middle + half), half.map(|half| middle - half)]
        };
        let mut found = Vec::with_capacity(4);
        for d in travels.into_iter().flatten() {
            let u = start + slide * d;
            let mut finish = |q2: f64| {
                let q1 = angle(h1, c + turned(h2, q2, u), to - first.at).unwrap_or(free[0]);
                found.push([q1, q2, d]);
            };
            if is_parallel {
                angles_to_plane(h2, u, c, (reach - u.norm_squared()) / 2.0, free[1]).for_each(&mut finish);
            } else {
                angles_to_plane(h2, u, h1, height, free[1]).for_each(&mut finish);
            }
        }
        found
    }
}
