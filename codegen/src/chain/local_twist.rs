//! Twists of single transforms per unit of a symbol, for the loops of long chains.

use std::collections::HashMap;

use abbe_spec::Spec;
use abbe_spec::expr::Symbol;

use super::symbol_jacobian::{Steps, twist};
use crate::graph::{Graph, Node};

/// Velocity of the origin and rotation, in the axes before a transform, per unit of a symbol.
#[derive(Clone, Debug)]
pub struct LocalTwist {
    /// Index of the transform, from 0; the tool is the last.
    pub transform: usize,
    /// Index of the symbol.
    pub column: usize,
    /// Velocity and rotation.
    pub twist: [Node; 6],
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
