//! Upper bound of a convex norm within a box, taken at corners.
//!
//! An arc lies within the polygon of its two ends and the intersections of neighbouring tangents,
//! which touch it at its ends and its middle. Each intersection is `1/cos h` from the centre of the
//! circle, where h is half of the arc between the tangents. A function that is convex in the sine
//! and cosine of each angle has its maximum over the product of all polygons, and of the ranges of
//! linear names, at a corner.
//!
//! The vertices of two names are evaluated in lanes. The other names step through their vertices
//! one after the other, and operations that do not depend on the changed names are not repeated.

use abbe_core::lanes::{InstructionSet, Kernel, Register};

use crate::affine::{Affine, above};
use crate::convex::{At, Convex, Names, Operation};
use crate::vertex::{LANES, Lanes, Number, Size, result};

/// Number of pieces of an arc between its tangents. More pieces need fewer boxes but more time for
/// each.
const PIECES: usize = 2;
/// Maximum number of vertices of a name.
const VERTICES: usize = 2 + PIECES;
/// Number of names whose vertices are in lanes.
const IN_LANES: usize = 2;
const _: () = assert!(VERTICES * VERTICES == LANES);
/// Maximum of half a piece, rad: the tangents of longer pieces meet too far away.
const LONGEST: f64 = 1.2;
/// Maximum number of moving names: k angles have `VERTICES`^k corners.
const MOST_NAMES: usize = 8;

/// A convex norm and the order in which its names step.
#[derive(Clone, Debug)]
pub(crate) struct Corners {
    norm: Convex,
    /// Order of the names, those in lanes first.
    order: Vec<usize>,
    /// Operations to repeat when a name outside the lanes steps and all names before it restart.
    again: Vec<Vec<At>>,
    set: InstructionSet,
}

/// The corner with the largest norm.
#[derive(Clone, Debug)]
pub(crate) struct Corner {
    /// Upper bound of the norm in the box.
    pub(crate) most: f64,
    /// Vertex of each name: its lower end, its upper end, or an intersection of tangents.
    at: Vec<usize>,
}

/// Reusable buffers.
#[derive(Debug, Default)]
pub(crate) struct Buffers {
    lanes: Vec<Lanes>,
    sizes: Vec<Size>,
}

/// Sine and cosine of an angle, or the value of a linear name and an unused number.
type Vertex = [Affine<0>; 2];

impl Corners {
    /// Creates the evaluation of a norm. Returns `None` for no names or more than `MOST_NAMES`.
    pub(crate) fn new(norm: Convex) -> Option<Self> {
        let names = norm.angles.len();
        if names == 0 || names > MOST_NAMES {
            return None;
        }
        let depends = depends(&norm.operations);
        let order = order(&depends, names);
        let again = (IN_LANES..names).map(|last| {
            let moved: Names = order[IN_LANES..=last].iter().map(|name| 1 << name).sum();
            (0..depends.len()).filter(|at| depends[*at] & moved != 0).collect()
        });
        let again = again.collect();
        Some(Self { norm, order, again, set: InstructionSet::best() })
    }

    /// Returns `true` if the arc of a name is too long for a useful bound.
    pub(crate) fn is_too_long(&self, name: usize, [low, high]: [f64; 2]) -> bool {
        self.norm.angles[name] && half_piece([low, high]).range()[1] > LONGEST
    }

    /// Returns the corner with the largest norm in a box whose arcs are short enough. Returns
    /// `None` if the rounding error is unbounded.
    pub(crate) fn largest(&self, numbers: &mut Buffers, low: &[f64], high: &[f64]) -> Option<Corner> {
        let ends = low.iter().zip(high).map(|(low, high)| [*low, *high]).zip(&self.norm.angles);
        let vertices =
            ends.map(|(ends, is_angle)| if *is_angle { arc_vertices(ends) } else { range_vertices(ends) });
        let vertices: Vec<Vec<Vertex>> = vertices.collect();
        let off = self.off(&mut numbers.sizes, &vertices);
        let rounded = Rounded { corners: self, lanes: &mut numbers.lanes, vertices: &vertices };
        let (largest, at) = self.set.run(rounded);
        off.is_finite().then(|| Corner { most: above(largest + off), at })
    }

