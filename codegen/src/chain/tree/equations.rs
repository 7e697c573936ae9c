//! The equations of all loops as functions of the passive variables.

use abbe_spec::Spec;
use abbe_spec::expr::Symbol;

use super::parts::Parts;
use super::units::Units;
use crate::graph::{Graph, Node};

/// Equations φ of the loops and their derivatives `φ_p`. Passive variables are local symbols, from
/// 0.
#[derive(Clone, Debug)]
pub struct LoopEquations {
    /// Graph of the nodes.
    pub graph: Graph,
    /// φ, in the length unit and rad: the equations of the first loop, then those of the others.
    pub residual: Vec<Node>,
    /// Numbers that are positive unless a rotation closes upside down.
    pub upright: Vec<Node>,
    /// Columns of `φ_p`, one per passive variable.
    pub derivatives: Vec<Vec<Node>>,
    /// Unit of each equation: the length of its loop, or 1 rad.
    pub row_units: Vec<f64>,
    /// Unit of each passive variable: the length of the longest loop, or 1 rad.
    pub column_units: Vec<f64>,
    /// Unit of each joint variable, alike.
    pub variable_units: Vec<f64>,
    /// Rows and columns of the blocks that `φ_p` consists of, sorted: the equations and passive
    /// variables of loops that do not depend on those of other blocks.
    pub blocks: Vec<[Vec<usize>; 2]>,
}

impl LoopEquations {
    /// Builds the equations of a spec.
    pub fn new(spec: &Spec) -> Self {
        let mut graph = Graph::with_tables(&spec.tables);
        let parts = Parts::new(&mut graph, spec);
        let [residual, upright] = [parts.residual(&mut graph), parts.upright(&mut graph)];
        let derivatives = parts.derivatives(&mut graph, spec);
        let Units { equations: row_units, passive: column_units, variables: variable_units } =
            Units::new(spec, &mut graph);
        let blocks = independent(&derivatives, graph.zero());
        Self { graph, residual, upright, derivatives, row_units, column_units, variable_units, blocks }
    }

    /// Returns φ at given values of joint variables, passive variables and parameters.
    pub fn residual_at(&self, q: &[f64], p: &[f64], s: &[f64]) -> Vec<f64> {
        self.graph.evaluate(&self.residual, |symbol| match symbol {
            Symbol::Variable(i) => q[i],
            Symbol::Local(i) => p[i],
            Symbol::Parameter(i) => s[i],
            _ => f64::NAN,
        })
    }
}

/// Returns the rows and columns of the blocks of a matrix that is block diagonal but for its order.
fn independent(columns: &[Vec<Node>], zero: Node) -> Vec<[Vec<usize>; 2]> {
    let mut blocks: Vec<[Vec<usize>; 2]> = Vec::new();
    for (index, column) in columns.iter().enumerate() {
        let own = |row: &usize| column[*row] != zero;
        let (same, others): (Vec<_>, Vec<_>) = blocks.into_iter().partition(|[rows, _]| rows.iter().any(own));
        let mut block = [(0..column.len()).filter(own).collect(), vec![index]];
        same.into_iter().flatten().enumerate().for_each(|(i, more)| block[i % 2].extend(more));
        block.iter_mut().for_each(|indices| indices.sort_unstable());
        block[0].dedup();
        blocks = others.into_iter().chain([block]).collect();
    }
    blocks.sort_unstable();
    blocks
}
