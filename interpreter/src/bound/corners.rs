//! What a value cannot exceed because it is convex in the sine and cosine of each angle.
//!
//! Where an angle stands only by its sine and cosine, and each part of a norm has at most one of them in a product, the part is affine in
//! the pair (cos q, sin q), and the norm is convex in it. An arc of less than half a circle lies within the triangle of its two ends and the
//! point where its tangents meet, at `1/cos h` of its middle, h being half of the arc: over the triangle the norm is largest at a vertex. So it is
//! over the product of the triangles of all angles, and of the ends of names that stand by themselves. An angle is a name here: with an offset,
//! or as a sum of joints, nothing is known.

use abbe_codegen::expr::Function;

use super::form::Form;
use super::tape::{Step, Tape};

/// Arcs that are longer have triangles that are far larger than they are: half of them, rad.
const LONGEST: f64 = 1.2;
/// How many names may move: of k angles there are 3^k vertices.
const MOST_NAMES: usize = 7;

/// How a value depends on the names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// Affine in each pair of sine and cosine, and in each name by itself: a bit for each name that it has.
    Affine(u32),
    /// A sum of squares of such, with what is not negative.
    Squares,
    /// Convex in each pair.
    Convex,
    /// Anything else.
    Other,
}

/// How the names stand in a value that is convex in each of them.
#[derive(Clone, Debug)]
pub(super) struct Corners {
    /// Whether a name is an angle.
    angles: Vec<bool>,
}

impl Corners {
    /// Those of a tape's first value; none if it is not convex, or has too many names.
    pub(super) fn new(tape: &Tape, names: usize) -> Option<Self> {
        if names == 0 || names > MOST_NAMES {
            return None;
        }
        let mut kinds: Vec<Kind> = (0..names).map(|name| Kind::Affine(1 << name)).collect();
        let (mut angles, mut alone) = (vec![false; names], vec![false; names]);
        for step in &tape.steps {
            step.registers().filter(|_| !matches!(step, Step::SinCos(_))).for_each(|register| {
                if let Some(alone) = alone.get_mut(register) {
                    *alone = true;
                }
            });
            let kind = match *step {
                Step::Known(_) => Kind::Affine(0),
                Step::Neg(a) => match kinds[a] {
                    affine @ Kind::Affine(_) => affine,
                    _ => Kind::Other,
                },
                Step::Add(a, b) => sum(kinds[a], kinds[b]),
                Step::Sub(a, b) => match (kinds[a], kinds[b]) {
                    (Kind::Affine(a), Kind::Affine(b)) => Kind::Affine(a | b),
                    _ => Kind::Other,
                },
                Step::Shift(a, number) => match kinds[a] {
                    Kind::Squares if number.range()[0] < 0.0 => Kind::Convex,
                    kind => kind,
                },
                Step::Scale(a, number) => match kinds[a] {
                    affine @ Kind::Affine(_) => affine,
                    kind if number.range()[0] >= 0.0 => kind,
                    _ => Kind::Other,
                },
                Step::Mul(a, b) => match (kinds[a], kinds[b]) {
                    (Kind::Affine(_), Kind::Affine(_)) if a == b => Kind::Squares,
                    (Kind::Affine(a), Kind::Affine(b)) if a & b == 0 => Kind::Affine(a | b),
                    _ => Kind::Other,
                },
                Step::Power(a, 2.0) if matches!(kinds[a], Kind::Affine(_)) => Kind::Squares,
                Step::Call(Function::Sqrt, a) if kinds[a] == Kind::Squares => Kind::Convex,
                Step::Call(Function::Abs, a) if matches!(kinds[a], Kind::Affine(_)) => Kind::Convex,
                Step::Larger(a, b) => match (kinds[a], kinds[b]) {
                    (Kind::Other, _) | (_, Kind::Other) => Kind::Other,
                    _ => Kind::Convex,
                },
                Step::SinCos(a) if a < names => {
                    angles[a] = true;
                    kinds.push(Kind::Affine(1 << a));
                    Kind::Affine(1 << a)
                }
                Step::SinCos(_) => {
                    kinds.push(Kind::Other);
                    Kind::Other
                }
                _ => Kind::Other,
            };
            kinds.push(kind);
        }
        let is_both = angles.iter().zip(&alone).any(|(angle, alone)| *angle && *alone);
        let output = *tape.outputs.first()?;
        if let Some(alone) = alone.get_mut(output) {
            *alone = true;
        }
        (kinds[output] != Kind::Other && !is_both).then_some(Self { angles })
    }

    /// What the value does not exceed where each name is between two ends; infinite if nothing is known.
    pub(super) fn most(&self, tape: &Tape, registers: &mut Vec<Form<0>>, low: &[f64], high: &[f64]) -> f64 {
        let mut vertices: Vec<Vec<[Form<0>; 2]>> = Vec::with_capacity(low.len());
        for ((low, high), is_angle) in low.iter().zip(high).zip(&self.angles) {
            let ends = [*low, *high].map(|end| Form::known(end, 0.0));
            let ends = if low == high { &ends[..1] } else { &ends[..] };
            if !is_angle {
                vertices.push(ends.iter().map(|end| [*end, *end]).collect());
                continue;
            }
            let mut own: Vec<[Form<0>; 2]> = ends.iter().map(Form::sin_cos).collect();
            if let [first, last] = ends {
                let half = Form::known(0.5, 0.0);
                let [width, middle] = [last.sub(first), last.add(first)].map(|form| form.mul(&half));
                if width.range()[1] > LONGEST {
                    return f64::INFINITY;
                }
                let radius = width.sin_cos()[1].reciprocal();
                own.push(middle.sin_cos().map(|part| part.mul(&radius)));
            }
            vertices.push(own);
        }
        let mut most = f64::NEG_INFINITY;
        let mut at = vec![0; vertices.len()];
        loop {
            let chosen: Vec<[Form<0>; 2]> = vertices.iter().zip(&at).map(|(own, at)| own[*at]).collect();
            let value = tape.at_vertex(registers, &chosen).range()[1];
            // What is not a number is not less.
            most = if value <= most {
                most
            } else if value.is_nan() {
                f64::INFINITY
            } else {
                value
            };
            let Some(name) = (0..at.len()).find(|name| at[*name] + 1 < vertices[*name].len()) else {
                return most;
            };
            at[name] += 1;
            at[..name].fill(0);
        }
    }
}

fn sum(a: Kind, b: Kind) -> Kind {
    match (a, b) {
        (Kind::Affine(a), Kind::Affine(b)) => Kind::Affine(a | b),
        (Kind::Squares, Kind::Squares) => Kind::Squares,
        (Kind::Other, _) | (_, Kind::Other) => Kind::Other,
        _ => Kind::Convex,
    }
}