    /// Returns a bound of the rounding error of the norm at any corner.
    fn off(&self, sizes: &mut Vec<Size>, vertices: &[Vec<Vertex>]) -> f64 {
        let of_all = |vertices: &Vec<Vertex>, part: usize| {
            let sizes = vertices.iter().map(|vertex| Size::known(&vertex[part]));
            sizes.fold(Size { most: 0.0, off: 0.0 }, Size::hull)
        };
        let names: Vec<[Size; 2]> = vertices.iter().map(|own| [0, 1].map(|part| of_all(own, part))).collect();
        sizes.clear();
        for operation in &self.norm.operations {
            let size = result(operation, sizes, &names);
            sizes.push(size);
        }
        sizes.last().map_or(f64::INFINITY, |norm| norm.off)
    }
}

/// Computes the largest rounded norm at a corner, and the vertex of each name there.
struct Rounded<'a> {
    corners: &'a Corners,
    lanes: &'a mut Vec<Lanes>,
    vertices: &'a [Vec<Vertex>],
}

impl Kernel for Rounded<'_> {
    type Output = (f64, Vec<usize>);

    #[inline(always)]
    fn run<R: Register>(self) -> Self::Output {
        let Self { corners: Corners { norm, order, again, .. }, lanes, vertices } = self;
        let mut at = vec![0; vertices.len()];
        let mut names: Vec<[Lanes; 2]> = vertices.iter().map(|own| all_lanes(&own[0])).collect();
        let (in_lanes, outside) = order.split_at(order.len().min(IN_LANES));
        let vertex_in_lane = |place: usize, lane: usize| {
            let vertex = [lane % VERTICES, lane / VERTICES][place];
            vertex.min(vertices[in_lanes[place]].len() - 1)
        };
        for (place, name) in in_lanes.iter().enumerate() {
            let own = |lane: usize| &vertices[*name][vertex_in_lane(place, lane)];
            names[*name] = [0, 1].map(|part| std::array::from_fn(|lane| own(lane)[part].centre));
        }
        lanes.clear();
        for operation in &norm.operations {
            let value = result(operation, lanes, &names);
            lanes.push(value);
        }
        let (mut largest, mut largest_at) = (f64::NEG_INFINITY, vec![0; vertices.len()]);
        loop {
            for (lane, value) in lanes[lanes.len() - 1].into_iter().enumerate() {
                if value > largest {
                    largest = value;
                    largest_at.clone_from(&at);
                    for (place, name) in in_lanes.iter().enumerate() {
                        largest_at[*name] = vertex_in_lane(place, lane);
                    }
                }
            }
            let Some(next) = outside.iter().position(|name| at[*name] + 1 < vertices[*name].len()) else {
                return (largest, largest_at);
            };
            for (place, name) in outside[..=next].iter().enumerate() {
                at[*name] = if place == next { at[*name] + 1 } else { 0 };
                names[*name] = all_lanes(&vertices[*name][at[*name]]);
            }
            for operation in &again[next] {
                lanes[*operation] = result(&norm.operations[*operation], lanes, &names);
            }
        }
    }
}

impl Corner {
    /// Returns `true` if a name is at an intersection of tangents, which lies outside of its arc.
    pub(crate) fn is_outside(&self, name: usize) -> bool {
        self.at[name] >= 2
    }

    /// Returns the nearest point of the box.
    pub(crate) fn nearest(&self, low: &[f64], high: &[f64]) -> Vec<f64> {
        let ends = low.iter().zip(high).zip(&self.at);
        let near = ends.map(|((low, high), at)| match at {
            0 => *low,
            1 => *high,
            at => low + (high - low) * ((2 * at - 3) as f64 / (2 * PIECES) as f64),
        });
        near.collect()
    }
}

#[inline(always)]
fn all_lanes(vertex: &Vertex) -> [Lanes; 2] {
    vertex.map(|part| [part.centre; LANES])
}

fn range_vertices([low, high]: [f64; 2]) -> Vec<Vertex> {
    let ends = if low == high { vec![low] } else { vec![low, high] };
    ends.into_iter().map(|end| [Affine::known(end, 0.0), Affine::known(0.0, 0.0)]).collect()
}

