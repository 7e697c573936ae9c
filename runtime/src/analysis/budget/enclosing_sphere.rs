//! The smallest sphere around a cloud of points that passes by once.

use nalgebra::{Matrix3, Vector3};

/// A sphere around all points of a cloud. Lengths in the length unit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sphere {
    /// Its centre.
    pub centre: [f64; 3],
    /// Its radius.
    pub radius: f64,
    /// How much smaller the smallest sphere may be, at most: 0 where this is it.
    pub excess: f64,
}

/// A point this much outside, in shares of the radius, is inside.
const ROUNDING: f64 = 1e-12;
/// Points inside but this near to the sphere are kept, in shares of the radius.
const SHELL: f64 = 0.1;
/// The most of them that are kept: some 25 MB.
const KEPT: usize = 1 << 20;

/// The smallest sphere around points that come one by one.
///
/// A point outside the sphere so far becomes a candidate, and the sphere that of all candidates; its radius r is
/// never larger than that of the smallest sphere. Points just inside are kept, and become candidates in the end.
/// All others are forgotten; while the sphere had the centre c_j they were within a distance r_j of it, and so they
/// are within `max_j ‖c − c_j‖ + r_j` of the centre in the end. Where this is no more than r, the sphere is the
/// smallest. Beginning with points from everywhere keeps the centre from moving far.
#[derive(Default)]
pub(super) struct Enclosing {
    candidates: Vec<Vector3<f64>>,
    /// At most four of them, on the sphere.
    support: Vec<Vector3<f64>>,
    ball: Ball,
    /// Points just inside.
    shell: Vec<Vector3<f64>>,
    /// The furthest point that was forgotten while the centre was where it is.
    forgotten: f64,
    /// The same for the centres before.
    earlier: Vec<Ball>,
}

/// Points within the inner radius of the centre need not be kept.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shell {
    pub(super) centre: [f64; 3],
    pub(super) inner: f64,
}

#[derive(Clone, Copy, Debug, Default)]
struct Ball {
    centre: Vector3<f64>,
    radius: f64,
}

impl Ball {
    fn holds(&self, point: &Vector3<f64>) -> bool {
        (point - self.centre).norm() <= self.radius * (1.0 + ROUNDING)
    }
}

impl Enclosing {
    /// Of points that are all kept.
    pub(super) fn new(points: impl Iterator<Item = [f64; 3]>) -> Self {
        let mut sphere = Self { candidates: points.map(Vector3::from).collect(), ..Self::default() };
        if let Some(first) = sphere.candidates.first().copied() {
            sphere.support = vec![first];
            sphere.ball = Ball { centre: first, radius: 0.0 };
            sphere.grow();
        }
        sphere
    }

    /// Takes in a point.
    pub(super) fn add(&mut self, point: [f64; 3]) {
        let point = Vector3::from(point);
        let distance = (point - self.ball.centre).norm();
        if self.candidates.is_empty() {
            *self = Self::new([point.into()].into_iter());
        } else if !self.ball.holds(&point) {
            self.earlier.push(Ball { centre: self.ball.centre, radius: self.forgotten });
            self.forgotten = 0.0;
            self.candidates.push(point);
            self.grow();
        } else if distance > (1.0 - SHELL) * self.ball.radius && self.shell.len() < KEPT {
            self.shell.push(point);
        } else {
            self.forgotten = self.forgotten.max(distance);
        }
    }

    /// What is certainly inside, and will be, as long as the sphere is where it is now.
    pub(super) fn shell(&self) -> Shell {
        Shell { centre: self.ball.centre.into(), inner: (1.0 - SHELL) * self.ball.radius }
    }

    /// Takes in points within a distance of the centre that the sphere began with.
    pub(super) fn forget(&mut self, distance: f64) {
        let first = self.earlier.first_mut().map_or(&mut self.forgotten, |first| &mut first.radius);
        *first = first.max(distance);
    }

