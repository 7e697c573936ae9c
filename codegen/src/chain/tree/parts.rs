//! The parts of a tree of frames: what moves its tool and its loops.
//!
//! Forces close the loops of a loaded machine, which rests where its energy `V = ½ Σ ε_iᵀ C_i⁻¹ ε_i
//! − W(q, p, ε)` is smallest under `φ(q, p, ε) = 0`; W is the work of the loads. With multipliers λ
//! of φ, to first order,
//!
//! ```text
//! by p:      W_p + φ_pᵀ λ = 0              λ = −φ_p⁻ᵀ W_p
//! by ε_i:    C_i⁻¹ ε_i = w_i               w_i = W_ε + φ_εᵀ λ
//! by l:      −k δl = λ                     for a leg, whose φ = |d| − l
//! ```
//!
//! Hence w_i is `(J_ε − J_p φ_p⁻¹ φ_ε)ᵀ F` for a load F and J at its point: passive joints carry
//! nothing along their motions. `φ_εᵀ λ` is the wrench of forces on the frames of the loops: λ u
//! and −λ u on the ends of a leg, along its direction u. A leg that is pressed has a positive λ.

use abbe_core::Component;
use abbe_spec::{Closure, Factor, Spec, Symbol};

use super::closure::{self, Ends, Wrenches, wrenches};
use super::factored::Factored;
use super::units::{Units, passive_at_home};
use super::view::{Motion, View};
use crate::chain::kinematics::Kinematics;
use crate::chain::{Implicit, Rows};
use crate::graph::{Frame, Graph, Node, Six, Vector};

