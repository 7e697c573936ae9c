//! Angles as pairs of sine and cosine, and equations that they solve.

use super::Probes;
use crate::graph::{Graph, Node, Vector};

/// Sizes that count as rounding errors, relative to those of the numbers, in double and in single
/// precision.
#[derive(Clone, Copy)]
pub(super) enum Rounding {
    /// A number below it is 0, and any angle solves its equation.
    Nothing,
    /// A vector below it has no direction: many rounding errors, so that the start is kept in spite
    /// of them.
    NoDirection,
    /// Share by which a cosine may exceed 1.
    Cosine,
    /// Share of a range beyond a limit that still counts as at the limit.
    Limit,
}

impl Rounding {
    /// Returns the size in the precision of a graph.
    pub(super) fn size(self, g: &Graph) -> f64 {
        let [double, single] = match self {
            Self::Nothing => [1e-15, 5e-7],
            Self::NoDirection => [1e-13, 5e-6],
            Self::Cosine => [1e-12, 1e-5],
            Self::Limit => [1e-13, 2e-6],
        };
        if g.is_single { single } else { double }
    }
}

/// Sine and cosine of an angle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Angle {
    pub(super) sine: Node,
    pub(super) cosine: Node,
}

/// Angle that solves an equation if `exists` is not negative.
#[derive(Clone, Copy, Debug)]
pub(super) struct Root {
    pub(super) angle: Angle,
    pub(super) exists: Node,
}

impl Angle {
    /// Returns the pair of a multiple of an angle by 1 or −1.
    pub(super) fn signed(self, g: &mut Graph, sign: f64) -> Self {
        if sign < 0.0 { Self { sine: g.neg(self.sine), ..self } } else { self }
    }

    /// Returns the pair of an angle half a turn away.
    pub(super) fn opposite(self, g: &mut Graph) -> Self {
        Self { sine: g.neg(self.sine), cosine: g.neg(self.cosine) }
    }

    /// Returns the sum of two angles.
    pub(super) fn plus(self, g: &mut Graph, other: Self) -> Self {
        let [ss, cc] = [g.mul(self.sine, other.sine), g.mul(self.cosine, other.cosine)];
        let [sc, cs] = [g.mul(self.sine, other.cosine), g.mul(self.cosine, other.sine)];
        Self { sine: g.add(sc, cs), cosine: g.sub(cc, ss) }
    }

    /// Divides a multiple of sine and cosine by its length.
    pub(super) fn normalized(self, g: &mut Graph) -> Self {
        let [ss, cc] = [self.sine, self.cosine].map(|part| g.mul(part, part));
        let square = g.add(ss, cc);
        let (length, one) = (g.sqrt(square), g.constant(1.0));
        let inverse = g.div(one, length);
        Self { sine: g.mul(self.sine, inverse), cosine: g.mul(self.cosine, inverse) }
    }

    /// Returns `v` turned about a unit vector, by Rodrigues' formula.
    pub(super) fn turn(self, g: &mut Graph, along: Vector, v: Vector) -> Vector {
        let height = g.dot(along, v);
        let parallel = g.scale(height, along);
        let flat = g.sub_vectors(v, parallel);
        let beyond = g.cross(along, v);
        let [near, far] = [g.scale(self.cosine, flat), g.scale(self.sine, beyond)];
        let turned = g.add_vectors(near, far);
        g.add_vectors(turned, parallel)
    }
}

/// Returns a multiple of the sine and cosine of the angle about a unit vector that turns `from`
/// towards `to`; `size` is that of the two vectors. If one has no direction, the angle is `free`.
pub(super) fn angle_between(
    g: &mut Graph,
    along: Vector,
    from: Vector,
    to: Vector,
    free: Angle,
    size: f64,
) -> Angle {
    let beyond = g.cross(along, from);
    let sine = g.dot(beyond, to);
    let back = g.cross(along, to);
    let cosine = g.dot(beyond, back);
    // Both vectors have none at the same time.
    let nothing = g.constant((Rounding::NoDirection.size(g) * size).powi(2));
    let [s, c] = [free.sine, free.cosine].map(|part| g.mul(nothing, part));
    Angle { sine: g.add(sine, s), cosine: g.add(cosine, c) }
}

