//! Equations of loops without units, such that lengths and angles compare.

use abbe::VariableKind;
use abbe_spec::Spec;
use nalgebra::DMatrix;

/// Units of the equations of all loops, and of the passive variables.
pub(crate) struct LoopUnits {
    /// Unit of each equation: the arm length, or 1 rad.
    pub(crate) rows: Vec<f64>,
    /// Unit of each passive variable: the arm length, or 1 rad.
    pub(crate) columns: Vec<f64>,
}

impl LoopUnits {
    pub(crate) fn new(spec: &Spec, arm: f64) -> Self {
        let unit = |is_angle: bool| if is_angle { 1.0 } else { arm };
        let closures = spec.loops.iter().map(|closed| &closed.closure);
        let rows = closures.flat_map(|closure| (0..closure.equations()).map(|i| unit(closure.is_angle(i))));
        let columns = spec.passive.iter().map(|variable| unit(variable.kind == VariableKind::Revolute));
        Self { rows: rows.collect(), columns: columns.collect() }
    }

    /// Returns `φ_p` without units from its entries, column by column, in the length unit and rad.
    pub(crate) fn derivatives(&self, entries: &[f64]) -> DMatrix<f64> {
        DMatrix::from_fn(self.rows.len(), self.columns.len(), |i, j| {
            entries[j * self.rows.len() + i] * self.columns[j] / self.rows[i]
        })
    }
}
