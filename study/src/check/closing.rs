//! Numerical closing of the loops at home, also from values that are far away, and where the
//! equations are singular.

use abbe_codegen::chain::{LoopEquations, transform};
use abbe_spec::Spec;
use abbe_spec::expr::Symbol;
use nalgebra::{DMatrix, DVector};

use super::chain::value_at_home;
use crate::loop_units::LoopUnits;

/// Maximum number of steps.
const STEPS: usize = 500;

/// The equations of the loops at home, with lengths relative to the arm length.
pub(super) struct Closing<'a> {
    spec: &'a Spec,
    equations: LoopEquations,
    units: LoopUnits,
}

impl<'a> Closing<'a> {
    pub(super) fn new(spec: &'a Spec) -> Self {
        Self { spec, equations: LoopEquations::new(spec), units: LoopUnits::new(spec, arm_length(spec)) }
    }

    /// Returns the equations, in the length unit and rad.
    pub(super) fn residual(&self, passive: &[f64]) -> Vec<f64> {
        self.evaluate(&self.equations.residual, passive)
    }

    /// Returns the equations without units.
    fn scaled(&self, passive: &[f64]) -> DVector<f64> {
        let rows = &self.units.rows;
        let residual = self.residual(passive).into_iter().zip(rows);
        DVector::from_iterator(rows.len(), residual.map(|(value, unit)| value / unit))
    }

    /// Returns the largest equation without units.
    pub(super) fn size(&self, passive: &[f64]) -> f64 {
        let size = self.scaled(passive).amax();
        if size.is_finite() { size } else { f64::INFINITY }
    }

    /// Returns `φ_p` without units.
    pub(super) fn derivatives(&self, passive: &[f64]) -> DMatrix<f64> {
        self.units.derivatives(&self.evaluate(&self.equations.derivatives.concat(), passive))
    }

    fn evaluate(&self, nodes: &[abbe_codegen::graph::Node], passive: &[f64]) -> Vec<f64> {
        self.equations.graph.evaluate(nodes, |symbol| match symbol {
            Symbol::Local(i) => passive[i],
            symbol => value_at_home(symbol, self.spec),
        })
    }

    /// Returns the passive variables for which the sum of squares of the equations has a local
    /// minimum, by the Levenberg-Marquardt method from their values at home.
    pub(super) fn nearest(&self) -> Vec<f64> {
        let mut passive: Vec<f64> = self.spec.passive.iter().map(|variable| variable.home).collect();
        let mut residual = self.scaled(&passive);
        let mut damping = 1e-3;
        for _ in 0..STEPS {
            let derivatives = self.derivatives(&passive);
            let gradient = derivatives.tr_mul(&residual);
            let mut normal = derivatives.tr_mul(&derivatives);
            for i in 0..normal.nrows() {
                normal[(i, i)] += damping;
            }
            let Some(step) = normal.cholesky().map(|factored| factored.solve(&gradient)) else { break };
            let moved: Vec<f64> =
                (0..passive.len()).map(|i| passive[i] - step[i] * self.units.columns[i]).collect();
            let found = self.scaled(&moved);
            // A comparison with NaN is false.
            if found.norm() < residual.norm() {
                (passive, residual) = (moved, found);
                damping = (damping / 5.0).max(1e-15);
            } else if damping > 1e6 {
                break;
            } else {
                damping *= 4.0;
            }
        }
        passive
    }
}

/// Returns the sum of the lengths of the transforms at home, as `abbe::sampling::arm_length`, also
/// where loops do not close; 1 if it is zero.
fn arm_length(spec: &Spec) -> f64 {
    let mut graph = abbe_codegen::graph::Graph::with_tables(&spec.tables);
    let factors = spec.frames.iter().map(|frame| &frame.factors).chain([&spec.tool]);
    let nodes: Vec<_> = factors.flat_map(|factors| transform(&mut graph, factors).position).collect();
    let numbers = graph.evaluate(&nodes, |symbol| value_at_home(symbol, spec));
    let lengths = numbers.chunks_exact(3).map(|xyz| xyz.iter().map(|x| x * x).sum::<f64>().sqrt());
    let length: f64 = lengths.sum();
    if length > 0.0 && length.is_finite() { length } else { 1.0 }
}
