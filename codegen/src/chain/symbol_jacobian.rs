//! `∂X_T/∂x` for a joint variable or structural parameter x that may stand anywhere in the chain.

use super::walk::Step;
use crate::expr::Symbol;
use crate::graph::{Graph, Node, Vector};

/// The velocity of the tool point and the rotation that a symbol causes: the sum over all factors that depend on it, each by its own small motion
///
/// ```text
/// translation by f along e            (e ; 0) ∂f/∂x
/// rotation by f about a through p     (a × (p_T − p) ; a) ∂f/∂x
/// matrix (R, t) after T = (R₀, p₀)    ω = R₀ vee(∂R/∂x Rᵀ),  (R₀ ∂t/∂x + ω × (p_T − p₀ − R₀ t) ; ω)
/// ```
///
/// Each step comes with the symbols that it depends on.
pub(super) fn twist(
    graph: &mut Graph,
    steps: &[(Step, Vec<Symbol>)],
    symbol: Symbol,
    tool: Vector,
) -> [Vector; 2] {
    let mut velocity = [graph.zero(); 3];
    let mut rotation = [graph.zero(); 3];
    for (step, _) in steps.iter().filter(|(_, symbols)| symbols.contains(&symbol)) {
        match step {
            Step::Translation { direction, amount } => {
                let slope = graph.diff(*amount, symbol);
                let part = graph.scale(slope, *direction);
                velocity = graph.add_vectors(velocity, part);
            }
            Step::Rotation { axis, at, amount } => {
                let slope = graph.diff(*amount, symbol);
                let omega = graph.scale(slope, *axis);
                velocity = swing(graph, velocity, omega, tool, *at);
                rotation = graph.add_vectors(rotation, omega);
            }
            Step::Matrix { before, local, after } => {
                let nodes: Vec<Node> = local.axes.iter().flatten().chain(&local.position).copied().collect();
                let slopes = graph.diff_all(&nodes, symbol);
                let vector = |i: usize| [slopes[3 * i], slopes[3 * i + 1], slopes[3 * i + 2]];
                let omega = spin_of(graph, &local.axes, [vector(0), vector(1), vector(2)]);
                let omega = graph.turn(&before.axes, omega);
                let shift = graph.turn(&before.axes, vector(3));
                velocity = graph.add_vectors(velocity, shift);
                velocity = swing(graph, velocity, omega, tool, *after);
                rotation = graph.add_vectors(rotation, omega);
            }
        }
    }
    [velocity, rotation]
}

/// Steps with the symbols that each depends on.
pub(super) fn with_symbols(graph: &Graph, steps: Vec<Step>) -> Vec<(Step, Vec<Symbol>)> {
    let with = |step: Step| {
        let symbols = step.symbols(graph);
        (step, symbols)
    };
    steps.into_iter().map(with).collect()
}

/// `v + ω × (p_T − p)`.
pub(crate) fn swing(graph: &mut Graph, velocity: Vector, omega: Vector, tool: Vector, at: Vector) -> Vector {
    if omega == [graph.zero(); 3] {
        return velocity;
    }
    let lever = graph.sub_vectors(tool, at);
    let part = graph.cross(omega, lever);
    graph.add_vectors(velocity, part)
}

/// `vee(Ṙ Rᵀ)`, from columns: entry (i, j) of the product is the sum over columns c of `ċ_i c_j`.
fn spin_of(graph: &mut Graph, axes: &[Vector; 3], slopes: [Vector; 3]) -> Vector {
    std::array::from_fn(|axis| {
        let (i, j) = ((axis + 2) % 3, (axis + 1) % 3);
        let products: [Node; 3] = std::array::from_fn(|c| graph.mul(slopes[c][i], axes[c][j]));
        let sum = graph.add(products[0], products[1]);
        graph.add(sum, products[2])
    })
}
