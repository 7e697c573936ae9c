//! First three joints that bring a point to its place.

use abbe_core::VariableKind;

use super::{Angle, Joint, Line, Partial, Probes, Root, Rounding, angle_between, linear, reject};
use crate::graph::{Graph, Node, Vector};

/// Axes of the first three joints, and a point that they move, with all joints at zero.
pub(super) struct Arm<'a> {
    pub(super) lines: [Line; 3],
    pub(super) point: Vector,
    pub(super) probes: &'a Probes,
    pub(super) free: [Angle; 3],
}

impl Arm<'_> {
    /// Returns the joints, at most four sets, that bring the point to `to`. Returns `None` if no
    /// two consecutive axes are parallel or intersect.
    pub(super) fn solve(&self, g: &mut Graph, to: Vector) -> Option<Vec<Partial>> {
        let [first, second, third] = &self.lines;
        let turns = |line: &Line| line.kind == VariableKind::Revolute;
        let probes = self.probes;
        if !turns(first)
            || !turns(second)
            || probes.are_parallel(g, first.along, second.along) && self.is_same(g)
        {
            return None;
        }
        if !turns(third) {
            return self.with_slide(g, to);
        }
        let moved = probes.offset(g, third, self.point);
        if probes.are_zero(g, &moved, probes.size) {
            return None;
        }
        if probes.are_parallel(g, second.along, third.along) {
            let between = probes.offset(g, second, third.at);
            let is_one = probes.are_zero(g, &between, probes.size);
            return (!is_one && !probes.are_parallel(g, first.along, second.along))
                .then(|| self.planar(g, to));
        }
        if probes.are_parallel(g, first.along, second.along) {
            return Some(self.behind_parallel(g, to));
        }
        if let Some(centre) = probes.common_point(g, first, second) {
            return self.behind_intersecting(g, to, centre);
        }
        let centre = probes.common_point(g, second, third)?;
        let away = g.sub_vectors(centre, first.at);
        let away = reject(g, first.along, away);
        (!probes.are_zero(g, &away, probes.size)).then(|| self.before_intersecting(g, to, centre))
    }

    /// Returns `true` if the first two axes are the same line.
    fn is_same(&self, g: &mut Graph) -> bool {
        let between = self.probes.offset(g, &self.lines[0], self.lines[1].at);
        self.probes.are_zero(g, &between, self.probes.size)
    }

    fn size(&self) -> f64 {
        self.probes.size * self.probes.size
    }

    /// The last two axes are parallel: the first joint brings the point to its height along them.
    fn planar(&self, g: &mut Graph, to: Vector) -> Vec<Partial> {
        let [first, second, third] = self.lines;
        let to = g.sub_vectors(to, first.at);
        let kept = self.probes.between(g, self.point, first.at);
        let height = g.dot(second.along, kept);
        let between = self.probes.between(g, first.at, second.at);
        let roots =
            back_to_height(g, [first.along, second.along], to, height, self.free[0], self.probes.size);
        let mut found = Vec::new();
        for root in roots {
            let back = root.angle.signed(g, -1.0).turn(g, first.along, to);
            let reach = g.add_vectors(back, between);
            let free = [self.free[1], self.free[2]];
            for [q2, q3] in plane(g, self.probes, [&second, &third], self.point, reach, free) {
                found.push(Partial::new(vec![root, q2, q3]));
            }
        }
        found
    }

    /// The first two axes are parallel: the third joint brings the point to its height along them.
    fn behind_parallel(&self, g: &mut Graph, to: Vector) -> Vec<Partial> {
        let [first, second, _] = self.lines;
        let away = g.sub_vectors(to, second.at);
        let height = g.dot(second.along, away);
        let Moved { fixed, across, beyond } = self.moved_by_third(g, second.at);
        let [k, c, s] = [fixed, across, beyond].map(|part| g.dot(second.along, part));
        let k = g.sub(k, height);
        let thirds = linear(g, [k, c, s], self.free[2], self.probes.size);
        let between = g.sub_vectors(second.at, first.at);
        let between = reject(g, first.along, between);
        let between = self.probes.cleaned_vector(g, between, self.probes.size);
        let to = g.sub_vectors(to, first.at);
        let mut found = Vec::new();
        for q3 in thirds {
            let u = Moved { fixed, across, beyond }.at(g, q3.angle);
            // |between + R_2 u|² = |to|² in the plane across the axes.
            let [flat_u, flat_to] = [u, to].map(|v| reject(g, first.along, v));
            for q2 in elbow_angles(g, second.along, [between, flat_u], flat_to, self.free[1], self.size()) {
                let reached = q2.angle.turn(g, second.along, flat_u);
                let reached = g.add_vectors(between, reached);
                let q1 = angle_between(g, first.along, reached, flat_to, self.free[0], self.probes.size);
                found.push(Partial::new(vec![Root { angle: q1.normalized(g), exists: q2.exists }, q2, q3]));
            }
        }
        found
    }

    /// The first two axes intersect: the third joint brings the point to its distance from there.
    /// Returns `None` if it changes no distance, because its axis goes through the same point.
    fn behind_intersecting(&self, g: &mut Graph, to: Vector, centre: Vector) -> Option<Vec<Partial>> {
        let to = g.sub_vectors(to, centre);
        let reach = g.dot(to, to);
        let moved = self.moved_by_third(g, centre);
        let Moved { fixed, across, beyond } = moved;
        let [ff, aa, fa, fb] =
            [(fixed, fixed), (across, across), (fixed, across), (fixed, beyond)].map(|(a, b)| g.dot(a, b));
        let k = g.add(ff, aa);
        let k = g.sub(k, reach);
        let [c, s] = [fa, fb].map(|product| g.add(product, product));
        if self.probes.are_zero(g, &[c, s], self.size()) {
            return None;
        }
        let thirds = linear(g, [k, c, s], self.free[2], self.size());
        let mut found = Vec::new();
        for q3 in thirds {
            let u = moved.at(g, q3.angle);
            found.extend(self.turned_about_centre(g, u, to).map(|[q1, q2]| Partial::new(vec![q1, q2, q3])));
        }
        Some(found)
    }

    /// Returns the angles of the first two joints, whose axes intersect, that turn `u` to `to`.
    fn turned_about_centre(&self, g: &mut Graph, u: Vector, to: Vector) -> [[Root; 2]; 2] {
        let [first, second, _] = self.lines;
        let height = g.dot(first.along, to);
        let seconds = to_height(g, [first.along, second.along], u, height, self.free[1], self.probes.size);
        seconds.map(|q2| {
            let reached = q2.angle.turn(g, second.along, u);
            let q1 = angle_between(g, first.along, reached, to, self.free[0], self.probes.size);
            [Root { angle: q1.normalized(g), exists: q2.exists }, q2]
        })
    }

    /// The last two axes intersect: the first joint brings the point to its distance from there.
    fn before_intersecting(&self, g: &mut Graph, to: Vector, centre: Vector) -> Vec<Partial> {
        let [first, second, third] = self.lines;
        let to = g.sub_vectors(to, first.at);
        let [away, kept] = [g.sub_vectors(centre, first.at), g.sub_vectors(self.point, centre)];
        // |R_1ᵀ to − away|² = |kept|², and R_1ᵀ to · away is a form of q_1.
        let [tt, aa, kk] = [(to, to), (away, away), (kept, kept)].map(|(a, b)| g.dot(a, b));
        let (half, sum) = (g.constant(0.5), g.add(tt, aa));
        let difference = g.sub(sum, kk);
        let product = g.mul(half, difference);
        let flat_away = reject(g, first.along, away);
        let height = g.dot(first.along, away);
        let along = g.dot(first.along, to);
        let rest = g.mul(height, along);
        let k = g.sub(rest, product);
        let c = g.dot(flat_away, to);
        let beyond = g.cross(first.along, flat_away);
        let s = g.dot(beyond, to);
        let mut found = Vec::new();
        for q1 in linear(g, [k, c, s], self.free[0], self.size()) {
            let back = q1.angle.signed(g, -1.0).turn(g, first.along, to);
            let back = g.sub_vectors(back, away);
            let height = g.dot(second.along, back);
            let thirds =
                to_height(g, [second.along, third.along], kept, height, self.free[2], self.probes.size);
            for q3 in thirds {
                let reached = q3.angle.turn(g, third.along, kept);
                let q2 = angle_between(g, second.along, reached, back, self.free[1], self.probes.size);
                found.push(Partial::new(vec![q1, Root { angle: q2.normalized(g), exists: q3.exists }, q3]));
            }
        }
        found
    }

    /// The third joint is a slide behind axes that intersect or are parallel.
    fn with_slide(&self, g: &mut Graph, to: Vector) -> Option<Vec<Partial>> {
        let [first, second, slide] = self.lines;
        let (probes, size) = (self.probes, self.size());
        let from = |g: &mut Graph, origin: Vector| [self.point, to].map(|point| g.sub_vectors(point, origin));
        let mut found = Vec::new();
        if probes.are_parallel(g, first.along, second.along) {
            let climb = g.dot(second.along, slide.along);
            if probes.are_zero(g, &[climb], 1.0) {
                return None;
            }
            let [start, away] = from(g, second.at);
            let [from, to] = [start, away].map(|v| g.dot(second.along, v));
            let way = g.sub(to, from);
            let travel = g.div(way, climb);
            let u = g.add_scaled(start, travel, slide.along);
            let between = g.sub_vectors(second.at, first.at);
            let [between, u, away] = {
                let to = g.add_vectors(away, between);
                [between, u, to].map(|v| reject(g, first.along, v))
            };
            for q2 in elbow_angles(g, second.along, [between, u], away, self.free[1], size) {
                let reached = q2.angle.turn(g, second.along, u);
                let reached = g.add_vectors(between, reached);
                let q1 = angle_between(g, first.along, reached, away, self.free[0], self.probes.size)
                    .normalized(g);
                let q1 = Root { angle: q1, exists: q2.exists };
                let joints = vec![Joint::Turn(q1), Joint::Turn(q2), Joint::Slide(travel)];
                found.push(Partial { joints, exists: vec![] });
            }
            return Some(found);
        }
        // |start + d slide|² = |to|²
        let centre = probes.common_point(g, &first, &second)?;
        let [start, away] = from(g, centre);
        let [middle, ss, tt] = [(start, slide.along), (start, start), (away, away)].map(|(a, b)| g.dot(a, b));
        let middle = g.neg(middle);
        let square = g.mul(middle, middle);
        let square = g.sub(square, ss);
        let square = g.add(square, tt);
        let slack = g.constant(Rounding::Cosine.size(g) * size);
        let exists = g.add(square, slack);
        let zero = g.zero();
        let square = g.max(square, zero);
        let half = g.sqrt(square);
        for travel in [g.add(middle, half), g.sub(middle, half)] {
            let u = g.add_scaled(start, travel, slide.along);
            for [q1, q2] in self.turned_about_centre(g, u, away) {
                let joints = vec![Joint::Turn(q1), Joint::Turn(q2), Joint::Slide(travel)];
                found.push(Partial { joints, exists: vec![exists] });
            }
        }
        Some(found)
    }

    /// Returns the point relative to `origin`, which the third joint moves on a circle.
    fn moved_by_third(&self, g: &mut Graph, origin: Vector) -> Moved {
        let third = &self.lines[2];
        let across = self.probes.offset(g, third, self.point);
        let beyond = g.cross(third.along, across);
        let fixed = g.sub_vectors(self.point, across);
        let fixed = g.sub_vectors(fixed, origin);
        Moved { fixed: self.probes.cleaned_vector(g, fixed, self.probes.size), across, beyond }
    }
}