fn arc_vertices([low, high]: [f64; 2]) -> Vec<Vertex> {
    let [first, last] = [low, high].map(|end| Affine::known(end, 0.0));
    if low == high {
        return vec![first.sin_cos()];
    }
    let half = half_piece([low, high]);
    let distance = half.sin_cos()[1].reciprocal();
    let meetings = (0..PIECES).map(|piece| {
        let halves = Affine::known((2 * piece + 1) as f64, 0.0);
        first.add(&half.mul(&halves)).sin_cos().map(|part| part.mul(&distance))
    });
    [first.sin_cos(), last.sin_cos()].into_iter().chain(meetings).collect()
}

/// Returns half of a piece of an arc.
fn half_piece([low, high]: [f64; 2]) -> Affine<0> {
    let width = Affine::known(high, 0.0).sub(&Affine::known(low, 0.0));
    width.mul(&Affine::known((2 * PIECES) as f64, 0.0).reciprocal())
}

/// Returns the names that each operation depends on.
fn depends(operations: &[Operation]) -> Vec<Names> {
    let mut depends: Vec<Names> = Vec::with_capacity(operations.len());
    for operation in operations {
        let own = match operation {
            Operation::Name(name, _) => 1 << name,
            _ => operation.operands().fold(0, |names, operand| names | depends[operand]),
        };
        depends.push(own);
    }
    depends
}

/// Orders the names so that the fewest operations depend on the first one, then the fewest
/// remaining ones on the next.
fn order(depends: &[Names], names: usize) -> Vec<usize> {
    let mut order: Vec<usize> = Vec::with_capacity(names);
    let mut chosen: Names = 0;
    while order.len() < names {
        let left = (0..names).filter(|name| chosen & (1 << name) == 0);
        let rest = |name: &usize| {
            depends.iter().filter(|own| **own & chosen == 0 && **own & (1 << name) != 0).count()
        };
        let Some(next) = left.min_by_key(rest) else { break };
        chosen |= 1 << next;
        order.push(next);
    }
    order
}

#[cfg(test)]
mod tests {
    use abbe_codegen::graph::{Graph, Node};
    use abbe_spec::expr::{Function, Symbol};
    use rand::{RngExt, SeedableRng};
    use rand_xoshiro::Xoshiro256PlusPlus;

    use super::*;
    use crate::tape::Tape;

    /// Number of angles; the name after them is linear.
    const ANGLES: usize = 3;
    const NAMES: usize = ANGLES + 1;

    fn name(i: usize) -> Symbol {
        Symbol::Variable(i)
    }

    /// Returns the sine and cosine of a sum of names, with signs, and a constant.
    fn sin_cos(graph: &mut Graph, names: &[(usize, f64)], offset: f64) -> [Node; 2] {
        let mut sum = graph.constant(offset);
        for (i, sign) in names {
            let own = graph.symbol(name(*i));
            sum = if *sign > 0.0 { graph.add(sum, own) } else { graph.sub(sum, own) };
        }
        [Function::Sin, Function::Cos].map(|function| graph.call(function, sum))
    }

    fn norm(graph: &mut Graph, parts: &[Node]) -> Tape {
        let squares: Vec<Node> = parts.iter().map(|part| graph.mul(*part, *part)).collect();
        let sum = squares.into_iter().reduce(|sum, square| graph.add(sum, square)).unwrap();
        let outputs = [&[sum], parts].concat();
        let names: Vec<Symbol> = (0..NAMES).map(name).collect();
        Tape::new(graph, &outputs, &names, |_| f64::NAN)
    }

    /// Returns two numbers that are affine in the sine and cosine of each angle, and in the last
    /// name.
    fn parts(graph: &mut Graph) -> [Node; 2] {
        let [_, first] = sin_cos(graph, &[(0, 1.0)], 0.0);
        let [_, sum] = sin_cos(graph, &[(1, 1.0), (2, -1.0)], 0.4);
        let [sine, cosine] = sin_cos(graph, &[(0, -1.0), (1, 1.0)], -0.7);
        let slide = graph.symbol(name(3));
        let x = graph.mul(first, sum);
        let x = graph.add(x, slide);
        let y = graph.mul(slide, sine);
        [x, graph.sub(y, cosine)]
    }