    pub(super) fn finish(mut self) -> Sphere {
        self.earlier.push(Ball { centre: self.ball.centre, radius: self.forgotten });
        self.candidates.append(&mut self.shell);
        self.grow();
        let Ball { centre, radius } = self.ball;
        let reach = |earlier: &Ball| (centre - earlier.centre).norm() + earlier.radius;
        let certain = self.earlier.iter().map(reach).fold(radius, f64::max);
        Sphere { centre: centre.into(), radius: certain, excess: certain - radius }
    }

    /// Takes in the furthest candidate again and again until all are inside; the radius grows every time.
    fn grow(&mut self) {
        loop {
            let distance = |point: &&Vector3<f64>| (*point - self.ball.centre).norm_squared();
            let furthest = self.candidates.iter().max_by(|a, b| distance(a).total_cmp(&distance(b)));
            let Some(&furthest) = furthest.filter(|point| !self.ball.holds(point)) else { return };
            let mut points = self.support.clone();
            points.push(furthest);
            let Some((ball, support)) = smallest(&points).filter(|(ball, _)| ball.radius > self.ball.radius)
            else {
                // Rounding is all that is left: the sphere takes the point in about its centre.
                self.ball.radius = (furthest - self.ball.centre).norm();
                return;
            };
            (self.ball, self.support) = (ball, support);
        }
    }
}

/// The smallest ball around at most five points, and those that are on it: of the balls of all subsets of up to
/// four the smallest that holds all.
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

/// The ball through one to four points with its centre `p_0 + Σ λ_j d_j` in their span, `d_j = p_j − p_0`:
/// `d_iᵀ d_j λ_j = d_iᵀ d_i / 2`. None if they are in line or in one plane with too many.
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
    use crate::analysis::sampling::{halton, norm};

    fn cloud(count: usize) -> impl Iterator<Item = [f64; 3]> {
        (1..=count).map(|i| core::array::from_fn(|k| (k + 1) as f64 * (halton(i, k) - 0.5) + 10.0))
    }

    #[test]
    fn corners_of_a_box_are_on_their_sphere() {
        let corners = (0..8).map(|i| [0, 1, 2].map(|k| f64::from(k + 1) * f64::from(i >> k & 1)));
        let sphere = Enclosing::new(corners).finish();
        assert!((sphere.radius - 14_f64.sqrt() / 2.0).abs() < 1e-12 && sphere.excess == 0.0);
        assert!(norm(core::array::from_fn(|k| sphere.centre[k] - (k + 1) as f64 / 2.0)) < 1e-12);
    }

    #[test]
    fn one_point_equal_points_and_none() {
        assert_eq!(Enclosing::default().finish(), Sphere::default());
        let mut sphere = Enclosing::default();
        for _ in 0..3 {
            sphere.add([1.0, 2.0, 3.0]);
        }
        assert_eq!(sphere.finish(), Sphere { centre: [1.0, 2.0, 3.0], radius: 0.0, excess: 0.0 });
    }

    #[test]
    fn a_stream_comes_within_what_it_says_of_the_smallest() {
        let exact = Enclosing::new(cloud(5000)).finish();
        let mut stream = Enclosing::new(cloud(5000).skip(7).step_by(25));
        cloud(5000).for_each(|point| stream.add(point));
        let found = stream.finish();
        assert!(exact.excess == 0.0 && found.excess == 0.0, "{found:?}");
        assert!((found.radius / exact.radius - 1.0).abs() < 1e-9);
        // Without a good beginning it says how far off it may be.
        let mut blind = Enclosing::default();
        cloud(5000).for_each(|point| blind.add(point));
        let blind = blind.finish();
        assert!(blind.radius - blind.excess <= exact.radius * (1.0 + 1e-9));
        assert!(
            blind.radius >= exact.radius * (1.0 - 1e-9) && blind.excess < 0.5 * exact.radius,
            "{blind:?}"
        );
        for point in cloud(5000) {
            let from = |sphere: &Sphere| norm(core::array::from_fn(|k| point[k] - sphere.centre[k]));
            assert!(from(&exact) <= exact.radius * (1.0 + 1e-9));
            assert!(from(&found) <= found.radius * (1.0 + 1e-9));
        }
    }
}
