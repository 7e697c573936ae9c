//! Control points: numbers that enclose the values of a polynomial over the range of one name.
//!
//! A range is the segment between its ends v₀ and v₂. An arc lies within the triangle of its ends
//! v₀, v₂ and the intersection v₁ of the tangents there, `1/cos h` from the centre of the circle,
//! where h is half of the arc. A point of either is `Σ λ_a v_a` with λ ≥ 0 and `Σ λ = 1`.
//!
//! An affine part has the values `Σ λ_a f(v_a)`: its control points are those at the vertices. With
//! more vertices, where further tangents meet, the polygon is tighter. A quadratic part has the
//! values `Σ λ_a λ_b F(v_a, v_b)` with the polar form (Farin, *Curves and Surfaces for CAGD*,
//! chapter 4)
//!
//! ```text
//! F(a, b) = 2 f((a + b)/2) − f(a)/2 − f(b)/2        F(a, a) = f(a)
//! ```
//!
//! which are its control points. On the circle `λ₁² = 4 cos² h λ₀ λ₂`, so `F(v₁, v₁)` and
//! `F(v₀, v₂)` always occur with the weights w and 1 − w, where `w = 2 cos² h / (1 + 2 cos² h)`, and
//! count as one.

use crate::{affine::Affine, vertex::Number};

/// Sine and cosine of an angle, or the value of a linear name and an unused number.
pub(crate) type Vertex = [Affine<0>; 2];

/// Number of pieces of an arc between its tangents, for affine parts. More pieces need fewer boxes
/// but more time for each.
const PIECES: usize = 2;
/// Maximum number of points at which affine parts are evaluated along a name.
pub(crate) const AFFINE: usize = 2 + PIECES;
/// Maximum number of points at which quadratic parts are evaluated along a name.
pub(crate) const QUADRATIC: usize = 6;
/// Maximum number of control points along a name.
const MOST: usize = 5;
/// Maximum of half of the arc between two tangents, rad: those of longer ones meet too far away.
const LONGEST: f64 = 1.2;

/// Points at which parts are evaluated along one name, and the control points that follow.
#[derive(Clone, Debug)]
pub(crate) struct Controls {
    /// Points of evaluation.
    pub(crate) samples: Vec<Vertex>,
    rule: Rule,
}

/// Computation of control points from values at samples. The first two are those at the ends.
#[derive(Clone, Copy, Debug)]
enum Rule {
    /// The values themselves.
    Same,
    /// Samples: both ends and the middle.
    Range,
    /// Samples: v₀, v₂, v₁, and the middles of v₀ v₁, v₁ v₂ and v₀ v₂; with the weight w.
    Arc(Affine<0>),
}

/// Degree of the parts in a name, and whether it is an angle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shape {
    pub(crate) is_angle: bool,
    pub(crate) is_quadratic: bool,
}

impl Shape {
    /// Returns `true` if an arc is too long for a useful bound.
    pub(crate) fn is_too_long(self, ends: [f64; 2]) -> bool {
        self.is_angle && self.half_piece(ends).range()[1] > LONGEST
    }

    /// Returns the largest number of samples.
    pub(crate) fn samples(self) -> usize {
        match (self.is_angle, self.is_quadratic) {
            (false, false) => 2,
            (false, true) => 3,
            (true, false) => AFFINE,
            (true, true) => QUADRATIC,
        }
    }

    /// Returns half of an arc between two neighbouring tangents.
    fn half_piece(self, [low, high]: [f64; 2]) -> Affine<0> {
        let pieces = if self.is_quadratic { 1 } else { PIECES };
        let width = known(high).sub(&known(low));
        width.mul(&known((2 * pieces) as f64).reciprocal())
    }
}

impl Controls {
    /// Creates the control points of a range or an arc.
    pub(crate) fn new(shape: Shape, [low, high]: [f64; 2]) -> Self {
        let vertex = |x: Affine<0>| if shape.is_angle { x.sin_cos() } else { [x, known(0.0)] };
        let ends = [vertex(known(low)), vertex(known(high))];
        if low == high {
            return Self { samples: ends[..1].to_vec(), rule: Rule::Same };
        }
        let mut samples = ends.to_vec();
        let rule = match (shape.is_angle, shape.is_quadratic) {
            (false, false) => Rule::Same,
            (false, true) => {
                samples.push(middle(&ends[0], &ends[1]));
                Rule::Range
            }
            (true, is_quadratic) => {
                let half = shape.half_piece([low, high]);
                let cosine = half.sin_cos()[1];
                let distance = cosine.reciprocal();
                let pieces = if is_quadratic { 1 } else { PIECES };
                let meetings = (0..pieces).map(|piece| {
                    let angle = known(low).add(&half.mul(&known((2 * piece + 1) as f64)));
                    angle.sin_cos().map(|part| part.mul(&distance))
                });
                samples.extend(meetings);
                if is_quadratic {
                    let [first, last, meeting] = [samples[0], samples[1], samples[2]];
                    samples.extend([
                        middle(&first, &meeting),
                        middle(&meeting, &last),
                        middle(&first, &last),
                    ]);
                    let double = known(2.0).mul(&cosine).mul(&cosine);
                    Rule::Arc(double.mul(&known(1.0).add(&double).reciprocal()))
                } else {
                    Rule::Same
                }
            }
        };
        Self { samples, rule }
    }

    /// Returns the number of control points.
    pub(crate) fn count(&self) -> usize {
        match self.rule {
            Rule::Same => self.samples.len(),
            Rule::Range => 3,
            Rule::Arc(_) => MOST,
        }
    }

    /// Returns `true` if the control points are the values at the samples.
    pub(crate) fn are_samples(&self) -> bool {
        matches!(self.rule, Rule::Same)
    }

    /// Returns the position of a control point between both ends: 0 and 1 for the ends themselves.
    pub(crate) fn share(&self, control: usize) -> f64 {
        match (control, self.rule) {
            (0, _) => 0.0,
            (1, _) => 1.0,
            (at, Rule::Same) => (2 * at - 3) as f64 / (2 * PIECES) as f64,
            (_, Rule::Range) => 0.5,
            (at, Rule::Arc(_)) => (at - 1) as f64 / 4.0,
        }
    }

    /// Computes the control points from the values at the samples.
    #[inline(always)]
    pub(crate) fn points<T: Number>(&self, values: &[T; QUADRATIC]) -> [T; MOST] {
        let [first, last, third, fourth, fifth, sixth] = *values;
        let polar = |middle: T, a: T, b: T| {
            middle.mul(T::known(&known(2.0))).add(a.add(b).mul(T::known(&known(-0.5))))
        };
        match self.rule {
            Rule::Same => [first, last, third, fourth, fifth],
            Rule::Range => {
                let inner = polar(third, first, last);
                [first, last, inner, inner, inner]
            }
            Rule::Arc(weight) => {
                let rest = known(1.0).sub(&weight);
                let across = polar(sixth, first, last);
                let inner = third.mul(T::known(&weight)).add(across.mul(T::known(&rest)));
                [first, last, polar(fourth, first, third), inner, polar(fifth, third, last)]
            }
        }
    }
}

fn known(number: f64) -> Affine<0> {
    Affine::known(number, 0.0)
}

fn middle(a: &Vertex, b: &Vertex) -> Vertex {
    [0, 1].map(|part| a[part].add(&b[part]).mul(&known(0.5)))
}
