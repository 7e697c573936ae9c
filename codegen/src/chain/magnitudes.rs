//! How large the errors of the tool point are, as nodes whose largest values are sought.
//!
//! A norm is the same in the axes of any frame. So that of what a source does is taken in the axes of the first frame that it
//! moves: the joints before that drop out of it.

use super::accumulate::Links;
use super::by_source::errors_by_source;
use super::displacement::Displacement;
use super::rows::Rows;
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
}

/// What some errors of frames do to the tool point.
struct Moved {
    /// ‖δ‖².
    shift: Node,
    /// δ in `F_0`.
    along: Vector,
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
        let repeatable = Moved::by(g, spec, &links, &rows, &errors);
        let mut sums = [zero; 5];
        let errors = errors_by_source(zero, spec, &effects);
        for (source, errors) in spec.enabled_sources().zip(&errors) {
            if let Class::Random(distribution) = source.class {
                let bound = g.constant(distribution.bound());
                let at_bound = errors.iter().map(|errors| errors.map(|error| g.mul(bound, error)));
                let at_bound: Vec<[Node; 6]> = at_bound.collect();
                let squares = Moved::by(g, spec, &links, &rows, &at_bound).squares(g);
                sums = std::array::from_fn(|i| g.add(sums[i], squares[i]));
            }
        }
        let sizes = repeatable.sizes(g);
        let radius = std::array::from_fn(|i| {
            let random = g.sqrt(sums[i]);
            Magnitude { node: g.add(sizes[i], random), squared: false }
        });
        let squared = |node| Magnitude { node, squared: true };
        let repeatable = repeatable.squares(g).map(squared);
        Self { graph, repeatable, random: sums.map(squared), radius }
    }
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
        if spec.orientation == Orientation::EulerYzx {
            turn = graph.dot([four, five, six], [four, five, six]);
        }
        Self { shift, along: [x, y, z], turn }
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
