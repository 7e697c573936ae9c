//! The equations of all loops as functions of the passive variables.

use abbe_spec::Spec;
use abbe_spec::expr::Symbol;

use super::parts::Parts;
use crate::graph::{Graph, Node};

/// Equations φ of the loops and their derivatives `φ_p`. Passive variables are local symbols, from
/// 0.
#[derive(Clone, Debug)]
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

    /// Returns φ at given values of joint variables, passive variables and parameters.
    pub fn residual_at(&self, q: &[f64], p: &[f64], s: &[f64]) -> Vec<f64> {
        self.evaluate(&self.residual, q, p, s)
    }

    /// Returns the entries of `φ_p` there, column by column.
    pub fn derivatives_at(&self, q: &[f64], p: &[f64], s: &[f64]) -> Vec<f64> {
        self.evaluate(&self.derivatives.concat(), q, p, s)
    }

    fn evaluate(&self, nodes: &[Node], q: &[f64], p: &[f64], s: &[f64]) -> Vec<f64> {
        self.graph.evaluate(nodes, |symbol| match symbol {
            Symbol::Variable(i) => q[i],
            Symbol::Local(i) => p[i],
            Symbol::Parameter(i) => s[i],
            _ => f64::NAN,
        })
    }
}