/// Point on a circle: `fixed + across cos θ + beyond sin θ`.
#[derive(Clone, Copy)]
struct Moved {
    fixed: Vector,
    across: Vector,
    beyond: Vector,
}

impl Moved {
    fn at(self, g: &mut Graph, angle: Angle) -> Vector {
        let [near, far] = [g.scale(angle.cosine, self.across), g.scale(angle.sine, self.beyond)];
        let turned = g.add_vectors(near, far);
        g.add_vectors(self.fixed, turned)
    }
}

/// Returns the angles q about `along`, for which `normal · R u` is `height`.
fn to_height(
    g: &mut Graph,
    [normal, along]: [Vector; 2],
    u: Vector,
    height: Node,
    free: Angle,
    size: f64,
) -> [Root; 2] {
    let (tilt, lift) = (g.dot(normal, along), g.dot(along, u));
    let fixed = g.mul(tilt, lift);
    let whole = g.dot(normal, u);
    let c = g.sub(whole, fixed);
    let beyond = g.cross(along, u);
    let s = g.dot(normal, beyond);
    let k = g.sub(fixed, height);
    linear(g, [k, c, s], free, size)
}

/// Returns the angles q about `along`, for which `normal · Rᵀ u` is `height`.
pub(super) fn back_to_height(
    g: &mut Graph,
    [along, normal]: [Vector; 2],
    u: Vector,
    height: Node,
    free: Angle,
    size: f64,
) -> [Root; 2] {
    let back = free.signed(g, -1.0);
    to_height(g, [normal, along], u, height, back, size).map(|root| {
        let angle = root.angle.signed(g, -1.0);
        Root { angle, ..root }
    })
}

