//! The model of a tree of frames.

use abbe_core::Component;
use abbe_spec::expr::Symbol;
use abbe_spec::{Closure, Factor, Spec};

use super::closure::{self, Ends};
use super::factored::{Factored, dot};
use super::loops::Loops;
use super::view::{Motion, View};
use crate::chain::by_source;
use crate::chain::elastic::Loads;
use crate::chain::model::{name, name_lengths};
use crate::chain::rows::Rows;
use crate::chain::{Jacobian, Model, sources, transform};
use crate::graph::{Graph, Node, Vector};

/// The frames of a tree, its loops, and what eliminates the passive variables.
pub(super) struct Parts<'s> {
    /// View of the whole tree from `F_0`.
    whole: View<'s>,
    loops: Vec<Part<'s>>,
    /// Frames whose errors have no effect.
    free: Vec<bool>,
    pub(super) factored: Factored,
    /// Rows of `M = J_p φ_p⁻¹`: velocity and rotation of the tool.
    eliminated: Vec<Vec<Node>>,
}

/// A loop, seen from the last frame that carries all of it.
struct Part<'s> {
    ends: Ends,
    closure: &'s Closure,
    length: Option<Node>,
    view: View<'s>,
}

impl<'s> Parts<'s> {
    pub(super) fn new(graph: &mut Graph, spec: &'s Spec) -> Self {
        let whole = View::new(graph, spec, None);
        let mut loops = Vec::new();
        for closed in &spec.loops {
            let ends = Ends::new(spec, closed);
            let length = match &closed.closure {
                Closure::Distance(length) => Some(graph.lower(length)),
                Closure::Coordinates(_) => None,
            };
            let view = View::new(graph, spec, ends.root(spec));
            loops.push(Part { ends, closure: &closed.closure, length, view });
        }
        let factored = Factored::new(graph, Vec::new());
        let free = free_frames(spec);
        let mut parts = Self { whole, loops, free, factored, eliminated: vec![Vec::new(); 6] };
        let columns = parts.derivatives(graph, spec);
        parts.factored = Factored::new(graph, columns);
        let passive = (0..spec.passive.len()).map(Symbol::Local);
        let tool: Vec<[Node; 6]> = passive.map(|symbol| parts.tool_by_symbol(graph, symbol)).collect();
        parts.eliminated = (0..6)
            .map(|row| {
                let row: Vec<Node> = tool.iter().map(|twist| twist[row]).collect();
                parts.factored.solve_row(graph, &row)
            })
            .collect();
        parts
    }

    /// Returns the equations of all loops, which are zero where these close.
    pub(super) fn residual(&self, graph: &mut Graph) -> Vec<Node> {
        let mut residual = Vec::new();
        for Part { ends, closure, length, view } in &self.loops {
            residual.extend(closure::residual(graph, *ends, closure, *length, |frame| *view.pose(frame)));
        }
        residual
    }

    /// Returns the columns of `φ_p`, one per passive variable.
    pub(super) fn derivatives(&self, graph: &mut Graph, spec: &Spec) -> Vec<Vec<Node>> {
        (0..spec.passive.len()).map(|i| self.rates_by_symbol(graph, Symbol::Local(i))).collect()
    }

    /// Returns the rates of all equations per unit of a symbol.
    fn rates_by_symbol(&self, graph: &mut Graph, symbol: Symbol) -> Vec<Node> {
        let mut rates = Vec::new();
        for Part { ends, closure, length, view } in &self.loops {
            let motions = view.by_symbol(graph, symbol);
            let length = length.map_or(graph.zero(), |length| graph.diff(length, symbol));
            rates.extend(closure::rate(graph, view, *ends, closure, &motions, length));
        }
        rates
    }