/// The frames of a tree, its loops, and what eliminates the passive variables.
pub(crate) struct Parts<'s> {
    /// View of the whole tree from `F_0`.
    pub(super) whole: View<'s>,
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
    pub(crate) fn new(graph: &mut Graph, spec: &'s Spec) -> Self {
        let whole = View::new(graph, spec, None);
        let mut loops = Vec::new();
        for closed in &spec.loops {
            let ends = Ends::new(spec, closed);
            let length = closed.closure.length().map(|length| graph.lower(length));
            let view = View::new(graph, spec, ends.root(spec));
            loops.push(Part { ends, closure: &closed.closure, length, view });
        }
        let units = Units::new(spec, graph);
        let factored = Factored::new(graph, Vec::new(), &units);
        let free = free_frames(spec);
        let mut parts = Self { whole, loops, free, factored, eliminated: vec![Vec::new(); 6] };
        let columns = parts.derivatives(graph, spec);
        parts.factored = Factored::new(graph, columns, &units);
        let passive = (0..spec.passive.len()).map(Symbol::Local);
        let tool: Vec<Six> = passive.map(|symbol| parts.tool_by_symbol(graph, symbol)).collect();
        parts.eliminated = (0..6)
            .map(|row| {
                let row: Vec<Node> = tool.iter().map(|twist| twist[row]).collect();
                parts.factored.solve_row(graph, &row)
            })
            .collect();
        parts
    }

    /// Creates the parts with symbols for the rows of M, and what defines the variables that loops
    /// determine, and then these rows: `M φ_p = J_p`. Passive variables that are `given` determine
    /// the joint variables. Returns the passive variables at home as well.
    pub(crate) fn implicit(
        graph: &mut Graph,
        spec: &'s Spec,
        given: &[usize],
    ) -> (Self, Vec<Implicit>, Vec<f64>) {
        let mut parts = Self::new(graph, spec);
        let count = spec.passive.len();
        if count == 0 {
            return (parts, Vec::new(), Vec::new());
        }
        let (residual, units) = (parts.residual(graph), Units::new(spec, graph));
        let step = parts.factored.solve(graph, &residual);
        let home = passive_at_home(spec, graph, &residual, &step, &units);
        let passive = (0..count).filter(|i| !given.contains(i));
        let mut unknowns: Vec<(Symbol, f64)> = passive.map(|i| (Symbol::Local(i), home[i])).collect();
        if !given.is_empty() {
            unknowns.extend((0..).map(Symbol::Variable).zip(spec.variables.iter().map(|joint| joint.home)));
        }
        let (symbols, values): (Vec<Symbol>, Vec<f64>) = unknowns.into_iter().unzip();
        let columns = symbols.iter().map(|symbol| parts.rates_by_symbol(graph, *symbol)).collect();
        let closed = Implicit { sets: vec![(symbols, residual)], columns, home: Some(values) };

        let columns = parts.derivatives(graph, spec);
        let passive = (0..count).map(Symbol::Local);
        let tool: Vec<Six> = passive.map(|symbol| parts.tool_by_symbol(graph, symbol)).collect();
        let mut sets = Vec::new();
        for (row, eliminated) in parts.eliminated.iter_mut().enumerate() {
            let symbols: Vec<Symbol> = (0..count).map(|i| Symbol::Local(count * (row + 1) + i)).collect();
            *eliminated = symbols.iter().map(|symbol| graph.symbol(*symbol)).collect();
            let residual = columns.iter().zip(&tool).map(|(column, tool)| {
                let product = graph.products(eliminated, column);
                graph.sub(product, tool[row])
            });
            sets.push((symbols, residual.collect()));
        }
        let transposed = (0..count).map(|i| columns.iter().map(|column| column[i]).collect()).collect();
        (parts, vec![closed, Implicit { sets, columns: transposed, home: None }], home)
    }

    /// Returns the equations of all loops, which are zero where these close.
    pub(super) fn residual(&self, graph: &mut Graph) -> Vec<Node> {
        let residual = |Part { ends, closure, length, view }: &Part<'_>| {
            closure::residual(graph, *ends, closure, *length, |frame| *view.pose(frame))
        };
        self.loops.iter().flat_map(residual).collect()
    }

    /// Returns an axis of the tool in `F_0`.
    pub(crate) fn tool_axis(&self, axis: usize) -> Vector {
        self.whole.pose(Some(self.whole.tool())).axes[axis]
    }

    /// Returns numbers that are positive unless a rotation closes upside down.
    pub(super) fn upright(&self, graph: &mut Graph) -> Vec<Node> {
        let upright = |Part { ends, closure, view, .. }: &Part<'_>| {
            closure::upright(graph, *ends, closure, |frame| *view.pose(frame))
        };
        self.loops.iter().flat_map(upright).collect()
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
    fn tool_by_symbol(&self, graph: &mut Graph, symbol: Symbol) -> Six {
        let motions = self.whole.by_symbol(graph, symbol);
        self.tool(graph, &motions)
    }

    fn tool(&self, graph: &mut Graph, motions: &[Motion]) -> Six {
        let [[x, y, z], [a, b, c]] = self.whole.twist(graph, motions, Some(self.whole.tool()));
        [x, y, z, a, b, c]
    }

    /// Returns a twist of the tool with the motion of the passive variables that keeps the loops
    /// closed: `v − M φ̇`.
    fn closed(&self, graph: &mut Graph, twist: Six, rates: &[Node]) -> [Vector; 2] {
        let closed: Six = std::array::from_fn(|row| {
            let part = graph.products(&self.eliminated[row], rates);
            graph.sub(twist[row], part)
        });
        [[closed[0], closed[1], closed[2]], [closed[3], closed[4], closed[5]]]
    }

    /// Returns velocity and rotation of the tool per unit of a symbol.
    pub(super) fn by_symbol(&self, graph: &mut Graph, symbol: Symbol) -> [Vector; 2] {
        let twist = self.tool_by_symbol(graph, symbol);
        let rates = self.rates_by_symbol(graph, symbol);
        self.closed(graph, twist, &rates)
    }

    /// Returns the rates of the passive variables per unit of a symbol: `−φ_p⁻¹ φ_x`.
    fn passive_by_symbol(&self, graph: &mut Graph, symbol: Symbol) -> Vec<Node> {
        let rates = self.rates_by_symbol(graph, symbol);
        let solved = self.factored.solve(graph, &rates);
        solved.into_iter().map(|rate| graph.neg(rate)).collect()
    }

    /// Returns velocity and rotation of the tool per unit of an error.
    pub(super) fn by_error(&self, graph: &mut Graph, frame: usize, component: Component) -> [Vector; 2] {
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
    pub(crate) fn by_errors(&self, graph: &mut Graph, errors: &[Six]) -> [Vector; 2] {
        let none = [graph.zero(); 6];
        let of_frame = |(errors, free): (&Six, &bool)| if *free { none } else { *errors };
        let errors: Vec<Six> = errors.iter().zip(&self.free).map(of_frame).collect();
        let motions = self.whole.by_errors(graph, &errors);
        let twist = self.tool(graph, &motions);
        let rates = self.rates(graph, |graph, view| view.by_errors(graph, &errors));
        self.closed(graph, twist, &rates)
    }

    /// Returns the forces of each loop, given the force or moment of the loads on each passive
    /// variable.
    pub(crate) fn reactions(&self, graph: &mut Graph, loads: &[Node]) -> Vec<Reaction> {
        let opposite: Vec<Node> = loads.iter().map(|load| graph.neg(*load)).collect();
        let mut rest = self.factored.solve_row(graph, &opposite);
        let reaction = |Part { ends, closure, .. }: &Part<'_>| {
            let forces: Vec<Node> = rest.drain(..closure.equations()).collect();
            let pose = |frame| *self.whole.pose(frame);
            let wrenches = wrenches(graph, *ends, closure, &forces, pose);
            Reaction { forces, wrenches }
        };
        self.loops.iter().map(reaction).collect()
    }
}