/// Returns the angles about `along`, for which `|lower + R upper|` is the length of `to`. All are
/// vectors across `along`.
fn elbow_angles(
    g: &mut Graph,
    along: Vector,
    [lower, upper]: [Vector; 2],
    to: Vector,
    free: Angle,
    size: f64,
) -> [Root; 2] {
    let [ll, uu, tt, c] =
        [(lower, lower), (upper, upper), (to, to), (lower, upper)].map(|(a, b)| g.dot(a, b));
    let beyond = g.cross(along, upper);
    let s = g.dot(lower, beyond);
    let (sum, half) = (g.add(ll, uu), g.constant(0.5));
    let difference = g.sub(sum, tt);
    let k = g.mul(half, difference);
    linear(g, [k, c, s], free, size)
}

/// Returns the angles of two joints with parallel axes that bring a point in their plane to `reach`
/// from the first axis.
pub(super) fn plane(
    g: &mut Graph,
    probes: &Probes,
    [first, second]: [&Line; 2],
    point: Vector,
    reach: Vector,
    free: [Angle; 2],
) -> [[Root; 2]; 2] {
    let along = first.along;
    let sign = g.dot(along, second.along);
    let sign = probes.nominal(g, sign);
    let [lower, upper] = [(second.at, first.at), (point, second.at)].map(|(a, b)| {
        let way = probes.between(g, a, b);
        reject(g, along, way)
    });
    let reach = reject(g, along, reach);
    let size = probes.size * probes.size;
    let bend = free[1].signed(g, sign);
    elbow_angles(g, along, [lower, upper], reach, bend, size).map(|root| {
        let turned = root.angle.turn(g, along, upper);
        let reached = g.add_vectors(lower, turned);
        let q = angle_between(g, along, reached, reach, free[0], probes.size).normalized(g);
        let angle = root.angle.signed(g, sign);
        [Root { angle: q, exists: root.exists }, Root { angle, ..root }]
    })
}
