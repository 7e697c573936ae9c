//! Names that a spec declares: parameters, inputs and joint variables.

use abbe_core::VariableKind;

use crate::expr::Dimension;

/// A structural parameter.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Name of the parameter.
    pub name: String,
    /// Nominal value in coherent units.
    pub value: f64,
    /// Dimension of the value.
    pub dimension: Dimension,
    /// Coherent unit; empty for a pure number or an angle.
    pub unit: String,
    /// Description.
    pub description: String,
}

/// An input.
#[derive(Clone, Debug)]
pub struct Input {
    /// Name of the input.
    pub name: String,
    /// Default value in coherent units.
    pub value: f64,
    /// Dimension of the value.
    pub dimension: Dimension,
    /// Coherent unit; empty for a pure number or an angle.
    pub unit: String,
    /// Lower and upper end of the range; infinite without one.
    pub range: [f64; 2],
    /// Values that are used, in ascending order; empty for any in the range.
    pub levels: Vec<f64>,
    /// Standard uncertainty of its value in use, in coherent units; 0 if it is exact.
    pub uncertainty: f64,
    /// Description.
    pub description: String,
}

/// A joint variable.
#[derive(Clone, Debug)]
pub struct Variable {
    /// Name of the variable.
    pub name: String,
    /// Revolute or prismatic.
    pub kind: VariableKind,
    /// Lower and upper limit; infinite without one.
    pub limits: [f64; 2],
    /// Value at home.
    pub home: f64,
    /// Description.
    pub description: String,
    /// Index of the frame that declares the variable, from 0.
    pub frame: usize,
}
