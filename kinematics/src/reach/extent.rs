//! Enclosures of positions in cylindrical and spherical coordinates about the axis of a joint.

use core::f64::consts::{PI, TAU};

use crate::sampling::norm;
use abbe_core::Pose;

/// Widening of the enclosures, in arm lengths: exceeds the rounding errors and those of the chain's
/// constants.
pub(super) const SLACK: f64 = 1e-7;

pub(super) type Interval = [f64; 2];

/// Unbounded interval.
pub(super) const ANY: Interval = [f64::NEG_INFINITY, f64::INFINITY];

/// Enclosure of points: intervals of the coordinate along an axis, the distance from the axis, the
/// distance from the origin, and the angle about the axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent {
    along: Interval,
    off: Interval,
    away: Interval,
    /// Angle from x towards y. A width of a full turn or more means any angle.
    about: Interval,
}

impl Extent {
    /// Encloses a point.
    pub(super) fn from_point(point: [f64; 3]) -> Self {
        let [x, y, z] = point;
        Self { along: [z; 2], off: [x.hypot(y); 2], away: [norm(point); 2], about: [y.atan2(x); 2] }
    }

    /// Returns whether a point is in the enclosure.
    pub(super) fn holds(&self, point: [f64; 3]) -> bool {
        let Self { along, off, away, about: [first, last] } = *self;
        let [x, y, z] = point;
        let square = x * x + y * y;
        let (radius, distance) = (square.sqrt(), (square + z * z).sqrt());
        if !(inside(z, along) && inside(radius, off) && inside(distance, away)) {
            return false;
        }
        // Angular distance beyond the last angle or before the first.
        let beside = || {
            let past = (y.atan2(x) - first).rem_euclid(TAU) - (last - first);
            past.min(TAU - (last - first) - past)
        };
        any(last - first) || beside() * radius <= SLACK
    }

    /// Encloses `u · x = u_z z + u_ρ ρ cos(φ − φ_u)`, which is at most `|u| r`.
    pub(super) fn along(&self, u: [f64; 3]) -> Interval {
        let across = times(stretched(self.off, self.cosines(u)), u[0].hypot(u[1]));
        let [least, most] = sum(times(self.along, u[2]), across);
        let most_of_all = times(self.away, norm(u))[1];
        [least.max(-most_of_all), most.min(most_of_all)]
    }

    /// Encloses the points rotated about the axis by any angle between two limits.
    pub(super) fn turned(&self, limits: Interval) -> Self {
        Self { about: sum(self.about, limits), ..*self }
    }

    /// Encloses the points translated along the axis by any distance between two limits.
    pub(super) fn slid(&self, limits: Interval) -> Self {
        let along = sum(self.along, limits);
        let away = [least_size(along).hypot(self.off[0]), largest_size(along).hypot(self.off[1])];
        Self { along, away, ..*self }
    }

    /// Encloses the points in the coordinates of the preceding frame, `x' = R x + d`.
    ///
    /// Each component is `u · x + d_i` with `u` a row of `R`; together they form a box. With
    /// `w = Rᵀ d`, `r'² = (z + w_z)² + ρ² + w_ρ² + 2 w_ρ ρ cos(φ − φ_w) = r² + d² + 2 w · x`, and
    /// `|r − |d|| ≤ r' ≤ r + |d|`. The distance from the new axis is `ρ' = |(R x)_⊥ + d_⊥|` with
    /// `(R x)_⊥² = r² − (u_z · x)²`, and `ρ'² = r'² − z'²`. Each of these encloses the points, and
    /// so does their intersection.
    pub(super) fn in_preceding_frame(&self, motion: &Pose) -> Self {
        let d = motion.position();
        let w = motion.inverse().turn(d);
        let row = |i: usize| [motion.0[0][i], motion.0[1][i], motion.0[2][i]];
        let shares = [0, 1, 2].map(|i| self.along(row(i)));
        let sides: [Interval; 3] = core::array::from_fn(|i| sum(shares[i], [d[i]; 2]));
        let along = sides[2];

        let across = beside(self.off, w[0].hypot(w[1]), self.cosines(w));
        let (height, length) = (sum(self.along, [w[2]; 2]), norm(d));
        let twice = times(self.along(w), 2.0);
        let squares = [0, 1].map(|end| square(self.away[end]) + square(length) + twice[end]);
        let flat = [
            least_size(sides[0]).hypot(least_size(sides[1])),
            largest_size(sides[0]).hypot(largest_size(sides[1])),
        ];
        let away = common([
            [least_size(height).hypot(across[0]), largest_size(height).hypot(across[1])],
            squares.map(|square| square.max(0.0).sqrt()),
            [least_size(sum(self.away, [-length; 2])), self.away[1] + length],
            [flat[0].hypot(least_size(along)), flat[1].hypot(largest_size(along))],
        ]);

        let offset = d[0].hypot(d[1]);
        // Parallel axes: the distance from the axis is preserved by the rotation.
        let parallel = motion.0[2][0] == 0.0 && motion.0[2][1] == 0.0;
        let turned = if parallel { self.off } else { legs(self.away, shares[2]) };
        let off = common([
            flat,
            legs(away, along),
            [least_size(sum(turned, [-offset; 2])), turned[1] + offset],
            if parallel { across } else { [0.0, f64::INFINITY] },
        ]);
        Self { along, off, away, about: angles(sides[0], sides[1]) }
    }