    /// Returns the rates of all equations under motions that each view has of its own.
    fn rates(&self, graph: &mut Graph, motions: impl Fn(&mut Graph, &View<'_>) -> Vec<Motion>) -> Vec<Node> {
        let mut rates = Vec::new();
        for Part { ends, closure, view, .. } in &self.loops {
            let (motions, zero) = (motions(graph, view), graph.zero());
            rates.extend(closure::rate(graph, view, *ends, closure, &motions, zero));
        }
        rates
    }

    /// Returns velocity and rotation of the tool per unit of a symbol, without the loops.
    fn tool_by_symbol(&self, graph: &mut Graph, symbol: Symbol) -> [Node; 6] {
        let motions = self.whole.by_symbol(graph, symbol);
        self.tool(graph, &motions)
    }

    fn tool(&self, graph: &mut Graph, motions: &[Motion]) -> [Node; 6] {
        let [[x, y, z], [a, b, c]] = self.whole.twist(graph, motions, Some(self.whole.tool()));
        [x, y, z, a, b, c]
    }

    /// Returns a twist of the tool with the motion of the passive variables that keeps the loops
    /// closed: `v − M φ̇`.
    fn closed(&self, graph: &mut Graph, twist: [Node; 6], rates: &[Node]) -> [Vector; 2] {
        let closed: [Node; 6] = std::array::from_fn(|row| {
            let part = dot(graph, &self.eliminated[row], rates);
            graph.sub(twist[row], part)
        });
        [[closed[0], closed[1], closed[2]], [closed[3], closed[4], closed[5]]]
    }

    /// Returns velocity and rotation of the tool per unit of a symbol.
    fn by_symbol(&self, graph: &mut Graph, symbol: Symbol) -> [Vector; 2] {
        let twist = self.tool_by_symbol(graph, symbol);
        let rates = self.rates_by_symbol(graph, symbol);
        self.closed(graph, twist, &rates)
    }

    /// Returns velocity and rotation of the tool per unit of an error.
    fn by_error(&self, graph: &mut Graph, frame: usize, component: Component) -> [Vector; 2] {
        if self.free[frame] {
            return [[graph.zero(); 3]; 2];
        }
        let motion = self.whole.by_error(graph, frame, component);
        let twist = self.tool(graph, &[motion]);
        let rates = self.rates(graph, |graph, view| match view.is_below(frame) {
            true => vec![view.by_error(graph, frame, component)],
            false => Vec::new(),
        });
        self.closed(graph, twist, &rates)
    }

    /// Returns the displacement of the tool due to errors of all frames.
    fn by_errors(&self, graph: &mut Graph, errors: &[[Node; 6]]) -> [Vector; 2] {
        let none = [graph.zero(); 6];
        let of_frame = |(errors, free): (&[Node; 6], &bool)| if *free { none } else { *errors };
        let errors: Vec<[Node; 6]> = errors.iter().zip(&self.free).map(of_frame).collect();
        let motions = self.whole.by_errors(graph, &errors);
        let twist = self.tool(graph, &motions);
        let rates = self.rates(graph, |graph, view| view.by_errors(graph, &errors));
        self.closed(graph, twist, &rates)
    }
}

/// Returns, for every frame, whether it belongs to a body that six passive joints in a row let move
/// freely. They undo any motion that an error of one of these frames gives the body, so that these
/// errors have no effect: `φ_ε = φ_p x` and `J_ε = J_p x` for the motion x of the joints.
fn free_frames(spec: &Spec) -> Vec<bool> {
    let count = spec.frames.len();
    let only_child = |frame: usize| {
        let mut children = (0..count).filter(|child| spec.frames[*child].parent == Some(frame));
        let child = children.next().filter(|_| children.next().is_none())?;
        let is_end = spec.loops.iter().any(|closed| closed.frames.contains(&Some(frame)));
        (!is_end && spec.tool_frame != frame).then_some(child)
    };
    let mut free = vec![false; count];
    for first in 0..count {
        // Motions of one body: each joint moves the next, and nothing else hangs on it.
        let row: Vec<usize> = std::iter::successors(Some(first), |frame| only_child(*frame)).collect();
        let passive = row.iter().filter(|frame| moves_alone(spec, **frame)).count();
        if passive == FREEDOMS {
            row.iter().for_each(|frame| free[*frame] = true);
        }
    }
    free
}

/// Returns `true` if a frame has a passive variable on which nothing else depends.
fn moves_alone(spec: &Spec, frame: usize) -> bool {
    let Some(passive) = spec.frames[frame].passive else { return false };
    let others = spec.frames.iter().enumerate().filter(|(other, _)| *other != frame);
    let factors = others.flat_map(|(_, other)| &other.factors).chain(&spec.tool);
    let mut expressions = factors.flat_map(Factor::expressions).chain(spec.lengths());
    !expressions.any(|expression| expression.symbols().any(|symbol| symbol == Symbol::Passive(passive)))
}

/// Freedoms of a body in space.
const FREEDOMS: usize = 6;

/// Builds all nodes of a tree of frames. This cannot fail for a checked spec.
pub(crate) fn model(spec: &Spec) -> Model {
    let mut graph = Graph::with_tables(&spec.tables);
    let g = &mut graph;
    let parts = Parts::new(g, spec);
    let frames = parts.whole.frames().to_vec();
    let tool = *parts.whole.pose(Some(parts.whole.tool()));
    for (i, frame) in frames.iter().enumerate() {
        name(g, frame, &(i + 1).to_string());
        name_lengths(g, &spec.frames[i].factors, &(i + 1).to_string());
    }
    name(g, &tool, "t");
    name_lengths(g, &spec.tool, "t");

    let rows = Rows::new(g, spec.orientation, tool.axes[spec.orientation.last_axis().unwrap_or(0)]);
    let margin = rows.margin();
    let mut columns = Vec::new();
    for frame in 0..frames.len() {
        for component in Component::ALL {
            let [velocity, rotation] = parts.by_error(g, frame, component);
            columns.push(rows.column(g, velocity, rotation));
        }
    }
    let distinct = columns.chunks_exact(6).map(<[_]>::concat).collect();
    let error_jacobian = Jacobian { columns, margin };
    let jacobian = |g: &mut Graph, symbols: Vec<Symbol>| {
        let twists: Vec<[Vector; 2]> = symbols.into_iter().map(|symbol| parts.by_symbol(g, symbol)).collect();
        let columns = twists.iter().map(|[velocity, turn]| rows.column(g, *velocity, *turn)).collect();
        (twists, Jacobian { columns, margin })
    };
    let (twists, joint_jacobian) = jacobian(g, (0..spec.variables.len()).map(Symbol::Variable).collect());
    let (_, parameter_jacobian) = jacobian(g, (0..spec.parameters.len()).map(Symbol::Parameter).collect());
    let joint_twists = twists.into_iter().map(|[[x, y, z], [a, b, c]]| [x, y, z, a, b, c]).collect();

    let factors = spec.frames.iter().map(|frame| &frame.factors).chain([&spec.tool]);
    let transforms = factors.map(|factors| transform(g, factors)).collect();
    let axes = g.identity().axes;
    let loads = Loads::new(g, spec, &frames, &axes);
    let (effects, causes) = sources::effects_in(g, spec, |_| &loads);
    let generalized_errors = sources::generalized_errors(g, spec, &effects);

    let symbols: Vec<[Node; 6]> =
        (0..frames.len()).map(|i| std::array::from_fn(|k| g.symbol(Symbol::Error(6 * i + k)))).collect();
    let displaced = |g: &mut Graph, errors: &[[Node; 6]]| {
        let [velocity, rotation] = parts.by_errors(g, errors);
        rows.column(g, velocity, rotation)
    };
    let displacement = Jacobian { columns: vec![displaced(g, &symbols)], margin };
    let covariance =
        Jacobian { columns: covariance(g, &error_jacobian.columns, symbols.as_flattened()), margin };
    let two_forms = |g: &mut Graph, errors: &[Vec<[Node; 6]>]| {
        let summed = errors.iter().map(|errors| displaced(g, errors)).collect();
        let product = |errors: &Vec<_>| by_source::product(g, &error_jacobian.columns, errors);
        let products = errors.iter().map(product).collect();
        [summed, products].map(|columns| Jacobian { columns, margin })
    };
    let predicted_displacement = two_forms(g, std::slice::from_ref(&generalized_errors));
    let zero = g.zero();
    let source_displacements = two_forms(g, &by_source::errors_by_source(zero, spec, &effects));
    let loops = Loops::new(g, spec, &parts, &causes, &symbols);
    let (real_pose, drawn_pose) = (loops.real.pose, loops.drawn.pose);
    Model {
        transforms,
        frames,
        tool,
        error_jacobian,
        distinct,
        joint_jacobian,
        parameter_jacobian,
        effects,
        generalized_errors,
        displacement,
        covariance,
        predicted_displacement,
        source_displacements,
        real_pose,
        drawn_pose,
        real_errors: None,
        drawn_errors: Vec::new(),
        joint_twists,
        joint_local_twists: Vec::new(),
        parameter_local_twists: Vec::new(),
        loops: Some(loops),
        graph,
    }
}

/// Returns the columns of `J_e diag(σ²) J_eᵀ`.
fn covariance(graph: &mut Graph, columns: &[[Node; 6]], variances: &[Node]) -> Vec<[Node; 6]> {
    let mut sums = vec![[graph.zero(); 6]; 6];
    for (column, variance) in columns.iter().zip(variances) {
        let weighted = column.map(|entry| graph.mul(*variance, entry));
        for i in 0..6 {
            for j in i..6 {
                let part = graph.mul(weighted[i], column[j]);
                sums[i][j] = graph.add(sums[i][j], part);
                sums[j][i] = sums[i][j];
            }
        }
    }
    sums
}