    #[test]
    fn nothing_is_larger_than_at_the_corners() {
        let mut graph = Graph::new();
        let parts = parts(&mut graph);
        let tape = norm(&mut graph, &parts);
        let corners = Corners::new(Convex::new(&tape, NAMES).unwrap()).unwrap();
        let mut random = Xoshiro256PlusPlus::seed_from_u64(7);
        let mut numbers = Buffers::default();
        for box_ in 0..500 {
            let longest = [4.7, 1.0, 0.02][box_ % 3];
            let low: [f64; NAMES] = std::array::from_fn(|_| random.random_range(-4.0..4.0));
            let high = low.map(|low| {
                low + if random.random_bool(0.2) { 0.0 } else { random.random_range(0.0..longest) }
            });
            assert!((0..NAMES).all(|name| !corners.is_too_long(name, [low[name], high[name]])));
            let corner = corners.largest(&mut numbers, &low, &high).unwrap();
            for _ in 0..200 {
                let at: [f64; NAMES] = std::array::from_fn(|name| match random.random_range(0..4) {
                    0 => low[name],
                    1 => high[name],
                    _ => random.random_range(low[name]..=high[name]),
                });
                let value = tape.evaluate::<0>(&mut Vec::new(), &at, &[0.0; NAMES]).0[0].range()[0];
                assert!(value <= corner.most, "{value} above {corner:?} of {low:?} … {high:?}");
            }
            let near = corner.nearest(&low, &high);
            assert!(near.iter().zip(low.iter().zip(&high)).all(|(at, (low, high))| low <= at && at <= high));
            // A corner within all arcs is attained.
            if (0..NAMES).all(|name| !corner.is_outside(name)) {
                let value = tape.evaluate::<0>(&mut Vec::new(), &near, &[0.0; NAMES]).0[0].range()[1];
                assert!(corner.most <= value * (1.0 + 1e-12) + 1e-12, "{corner:?}, and {value}");
            }
        }
        assert!(corners.is_too_long(0, [0.0, 4.9]) && !corners.is_too_long(3, [0.0, 4.9]));
    }

    #[test]
    fn what_is_not_convex_has_no_corners() {
        let is_convex = |parts: &dyn Fn(&mut Graph) -> Vec<Node>| {
            let mut graph = Graph::new();
            let parts = parts(&mut graph);
            let tape = norm(&mut graph, &parts);
            Convex::new(&tape, NAMES).is_some()
        };
        assert!(is_convex(&|graph| parts(graph).to_vec()));
        // An angle occurs twice in a product, directly or in a sum.
        assert!(!is_convex(&|graph| {
            let [sine, cosine] = sin_cos(graph, &[(0, 1.0)], 0.0);
            vec![graph.mul(sine, cosine)]
        }));
        assert!(!is_convex(&|graph| {
            let ([sine, _], [sum, _]) =
                (sin_cos(graph, &[(0, 1.0)], 0.0), sin_cos(graph, &[(0, 1.0), (1, 1.0)], 0.0));
            vec![graph.mul(sine, sum)]
        }));
        assert!(!is_convex(&|graph| vec![sin_cos(graph, &[(0, 1.0), (0, 1.0)], 0.0)[0]]));
        // An angle also occurs linearly, or an operation is neither a sum nor a product.
        assert!(!is_convex(&|graph| {
            let ([sine, _], own) = (sin_cos(graph, &[(0, 1.0)], 0.0), graph.symbol(name(0)));
            vec![sine, own]
        }));
        assert!(!is_convex(&|graph| {
            let own = graph.symbol(name(0));
            vec![graph.call(Function::Exp, own)]
        }));
        // A norm depends on more than its parts.
        let mut graph = Graph::new();
        let [first, second] = parts(&mut graph);
        let mut tape = norm(&mut graph, &[first, second]);
        tape.outputs.truncate(2);
        assert!(Convex::new(&tape, NAMES).is_none());
    }
}
