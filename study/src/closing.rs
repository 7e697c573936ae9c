//! Numerical closing of the loops, also from values that are far away, and where the equations are
//! singular.

use abbe::analysis::decompose;
use abbe_codegen::chain::LoopEquations;
use abbe_spec::{Spec, expr::Symbol};
use nalgebra::{DMatrix, DVector};

/// Maximum number of steps.
const STEPS: usize = 500;

/// Largest equation of loops that close, without a unit.
pub(crate) const CLOSED: f64 = 1e-10;

/// The equations of the loops at a configuration. Without units, lengths are relative to those of
/// the loops.
pub(crate) struct Closing<'a> {
    spec: &'a Spec,
    pub(crate) q: Vec<f64>,
    pub(crate) s: Vec<f64>,
    pub(crate) equations: LoopEquations,
}

impl<'a> Closing<'a> {
    pub(crate) fn new(spec: &'a Spec, q: &[f64], s: &[f64]) -> Self {
        Self { spec, q: q.to_vec(), s: s.to_vec(), equations: LoopEquations::new(spec) }
    }

    /// Returns the passive variables at home in the spec.
    pub(crate) fn home(&self) -> Vec<f64> {
        self.spec.passive.iter().map(|variable| variable.home).collect()
    }

    /// Returns the equations, in the length unit and rad.
    pub(crate) fn residual(&self, passive: &[f64]) -> Vec<f64> {
        self.evaluate(&self.equations.residual, passive)
    }

    /// Returns the equations without units.
    pub(crate) fn scaled(&self, passive: &[f64]) -> DVector<f64> {
        let rows = &self.equations.row_units;
        let residual = self.residual(passive).into_iter().zip(rows);
        DVector::from_iterator(rows.len(), residual.map(|(value, unit)| value / unit))
    }

    /// Returns the largest equation without units.
    pub(crate) fn size(&self, passive: &[f64]) -> f64 {
        let size = self.scaled(passive).amax();
        if size.is_finite() { size } else { f64::INFINITY }
    }

    /// Returns `true` if the loops close there, and no rotation does so upside down.
    pub(crate) fn closes(&self, passive: &[f64]) -> bool {
        let upright = self.evaluate(&self.equations.upright, passive);
        self.size(passive) <= CLOSED && upright.iter().all(|positive| *positive > 0.0)
    }

    /// Returns `φ_p` without units.
    pub(crate) fn derivatives(&self, passive: &[f64]) -> DMatrix<f64> {
        let entries = self.evaluate(&self.equations.derivatives.concat(), passive);
        let LoopEquations { row_units: rows, column_units: columns, .. } = &self.equations;
        DMatrix::from_fn(rows.len(), columns.len(), |i, j| entries[j * rows.len() + i] * columns[j] / rows[i])
    }

    /// Returns the largest and the smallest singular value of `φ_p` without units; `None` if they
    /// are not finite.
    pub(crate) fn singular_values(&self, passive: &[f64]) -> Option<[f64; 2]> {
        let derivatives = self.derivatives(passive);
        let blocks = self.equations.blocks.iter().map(|[rows, columns]| {
            let values = decompose::singular_values(derivatives.select_rows(rows).select_columns(columns))?;
            Some([*values.first()?, *values.last()?])
        });
        blocks.reduce(|a, b| a.zip(b).map(|([a, b], [c, d])| [a.max(c), b.min(d)])).flatten()
    }

    /// Returns the values of nodes of the equations.
    pub(crate) fn evaluate(&self, nodes: &[abbe_codegen::graph::Node], passive: &[f64]) -> Vec<f64> {
        self.equations.graph.evaluate(nodes, |symbol| match symbol {
            Symbol::Local(i) => passive[i],
            Symbol::Variable(i) => self.q[i],
            Symbol::Parameter(i) => self.s[i],
            symbol => value_at_home(symbol, self.spec),
        })
    }

    /// Returns the passive variables for which the sum of squares of the equations has a local
    /// minimum, by the Levenberg-Marquardt method from given values.
    pub(crate) fn nearest(&self, start: &[f64]) -> Vec<f64> {
        let mut passive = start.to_vec();
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
                (0..passive.len()).map(|i| passive[i] - step[i] * self.equations.column_units[i]).collect();
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

/// Returns the value of a symbol at home.
pub(crate) fn value_at_home(symbol: Symbol, spec: &Spec) -> f64 {
    match symbol {
        Symbol::Variable(i) => spec.variables[i].home,
        Symbol::Parameter(i) => spec.parameters[i].value,
        Symbol::Input(i) => spec.inputs[i].value,
        // Nodes read passive variables as local symbols.
        Symbol::Passive(i) | Symbol::Local(i) => spec.passive.get(i).map_or(0.0, |variable| variable.home),
        Symbol::Magnitude(_) | Symbol::Target(_) | Symbol::Error(_) => 0.0,
    }
}
