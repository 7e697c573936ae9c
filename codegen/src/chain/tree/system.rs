//! The equations of all loops of a machine, and Newton's step.

use abbe_spec::expr::Symbol;

use super::factored::Factored;
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
            let square = graph.mul(step, step);
            sum = graph.add(sum, square);
        }
        sum
    }
}
