//! Smallest sphere around a set of points.

use nalgebra::{Matrix3, Vector3};

/// Sphere around all points of a cloud, in the length unit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sphere {
    /// Center.
    pub centre: [f64; 3],
    /// Radius.
    pub radius: f64,
    /// Upper bound of the excess over the radius of the smallest sphere. 0 if this is the smallest.
    pub excess: f64,
}

/// Relative distance beyond the radius at which a point still counts as inside.
const ROUNDING: f64 = 1e-12;

/// Smallest sphere around some points.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Ball {
    pub(super) centre: Vector3<f64>,
    pub(super) radius: f64,
}

impl Ball {
    /// Adds the furthest point to the support until all points are inside. The radius grows with
    /// every step.
    pub(super) fn around(points: &[Vector3<f64>]) -> Self {
        let Some(first) = points.first() else { return Self::default() };
        // At most four points, on the sphere.
        let mut support = vec![*first];
        let mut ball = Self { centre: *first, radius: 0.0 };
        loop {
            let distance = |point: &&Vector3<f64>| (*point - ball.centre).norm_squared();
            let furthest = points.iter().max_by(|a, b| distance(a).total_cmp(&distance(b)));
            let Some(&furthest) = furthest.filter(|point| !ball.holds(point)) else { return ball };
            let mut tried = support.clone();
            tried.push(furthest);
            let Some((larger, on)) = smallest(&tried).filter(|(larger, _)| larger.radius > ball.radius)
            else {
                // Only rounding errors remain: extend the sphere to the point about its center.
                return Self { radius: (furthest - ball.centre).norm(), ..ball };
            };
            (ball, support) = (larger, on);
        }
    }

    fn holds(&self, point: &Vector3<f64>) -> bool {
        (point - self.centre).norm() <= self.radius * (1.0 + ROUNDING)
    }
}

/// Returns the smallest ball around at most five points, and the points on it: the smallest ball of
/// a subset of up to four points that contains all points.
fn smallest(points: &[Vector3<f64>]) -> Option<(Ball, Vec<Vector3<f64>>)> {
    let subsets = (1_u32..1 << points.len()).filter(|subset| subset.count_ones() <= 4);
    let balls = subsets.filter_map(|subset| {
        let chosen = points.iter().enumerate().filter(|(i, _)| subset >> i & 1 == 1).map(|(_, point)| *point);
        let chosen = chosen.collect::<Vec<_>>();
        let ball = circumscribed(&chosen)?;
        points.iter().all(|point| ball.holds(point)).then_some((ball, chosen))
    });
    balls.min_by(|a, b| a.0.radius.total_cmp(&b.0.radius))
}

/// Returns the ball through one to four points with its center `p_0 + Σ λ_j d_j` in their span,
/// `d_j = p_j − p_0`: `d_iᵀ d_j λ_j = d_iᵀ d_i / 2`. Returns `None` for degenerate points.
fn circumscribed(points: &[Vector3<f64>]) -> Option<Ball> {
    let (first, others) = points.split_first()?;
    let d = Vector3::from_fn(|j, _| others.get(j).map(|point| point - first).unwrap_or_default());
    let gram = Matrix3::from_fn(|i, j| match i < others.len() && j < others.len() {
        true => d[i].dot(&d[j]),
        false => f64::from(u8::from(i == j)),
    });
    let half = Vector3::from_fn(|i, _| d[i].norm_squared() / 2.0);
    let lambda = gram.lu().solve(&half)?;
    let offset = d[0] * lambda[0] + d[1] * lambda[1] + d[2] * lambda[2];
    let radius = offset.norm();
    radius.is_finite().then(|| Ball { centre: first + offset, radius })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_of_a_box_are_on_their_sphere() {
        let corners =
            (0..8).map(|i| Vector3::from([0, 1, 2].map(|k| f64::from(k + 1) * f64::from(i >> k & 1))));
        let ball = Ball::around(&corners.collect::<Vec<_>>());
        assert!((ball.radius - 14_f64.sqrt() / 2.0).abs() < 1e-12);
        assert!((ball.centre - Vector3::new(0.5, 1.0, 1.5)).norm() < 1e-12);
    }

    #[test]
    fn one_point_equal_points_and_none() {
        assert_eq!(Ball::around(&[]).radius, 0.0);
        let point = Vector3::new(1.0, 2.0, 3.0);
        let ball = Ball::around(&[point; 3]);
        assert_eq!((ball.centre, ball.radius), (point, 0.0));
    }
}
