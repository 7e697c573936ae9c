//! What a spec declares by name: parameters, inputs and joint variables.

use abbe_core::VariableKind;

use crate::expr::Dimension;

/// A structural parameter.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// Its nominal value.
    pub value: f64,
    /// Its dimension.
    pub dimension: Dimension,
    /// Its coherent unit, empty for a pure number or an angle.
    pub unit: String,
    /// What it is.
    pub description: String,
}

/// An input.
#[derive(Clone, Debug)]
pub struct Input {
    /// Its name.
    pub name: String,
    /// Its default value.
    pub value: f64,
    /// Its dimension.
    pub dimension: Dimension,
    /// Its coherent unit, empty for a pure number or an angle.
    pub unit: String,
    /// Lower and upper end of its range, infinite if it has none.
    pub range: [f64; 2],
    /// What it is.
    pub description: String,
}

/// A joint variable.
#[derive(Clone, Debug)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// Revolute or prismatic.
    pub kind: VariableKind,
    /// Lower and upper limit, infinite if it has none.
    pub limits: [f64; 2],
    /// Its value at home.
    pub home: f64,
    /// What it is.
    pub description: String,
    /// The frame that declares it, from 0.
    pub frame: usize,
}