/// Returns the two solutions of `k + c cos θ + s sin θ = 0`; `size` is that of the coefficients. If
/// every angle is one, the first is `free`.
///
/// ```text
/// A² = c² + s²,  w² = A² − k²        cos θ = (−k c ∓ s w) / A²,  sin θ = (−k s ± c w) / A²
/// ```
pub(super) fn linear(g: &mut Graph, [k, c, s]: [Node; 3], free: Angle, size: f64) -> [Root; 2] {
    let [c, s] = if g.value(c).is_some() && g.value(s).is_some() {
        [c, s]
    } else {
        // A quarter turn from the start, of which a quarter turn is a solution if k is 0.
        let nothing = g.constant(Rounding::Nothing.size(g) * size);
        let [sine, cosine] = [free.sine, free.cosine].map(|part| g.mul(nothing, part));
        [g.add(c, sine), g.sub(s, cosine)]
    };
    let [kk, cc, ss] = [k, c, s].map(|part| g.mul(part, part));
    let square = g.add(cc, ss);
    let rest = g.sub(square, kk);
    roots(g, [k, c, s], square, rest)
}

/// Returns the solutions with given A² and w².
fn roots(g: &mut Graph, [k, c, s]: [Node; 3], square: Node, rest: Node) -> [Root; 2] {
    let slack = g.constant(Rounding::Cosine.size(g));
    let exists = g.add_product(rest, slack, square);
    let zero = g.zero();
    let rest = g.max(rest, zero);
    let w = g.sqrt(rest);
    let one = g.constant(1.0);
    let inverse = g.div(one, square);
    let [kc, ks, cw, sw] = [(k, c), (k, s), (c, w), (s, w)].map(|(a, b)| g.mul(a, b));
    let [kc, ks] = [kc, ks].map(|product| g.neg(product));
    let [first, second] = [[g.add(ks, cw), g.sub(kc, sw)], [g.sub(ks, cw), g.add(kc, sw)]];
    [first, second].map(|parts| {
        let [sine, cosine] = parts.map(|part| g.mul(part, inverse));
        Root { angle: Angle { sine, cosine }, exists }
    })
}

/// Returns `true` if `second` is at right angles to both others. The two angles of [`tilt_angles`]
/// then are of opposite sign, and angles about the others half a turn apart.
pub(super) fn are_square(g: &mut Graph, [first, second, third]: [Vector; 3], probes: &Probes) -> bool {
    let products = [g.dot(first, second), g.dot(second, third)];
    probes.are_zero(g, &products, 1.0)
}

/// Returns the two angles about `second` by which `third` has to be turned so that its angle with
/// `first` is that of `image`. All are unit vectors.
///
/// With `a = first · second`, `b = second · third` and `m = first · image`, `w²` is `1 − a² − b² + 2 a
/// b m − m²`. Where a joint is straight it is 0, and has to keep its digits:
///
/// ```text
/// a = b = 0        w² = |first × image|²
/// a = ±b           w² = (1 ± m − 2 a²) |first ∓ image|² / 2
/// ```
pub(super) fn tilt_angles(
    g: &mut Graph,
    [first, second, third]: [Vector; 3],
    image: Vector,
    probes: &Probes,
) -> [Root; 2] {
    let [a, b, m] = [g.dot(first, second), g.dot(second, third), g.dot(first, image)];
    let product = g.mul(a, b);
    let k = g.sub(product, m);
    let along = g.dot(first, third);
    let c = g.sub(along, product);
    let across = g.cross(second, third);
    let s = g.dot(first, across);
    let [aa, bb, mm] = [a, b, m].map(|part| g.mul(part, part));
    let one = g.constant(1.0);
    let [flat_a, flat_b] = [aa, bb].map(|part| g.sub(one, part));
    let square = g.mul(flat_a, flat_b);
    let [same, opposite] = [g.sub(a, b), g.add(a, b)].map(|node| probes.are_zero(g, &[node], 1.0));
    let rest = if same && opposite {
        let cross = g.cross(first, image);
        g.dot(cross, cross)
    } else if same || opposite {
        let (difference, m) = match same {
            true => (g.sub_vectors(first, image), m),
            false => (g.add_vectors(first, image), g.neg(m)),
        };
        let (double, half) = (g.add(aa, aa), g.constant(0.5));
        let other = g.add(one, m);
        let other = g.sub(other, double);
        let length = g.dot(difference, difference);
        let length = g.mul(half, length);
        g.mul(other, length)
    } else {
        let mixed = g.mul(product, m);
        let mixed = g.add(mixed, mixed);
        let rest = g.sub(flat_a, bb);
        let rest = g.add(rest, mixed);
        g.sub(rest, mm)
    };
    roots(g, [k, c, s], square, rest)
}