/// Returns the rates of the passive variables of a spec per unit of a symbol; none without loops.
pub(crate) fn passive_by_symbol(graph: &mut Graph, spec: &Spec, symbol: Symbol) -> Vec<Node> {
    match spec.passive.is_empty() {
        true => Vec::new(),
        false => Parts::new(graph, spec).passive_by_symbol(graph, symbol),
    }
}

/// Returns, for every frame, whether it belongs to a body that six passive joints in a row let move
/// freely. They undo any motion that an error of one of these frames gives the body, so that these
/// errors have no effect: `φ_ε = φ_p x` and `J_ε = J_p x` for the motion x of the joints.
fn free_frames(spec: &Spec) -> Vec<bool> {
    let count = spec.frames.len();
    let mut free = vec![false; count];
    if spec.passive.len() < FREEDOMS {
        return free;
    }
    let mut children = vec![Vec::new(); count];
    for (child, frame) in spec.frames.iter().enumerate() {
        frame.parent.into_iter().for_each(|parent| children[parent].push(child));
    }
    // The axes of a loop's coordinates move with the body, too.
    let is_end = |frame: usize| spec.loops.iter().any(|closed| Ends::new(spec, closed).contains(frame));
    let only_child = |frame: &usize| match children[*frame][..] {
        [child] if !is_end(*frame) && spec.tool_frame != *frame => Some(child),
        _ => None,
    };
    let alone: Vec<bool> = (0..count).map(|frame| moves_alone(spec, frame)).collect();
    for first in 0..count {
        // Motions of one body: each joint moves the next, and nothing else hangs on it.
        let row: Vec<usize> = std::iter::successors(Some(first), only_child).collect();
        let passive = row.iter().filter(|frame| alone[**frame]).count();
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

/// Forces of a loop, in the axes of `F_0`.
pub(crate) struct Reaction {
    /// λ, one per equation.
    pub(crate) forces: Vec<Node>,
    /// Forces and moments on its frames.
    pub(crate) wrenches: Wrenches,
}

impl Kinematics for Parts<'_> {
    fn poses(&self) -> (&[Frame], Frame) {
        let whole = &self.whole;
        (whole.frames(), *whole.pose(Some(whole.tool())))
    }

    fn errors(&mut self, graph: &mut Graph, rows: &Rows) -> (Vec<Six>, Vec<Vec<Node>>) {
        let mut columns = Vec::new();
        for frame in 0..self.whole.frames().len() {
            for component in Component::ALL {
                let [velocity, rotation] = self.by_error(graph, frame, component);
                columns.push(rows.column(graph, velocity, rotation));
            }
        }
        let distinct = columns.chunks_exact(6).map(<[_]>::concat).collect();
        (columns, distinct)
    }

    fn twists(&self, graph: &mut Graph, symbols: &[Symbol]) -> Vec<[Vector; 2]> {
        symbols.iter().map(|symbol| self.by_symbol(graph, *symbol)).collect()
    }

    fn prepare_sums(&mut self, _: &mut Graph, _: &Spec) -> Option<Option<Node>> {
        None
    }

    fn displacement(&self, graph: &mut Graph, rows: &Rows, errors: &[Six]) -> Six {
        let [velocity, rotation] = self.by_errors(graph, errors);
        rows.column(graph, velocity, rotation)
    }

    fn covariance(&self, graph: &mut Graph, columns: &[Six], variances: &[Six]) -> Vec<Six> {
        let mut sums = vec![[graph.zero(); 6]; 6];
        for (column, variance) in columns.iter().zip(variances.as_flattened()) {
            let weighted = column.map(|entry| graph.mul(*variance, entry));
            for i in 0..6 {
                for j in i..6 {
                    sums[i][j] = graph.add_product(sums[i][j], weighted[i], column[j]);
                    sums[j][i] = sums[i][j];
                }
            }
        }
        sums
    }
}
