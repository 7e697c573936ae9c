//! How large the errors of the tool point are, as nodes whose largest values are sought.
//!
//! A norm is the same in the axes of any frame. So that of what a source does is taken in the axes of the first frame that it
//! moves: the joints before that drop out of it.

use super::accumulate::Links;
use super::by_source::errors_by_source;
use super::displacement::Displacement;
use super::rows::Rows;
use super::six::vectors;
use super::sources;
use crate::expr::Function;
use crate::graph::{Graph, Node, Vector};
use crate::spec::{Class, Orientation, Spec};

/// The size of an error of the tool point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Magnitude {
    /// It, or its square.
    pub node: Node,
    /// Whether the node is its square.
    pub squared: bool,
}

/// How large the errors of the tool point are. Of each: the norm of the position's, those along x, y and z of `F_0`, and the
/// norm of rows 4–6.
#[derive(Clone, Debug)]
pub struct Magnitudes {
    /// The graph they are nodes of.
    pub graph: Graph,
    /// Of `Σ` of the enabled repeatable sources, with signs.
    pub repeatable: [Magnitude; 5],
    /// Root sum of squares of the enabled random sources at their bounds: of a normal one 3σ.
    pub random: [Magnitude; 5],
    /// Both, added.
    pub radius: [Magnitude; 5],
    /// Of each kind what the errors along x and along y do not exceed: the norm of both, or of random sources the largest root
    /// sum of squares along a direction across z. Turns about z that the chain begins with change nothing of it.
    pub across_z: [Magnitude; 3],
    /// The parts of all of them.
    pub apart: Apart,
}

/// The parts of the errors of the tool point, each by itself: squares of norms, which depend on few joints.
#[derive(Clone, Debug)]
pub struct Apart {
    /// ‖t_k‖², from the origin of each frame to that of the next, and from the last one to the tool point.
    pub links: Vec<Node>,
    /// ‖d_i‖² and ‖θ_i‖² of the errors of each frame: of all repeatable sources.
    pub repeatable: Vec<[Node; 2]>,
    /// Of each random source at its bound.
    pub random: Vec<Vec<[Node; 2]>>,
}

/// ‖d‖² and ‖θ‖² of the errors of each frame.
fn squares_apart(graph: &mut Graph, errors: &[[Node; 6]]) -> Vec<[Node; 2]> {
    let squares = |errors: &[Node; 6]| {
        let (shift, turn) = vectors(*errors);
        [shift, turn].map(|vector| graph.dot(vector, vector))
    };
    errors.iter().map(squares).collect()
}

/// What some errors of frames do to the tool point.
struct Moved {
    /// ‖δ‖².
    shift: Node,
    /// δ in `F_0`.
    along: Vector,
    /// x and y of δ behind the turns about z that the chain begins with.
    across_z: [Node; 2],
    /// The square of the norm of rows 4–6.
    turn: Node,
}

impl Magnitudes {
    /// Those of a checked spec.
    pub fn new(spec: &Spec) -> Self {
        let (mut graph, effects) = sources::effects(spec);
        let g = &mut graph;
        let zero = g.zero();
        let links = Links::new(g, spec);
        let first_axis = links.first_axis(g);
        let rows = Rows::new(g, spec.orientation, first_axis);

        let errors = sources::generalized_errors(g, spec, &effects);
        let axes = g.identity().axes;
        let shifts: Vec<Vector> = (1..=spec.frames.len()).map(|link| links.shift(g, link, &axes)).collect();
        let mut apart = Apart {
            links: shifts.into_iter().map(|shift| g.dot(shift, shift)).collect(),
            repeatable: squares_apart(g, &errors),
            random: Vec::new(),
        };
        let repeatable = Moved::by(g, spec, &links, &rows, &errors);
        let mut sums = [zero; 5];
        // Σ x², Σ y², Σ x y.
        let mut spread = [zero; 3];
        let errors = errors_by_source(zero, spec, &effects);
        for (source, errors) in spec.enabled_sources().zip(&errors) {
            if let Class::Random(distribution) = source.class {
                let bound = g.constant(distribution.bound());
                let at_bound = errors.iter().map(|errors| errors.map(|error| g.mul(bound, error)));
                let at_bound: Vec<[Node; 6]> = at_bound.collect();
                apart.random.push(squares_apart(g, &at_bound));
                let moved = Moved::by(g, spec, &links, &rows, &at_bound);
                let squares = moved.squares(g);
                sums = std::array::from_fn(|i| g.add(sums[i], squares[i]));
                let [x, y] = moved.across_z;
                let products = [(x, x), (y, y), (x, y)].map(|(a, b)| g.mul(a, b));
                spread = std::array::from_fn(|i| g.add(spread[i], products[i]));
            }
        }
        let sizes = repeatable.sizes(g);
        let radius = std::array::from_fn(|i| {
            let random = g.sqrt(sums[i]);
            Magnitude { node: g.add(sizes[i], random), squared: false }
        });
        let across = repeatable.across_z.map(|part| g.mul(part, part));
        let across = [g.add(across[0], across[1]), largest_eigenvalue(g, spread)];
        let both = across.map(|square| g.sqrt(square));
        let both = Magnitude { node: g.add(both[0], both[1]), squared: false };
        let squared = |node| Magnitude { node, squared: true };
        let repeatable = repeatable.squares(g).map(squared);
        let across_z = [squared(across[0]), squared(across[1]), both];
        Self { graph, repeatable, random: sums.map(squared), radius, across_z, apart }
    }
}

/// `(a + b)/2 + √(((a − b)/2)² + c²)` of the matrix (a c; c b).
fn largest_eigenvalue(graph: &mut Graph, [a, b, c]: [Node; 3]) -> Node {
    let half = graph.constant(0.5);
    let [sum, difference] = [graph.add(a, b), graph.sub(a, b)].map(|node| graph.mul(half, node));
    let squares = [difference, c].map(|node| graph.mul(node, node));
    let radicand = graph.add(squares[0], squares[1]);
    let root = graph.sqrt(radicand);
    graph.add(sum, root)
}

impl Moved {
    fn by(graph: &mut Graph, spec: &Spec, links: &Links, rows: &Rows, errors: &[[Node; 6]]) -> Self {
        let zero = graph.zero();
        let first = errors.iter().position(|errors| *errors != [zero; 6]).unwrap_or(errors.len());
        let none = Displacement::none(graph);
        let own = links.accumulate_to(graph, errors, first, none);
        let [shift, mut turn] = own.squares(graph);
        let none = Displacement::none(graph);
        let [x, y, z, four, five, six] = links.accumulate(graph, errors, none).column(graph, rows);
        let none = Displacement::none(graph);
        let [across_x, across_y, _] = links.accumulate_behind_turns(graph, errors, none).shift;
        if spec.orientation == Orientation::EulerYzx {
            turn = graph.dot([four, five, six], [four, five, six]);
        }
        Self { shift, along: [x, y, z], across_z: [across_x, across_y], turn }
    }

    fn squares(&self, graph: &mut Graph) -> [Node; 5] {
        let [x, y, z] = self.along.map(|part| graph.mul(part, part));
        [self.shift, x, y, z, self.turn]
    }

    fn sizes(&self, graph: &mut Graph) -> [Node; 5] {
        let [x, y, z] = self.along.map(|part| graph.call(Function::Abs, part));
        [graph.sqrt(self.shift), x, y, z, graph.sqrt(self.turn)]
    }
}
