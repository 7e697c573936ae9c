//! Magnitudes of the tool point's errors, as nodes to be maximized.
//!
//! A norm is the same in the axes of any frame. The norm of a source's effect is taken in the axes
//! of the first frame that the source affects, so that the joints before that frame drop out.

use abbe_core::{Class, Orientation};
use abbe_spec::Spec;
use abbe_spec::expr::Function;

use super::accumulate::Links;
use super::by_source::errors_by_source;
use super::displacement::Displacement;
use super::rows::Rows;
use super::six::vectors;
use super::sources;
use crate::graph::{Graph, Node, Vector};

/// Magnitude of an error of the tool point.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Magnitude {
    /// The magnitude or its square.
    pub node: Node,
    /// `true` if the node is the square of the magnitude.
    pub squared: bool,
    /// Numbers of which the magnitude is a norm, and in which it is therefore convex; empty if none
    /// are known.
    pub parts: Vec<Node>,
}

impl Magnitude {
    /// Returns the length of a vector.
    pub(super) fn length(graph: &mut Graph, vector: Vector) -> Self {
        Self { node: graph.dot(vector, vector), squared: true, parts: vector.to_vec() }
    }
}

/// Magnitudes of the errors of the tool point. The five entries are the norm of the position error,
/// its components along x, y and z of `F_0`, and the norm of rows 4–6.
#[derive(Clone, Debug)]
pub struct Magnitudes {
    /// The graph of the nodes.
    pub graph: Graph,
    /// Signed sum of the enabled repeatable sources.
    pub repeatable: [Magnitude; 5],
    /// Root sum of squares of the enabled random sources at their bounds (3σ for a normal
    /// distribution).
    pub random: [Magnitude; 5],
    /// Sum of the repeatable and random magnitudes.
    pub radius: [Magnitude; 5],
    /// Upper bounds of the errors along x and along y, for each kind: the norm of both, or for
    /// random sources the largest root sum of squares along a direction perpendicular to z. They do
    /// not depend on leading rotations about z.
    pub across_z: [Magnitude; 3],
    /// Parts of all magnitudes.
    pub apart: PerFrameMagnitudes,
}

/// Parts of the errors of the tool point: norms that each depend on few joints.
#[derive(Clone, Debug)]
pub struct PerFrameMagnitudes {
    /// ‖t_k‖ from the origin of each frame to that of the next, and from the last one to the tool
    /// point.
    pub links: Vec<Magnitude>,
    /// ‖d_i‖ and ‖θ_i‖ of the errors of each frame: sum of all repeatable sources.
    pub repeatable: Vec<[Magnitude; 2]>,
    /// ‖d_i‖ and ‖θ_i‖ of each random source at its bound.
    pub random: Vec<Vec<[Magnitude; 2]>>,
}

/// Returns ‖d‖ and ‖θ‖ of the errors of each frame.
fn sizes_apart(graph: &mut Graph, errors: &[[Node; 6]]) -> Vec<[Magnitude; 2]> {
    let sizes = |errors: &[Node; 6]| {
        let (shift, turn) = vectors(*errors);
        [shift, turn].map(|vector| Magnitude::length(graph, vector))
    };
    errors.iter().map(sizes).collect()
}

/// Displacement of the tool point caused by errors of frames.
struct ToolDisplacement {
    /// δ in the axes of the first frame with an error.
    shift: Vector,
    /// δ in `F_0`.
    along: Vector,
    /// x and y of δ behind the leading rotations about z.
    across_z: [Node; 2],
    /// Numbers with the same norm as rows 4–6.
    turn: Vector,
}

