//! The equations of all loops as functions of the passive variables, for checks of a spec.

use abbe_spec::Spec;

use super::model::Parts;
use crate::graph::{Graph, Node};

/// Equations φ of the loops and their derivatives `φ_p`. Passive variables are local symbols, from 0.
pub struct LoopEquations {
    /// Graph of the nodes.
    pub graph: Graph,
    /// φ, in the length unit and rad: the equations of the first loop, then those of the others.
    pub residual: Vec<Node>,
    /// Columns of `φ_p`, one per passive variable.
    pub derivatives: Vec<Vec<Node>>,
}

impl LoopEquations {
    /// Builds the equations of a spec.
    pub fn new(spec: &Spec) -> Self {
        let mut graph = Graph::with_tables(&spec.tables);
        let parts = Parts::new(&mut graph, spec);
        let residual = parts.residual(&mut graph);
        let derivatives = parts.derivatives(&mut graph, spec);
        Self { graph, residual, derivatives }
    }
}
