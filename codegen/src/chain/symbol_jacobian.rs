//! `∂X_T/∂x` for a joint variable or structural parameter x that may stand anywhere in the chain.
//!
//! The loops of long chains take the twists of single transforms per unit of a symbol.

use std::collections::HashMap;

use abbe_spec::{Factor, Spec, Symbol};
use indexmap::IndexMap;

use super::walk::{Step, walk};
use crate::graph::{Frame, Graph, Six, Vector};

/// Returns the velocity of the tool point and the rotation per unit of a symbol, the sum over all
/// factors that depend on it:
///
/// ```text
/// translation by f along e            (e ; 0) ∂f/∂x
/// rotation by f about a through p     (a × (p_T − p) ; a) ∂f/∂x
/// matrix (R, t) after T = (R₀, p₀)    ω = R₀ vee(∂R/∂x Rᵀ),  (R₀ ∂t/∂x + ω × (p_T − p₀ − R₀ t) ; ω)
/// ```
pub(super) fn twist(graph: &mut Graph, steps: &Steps, symbol: Symbol, tool: Vector) -> [Vector; 2] {
    let mut velocity = [graph.zero(); 3];
    let mut rotation = [graph.zero(); 3];
    for step in steps.by_symbol.get(&symbol).into_iter().flatten().map(|at| &steps.list[*at]) {
        match step {
            Step::Translation { direction, amount } => {
                let slope = graph.diff(*amount, symbol);
                velocity = graph.add_scaled(velocity, slope, *direction);
            }
            Step::Rotation { axis, at, amount } => {
                let slope = graph.diff(*amount, symbol);
                let omega = graph.scale(slope, *axis);
                velocity = swing(graph, velocity, omega, tool, *at);
                rotation = graph.add_vectors(rotation, omega);
            }
            Step::Matrix { before, local, after } => {
                let slopes = Frame::from_entries(&graph.diff_all(&local.entries(), symbol));
                let omega = spin_of(graph, &local.axes, slopes.axes);
                let omega = graph.turn(&before.axes, omega);
                let shift = graph.turn(&before.axes, slopes.position);
                velocity = graph.add_vectors(velocity, shift);
                velocity = swing(graph, velocity, omega, tool, *after);
                rotation = graph.add_vectors(rotation, omega);
            }
        }
    }
    [velocity, rotation]
}

/// Steps, indexed by the symbols that they depend on.
pub(super) struct Steps {
    list: Vec<Step>,
    by_symbol: IndexMap<Symbol, Vec<usize>>,
}

impl Steps {
    pub(super) fn new(graph: &Graph, list: Vec<Step>) -> Self {
        let mut by_symbol: IndexMap<Symbol, Vec<usize>> = IndexMap::new();
        for (at, step) in list.iter().enumerate() {
            for symbol in step.symbols(graph) {
                by_symbol.entry(symbol).or_default().push(at);
            }
        }
        Self { list, by_symbol }
    }

    /// Returns the steps of a single transform.
    pub(super) fn of_transform(graph: &mut Graph, factors: &[Factor]) -> Self {
        let (identity, mut list) = (graph.identity(), Vec::new());
        walk(graph, identity, factors, &mut list);
        Self::new(graph, list)
    }

    /// Returns the symbols that at least one step depends on.
    pub(super) fn symbols(&self) -> impl Iterator<Item = Symbol> {
        self.by_symbol.keys().copied()
    }
}

/// Returns `v + ω × (p_T − p)`.
pub(crate) fn swing(graph: &mut Graph, velocity: Vector, omega: Vector, tool: Vector, at: Vector) -> Vector {
    if omega == [graph.zero(); 3] {
        return velocity;
    }
    let lever = graph.sub_vectors(tool, at);
    graph.add_cross(velocity, omega, lever)
}

/// Returns `vee(Ṙ Rᵀ)` from columns: entry (i, j) of the product is the sum over columns c of `ċ_i
/// c_j`.
fn spin_of(graph: &mut Graph, axes: &[Vector; 3], slopes: [Vector; 3]) -> Vector {
    std::array::from_fn(|axis| {
        let (i, j) = ((axis + 2) % 3, (axis + 1) % 3);
        graph.dot(slopes.map(|column| column[i]), axes.map(|column| column[j]))
    })
}

/// Velocity of the origin and rotation, in the axes before a transform, per unit of a symbol.
#[derive(Clone, Debug)]
pub struct LocalTwist {
    /// Index of the transform, from 0; the tool is the last.
    pub transform: usize,
    /// Index of the symbol.
    pub column: usize,
    /// Velocity and rotation.
    pub twist: Six,
}

/// Returns the nonzero twists `dA_i/dx A_i⁻¹`, transform by transform.
pub(super) fn local_twists(graph: &mut Graph, spec: &Spec, symbols: &[Symbol]) -> Vec<LocalTwist> {
    let columns: HashMap<Symbol, usize> =
        symbols.iter().enumerate().map(|(i, symbol)| (*symbol, i)).collect();
    let mut found = Vec::new();
    let origin = [graph.zero(); 3];
    for (transform, factors) in spec.frames.iter().map(|frame| &frame.factors).chain([&spec.tool]).enumerate()
    {
        let steps = Steps::of_transform(graph, factors);
        let mut moved: Vec<usize> =
            steps.symbols().filter_map(|symbol| columns.get(&symbol).copied()).collect();
        moved.sort_unstable();
        for column in moved {
            let [velocity, turn] = twist(graph, &steps, symbols[column], origin);
            if [velocity, turn] != [origin; 2] {
                let ([a, b, c], [d, e, f]) = (velocity, turn);
                found.push(LocalTwist { transform, column, twist: [a, b, c, d, e, f] });
            }
        }
    }
    found
}