impl Magnitudes {
    /// Builds the magnitudes of a checked spec.
    pub fn new(spec: &Spec) -> Self {
        let (mut graph, effects) = sources::effects(spec);
        let g = &mut graph;
        let zero = g.zero();
        let links = Links::new(g, spec);
        let last_axis = links.last_axis(g, spec.orientation);
        let rows = Rows::new(g, spec.orientation, last_axis);

        let errors = sources::generalized_errors(g, spec, &effects);
        let axes = g.identity().axes;
        let shifts: Vec<Vector> = (1..=spec.frames.len()).map(|link| links.shift(g, link, &axes)).collect();
        let mut apart = PerFrameMagnitudes {
            links: shifts.into_iter().map(|shift| Magnitude::length(g, shift)).collect(),
            repeatable: sizes_apart(g, &errors),
            random: Vec::new(),
        };
        let repeatable = ToolDisplacement::by(g, spec, &links, &rows, &errors);
        let mut sums = [zero; 5];
        let mut parts: [Vec<Node>; 5] = Default::default();
        // Σ x², Σ y², Σ x y.
        let mut spread = [zero; 3];
        let mut spread_parts = Vec::new();
        let errors = errors_by_source(zero, spec, &effects);
        for (source, errors) in spec.enabled_sources().zip(&errors) {
            if let Class::Random(distribution) = source.class {
                let bound = g.constant(distribution.bound());
                let at_bound = errors.iter().map(|errors| errors.map(|error| g.mul(bound, error)));
                let at_bound: Vec<[Node; 6]> = at_bound.collect();
                apart.random.push(sizes_apart(g, &at_bound));
                let moved = ToolDisplacement::by(g, spec, &links, &rows, &at_bound);
                let squares = moved.squares(g);
                sums = std::array::from_fn(|i| g.add(sums[i], squares[i]));
                parts.iter_mut().zip(moved.parts()).for_each(|(parts, own)| parts.extend(own));
                let [x, y] = moved.across_z;
                let products = [(x, x), (y, y), (x, y)].map(|(a, b)| g.mul(a, b));
                spread = std::array::from_fn(|i| g.add(spread[i], products[i]));
                spread_parts.extend([x, y]);
            }
        }
        let squared = |node, parts| Magnitude { node, squared: true, parts };
        let across = repeatable.across_z.map(|part| g.mul(part, part));
        let across = [
            squared(g.add(across[0], across[1]), repeatable.across_z.to_vec()),
            squared(largest_eigenvalue(g, spread), spread_parts),
        ];
        let (squares, sizes, own) = (repeatable.squares(g), repeatable.sizes(g), repeatable.parts());
        let repeatable = std::array::from_fn(|i| squared(squares[i], own[i].clone()));
        let random = std::array::from_fn(|i| squared(sums[i], parts[i].clone()));
        let radius = std::array::from_fn(|i| both(g, sizes[i], &repeatable[i], &random[i]));
        let size = g.sqrt(across[0].node);
        let radius_across = both(g, size, &across[0], &across[1]);
        let [first, second] = across;
        Self { graph, repeatable, random, radius, across_z: [first, second, radius_across], apart }
    }
}

/// Returns the sum of the repeatable and the random magnitude.
fn both(graph: &mut Graph, size: Node, repeatable: &Magnitude, random: &Magnitude) -> Magnitude {
    let other = graph.sqrt(random.node);
    let parts = [&repeatable.parts[..], &random.parts].concat();
    Magnitude { node: graph.add(size, other), squared: false, parts }
}

/// Returns the largest eigenvalue `(a + b)/2 + √(((a − b)/2)² + c²)` of the matrix (a c; c b).
fn largest_eigenvalue(graph: &mut Graph, [a, b, c]: [Node; 3]) -> Node {
    let half = graph.constant(0.5);
    let [sum, difference] = [graph.add(a, b), graph.sub(a, b)].map(|node| graph.mul(half, node));
    let squares = [difference, c].map(|node| graph.mul(node, node));
    let radicand = graph.add(squares[0], squares[1]);
    let root = graph.sqrt(radicand);
    graph.add(sum, root)
}

impl ToolDisplacement {
    fn by(graph: &mut Graph, spec: &Spec, links: &Links, rows: &Rows, errors: &[[Node; 6]]) -> Self {
        let zero = graph.zero();
        let first = errors.iter().position(|errors| *errors != [zero; 6]).unwrap_or(errors.len());
        let none = Displacement::none(graph);
        let Displacement { shift, mut turn } = links.accumulate_to(graph, errors, first, none);
        let none = Displacement::none(graph);
        let [x, y, z, four, five, six] = links.accumulate(graph, errors, none).column(graph, rows);
        let none = Displacement::none(graph);
        let [across_x, across_y, _] = links.accumulate_behind_turns(graph, errors, none).shift;
        if spec.orientation != Orientation::RotationVector {
            turn = [four, five, six];
        }
        Self { shift, along: [x, y, z], across_z: [across_x, across_y], turn }
    }

    /// Returns the numbers of which each of the five magnitudes is a norm.
    fn parts(&self) -> [Vec<Node>; 5] {
        let [x, y, z] = self.along.map(|part| vec![part]);
        [self.shift.to_vec(), x, y, z, self.turn.to_vec()]
    }

    fn squares(&self, graph: &mut Graph) -> [Node; 5] {
        let [x, y, z] = self.along.map(|part| graph.mul(part, part));
        let [shift, turn] = [self.shift, self.turn].map(|vector| graph.dot(vector, vector));
        [shift, x, y, z, turn]
    }

    fn sizes(&self, graph: &mut Graph) -> [Node; 5] {
        let [x, y, z] = self.along.map(|part| graph.call(Function::Abs, part));
        let [shift, turn] = [self.shift, self.turn].map(|vector| {
            let square = graph.dot(vector, vector);
            graph.sqrt(square)
        });
        [shift, x, y, z, turn]
    }
}