    /// Encloses the cosines of the angles between the points and a direction, projected along the
    /// axis.
    fn cosines(&self, u: [f64; 3]) -> Interval {
        let from = u[1].atan2(u[0]);
        let [first, last] = self.about.map(|angle| angle - from);
        if any(last - first) {
            return [-1.0, 1.0];
        }
        let passes = |angle: f64| ((first - angle) / TAU).ceil() * TAU + angle <= last;
        let (a, b) = (first.cos(), last.cos());
        [if passes(PI) { -1.0 } else { a.min(b) }, if passes(0.0) { 1.0 } else { a.max(b) }]
    }
}

/// Returns whether an interval of angles covers the full turn.
fn any(width: f64) -> bool {
    // NaN counts as unbounded.
    width.is_nan() || width >= TAU
}

/// Encloses the angles of a rectangle as seen from the origin: those of its corners, or any angle
/// if it contains the origin.
fn angles(x: Interval, y: Interval) -> Interval {
    let middle = [(x[0] + x[1]) / 2.0, (y[0] + y[1]) / 2.0];
    let around = least_size(x) == 0.0 && least_size(y) == 0.0;
    if around || !(middle[0].is_finite() && middle[1].is_finite()) {
        return ANY;
    }
    let mut widest = [0.0_f64; 2];
    for corner in [[x[0], y[0]], [x[0], y[1]], [x[1], y[0]], [x[1], y[1]]] {
        let sine = middle[0] * corner[1] - middle[1] * corner[0];
        let angle = sine.atan2(middle[0] * corner[0] + middle[1] * corner[1]);
        widest = [widest[0].min(angle), widest[1].max(angle)];
    }
    sum([middle[1].atan2(middle[0]); 2], widest)
}

/// Encloses `√(ρ² + w² + 2 w ρ c)`, which increases with c, and with ρ beyond `−w c`.
fn beside(off: Interval, wide: f64, cosines: Interval) -> Interval {
    let at = |radius: f64, cosine: f64| {
        // (ρ + w c)² + w² (1 − c²)
        (radius + wide * cosine).hypot(wide * (1.0 - cosine * cosine).max(0.0).sqrt())
    };
    let [least, most] = cosines;
    let nearest = (-wide * least).max(off[0]).min(off[1]);
    [at(nearest, least), at(off[0], most).max(at(off[1], most))]
}

/// Encloses `ρ c`.
fn stretched(off: Interval, cosines: Interval) -> Interval {
    [times(off, cosines[0])[0], times(off, cosines[1])[1]]
}

/// Encloses the second legs of right triangles with this hypotenuse and leg.
fn legs(hypotenuse: Interval, leg: Interval) -> Interval {
    let root = |hypotenuse: f64, leg: f64| (hypotenuse * hypotenuse - leg * leg).max(0.0).sqrt();
    let most = if hypotenuse[1].is_finite() { root(hypotenuse[1], least_size(leg)) } else { f64::INFINITY };
    [root(hypotenuse[0], largest_size(leg)), most]
}

/// Returns the intersection.
fn common<const N: usize>(intervals: [Interval; N]) -> Interval {
    intervals.into_iter().fold(ANY, |a, b| [a[0].max(b[0]), a[1].min(b[1])])
}

pub(super) fn inside(value: f64, [least, most]: Interval) -> bool {
    least - SLACK <= value && value <= most + SLACK
}

pub(super) fn sum(a: Interval, b: Interval) -> Interval {
    [a[0] + b[0], a[1] + b[1]]
}

pub(super) fn times(a: Interval, factor: f64) -> Interval {
    if factor == 0.0 {
        return [0.0; 2];
    }
    let [least, most] = a.map(|end| end * factor);
    [least.min(most), least.max(most)]
}

fn square(value: f64) -> f64 {
    value * value
}

/// Returns the smallest absolute value in the interval.
fn least_size([least, most]: Interval) -> f64 {
    least.max(-most).max(0.0)
}

/// Returns the largest absolute value in the interval.
fn largest_size([least, most]: Interval) -> f64 {
    most.max(-least)
}
