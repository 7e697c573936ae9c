//! Names that a spec declares: parameters, inputs and joint variables.
//!
//! Ranges of joints and inputs over which the errors of an identified machine were fitted.

use abbe_core::VariableKind;

use crate::expr::{Dimension, Symbol};

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

/// A joint variable or an input, and the range over which errors were fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fitted {
    /// The variable or input.
    pub symbol: Symbol,
    /// Lower and upper end.
    pub range: [f64; 2],
}

impl Fitted {
    /// Returns `true` if the value in `q` or `u` is outside the range.
    pub fn is_outside(&self, q: &[f64], u: &[f64]) -> bool {
        let value = match self.symbol {
            Symbol::Variable(i) => q.get(i),
            Symbol::Input(i) => u.get(i),
            _ => None,
        };
        value.is_some_and(|value| !self.contains(*value))
    }

    /// Returns `true` if a value is within the range, up to the rounding of written numbers.
    pub fn contains(&self, value: f64) -> bool {
        let [lower, upper] = self.range;
        let digit = 1e-6 * lower.abs().max(upper.abs());
        (lower - digit..=upper + digit).contains(&value)
    }
}
