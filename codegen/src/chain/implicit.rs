//! Unknowns that equations define.

use abbe_spec::Symbol;

use crate::graph::{Graph, Node};

/// Unknowns y that equations `F(x, y) = 0` define as functions of the other symbols x.
#[derive(Clone, Debug)]
pub struct Implicit {
    /// Sets of unknowns, each with F, of as many entries.
    pub sets: Vec<(Vec<Symbol>, Vec<Node>)>,
    /// Columns of `∂F/∂y`, one per unknown; the same for all sets.
    pub columns: Vec<Vec<Node>>,
    /// Values of the unknowns of a single set at home, from where they are followed; `None` if F is
    /// linear in the unknowns.
    pub home: Option<Vec<f64>>,
}

impl Implicit {
    /// Returns the symbols on which nodes depend, those of the equations of their unknowns
    /// included. `all` has unknowns after those on which their equations depend.
    pub fn symbols(graph: &Graph, nodes: &[Node], all: &[Self]) -> Vec<Symbol> {
        let mut symbols = graph.symbols(nodes);
        for implicit in all.iter().rev() {
            for (unknowns, residual) in &implicit.sets {
                if unknowns.iter().any(|unknown| symbols.contains(unknown)) {
                    symbols.extend(graph.symbols(&[residual.clone(), implicit.columns.concat()].concat()));
                }
            }
        }
        symbols.sort_unstable();
        symbols.dedup();
        symbols
    }
}
