//! The equations of all loops of a machine as functions of the passive variables, and Newton's
//! step.

use abbe_spec::{Spec, Symbol};

use super::{Parts, factored::Factored, units::Units};
use crate::graph::{Graph, Node};

/// Largest factor of a determinant that counts as zero, relative to its unit.
const SINGULAR: f64 = 1e-14;

/// Equations φ of all loops of a machine. Passive variables are local symbols, from 0.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct LoopSystem {
    /// φ, which is zero where the loops close.
    pub(super) residual: Vec<Node>,
    /// Numbers that are positive unless a rotation closes upside down.
    pub(super) upright: Vec<Node>,
    /// Newton's step `φ_p⁻¹ φ`, to be subtracted from p.
    pub(crate) step: Vec<Node>,
    /// Determinants of the irreducible blocks on the diagonal of φ_p, positive at home; negative
    /// where they are zero at home.
    pub(super) determinants: Vec<Node>,
}

impl LoopSystem {
    pub(super) fn new(
        graph: &mut Graph,
        [residual, upright]: [Vec<Node>; 2],
        factored: &Factored,
        home: impl Fn(Symbol) -> f64,
    ) -> Self {
        let step = factored.solve(graph, &residual);
        let mut determinants = Vec::new();
        for (determinant, pivots) in factored.determinants() {
            let nodes: Vec<Node> = pivots.iter().map(|(pivot, _)| *pivot).chain([determinant]).collect();
            let at_home = graph.evaluate(&nodes, &home);
            let is_regular = pivots.iter().zip(&at_home).all(|((_, unit), at)| at.abs() > SINGULAR * unit);
            determinants.push(match (is_regular, at_home[pivots.len()] < 0.0) {
                (true, true) => graph.neg(determinant),
                (true, false) => determinant,
                // Without a sign at home there is no mode.
                (false, _) => graph.constant(-1.0),
            });
        }
        Self { residual, upright, step, determinants }
    }

    /// Returns the system with other nodes for symbols.
    pub(super) fn substituted(
        &self,
        graph: &mut Graph,
        other: impl Fn(&mut Graph, Symbol) -> Option<Node>,
    ) -> Self {
        let all = [&self.residual[..], &self.step, &self.determinants].concat();
        let symbols = graph.symbols(&all);
        let others: Vec<_> = symbols.into_iter().map(|symbol| (symbol, other(graph, symbol))).collect();
        let given = |symbol| others.iter().find(|(known, _)| *known == symbol).and_then(|(_, other)| *other);
        let mut all = graph.substitute(&all, given).into_iter();
        let residual = all.by_ref().take(self.residual.len()).collect();
        let step = all.by_ref().take(self.step.len()).collect();
        Self { residual, upright: Vec::new(), step, determinants: all.collect() }
    }

    /// Returns the largest equation, relative to its unit.
    pub(super) fn gap(&self, graph: &mut Graph, units: &[f64]) -> Node {
        let mut largest = graph.zero();
        for (equation, unit) in self.residual.iter().zip(units) {
            let per_unit = graph.constant(1.0 / unit);
            let size = graph.call(abbe_spec::expr::Function::Abs, *equation);
            let size = graph.mul(per_unit, size);
            largest = graph.max(largest, size);
        }
        largest
    }

    /// Returns the sum of the squares of the steps, relative to the units of the passive variables.
    pub(super) fn size(&self, graph: &mut Graph, units: &[f64]) -> Node {
        let mut sum = graph.zero();
        for (step, unit) in self.step.iter().zip(units) {
            let per_unit = graph.constant(1.0 / unit);
            let step = graph.mul(per_unit, *step);
            sum = graph.add_product(sum, step, step);
        }
        sum
    }
}

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
