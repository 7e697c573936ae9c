//! Covariance of the errors of an identified machine.

use abbe_core::Component;

/// Covariance of identified quantities.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Covariance {
    /// Identified quantities, in the order of the rows.
    pub of: Vec<Identified>,
    /// Symmetric matrix by rows, in the units of the quantities: the length unit, rad, or 1.
    pub rows: Vec<Vec<f64>>,
}

/// An identified quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Identified {
    /// Magnitude of a source, 1 = as in the spec; by index among all sources.
    Magnitude(usize),
    /// One of the six errors of a frame (from 0), in the length unit or rad.
    Error(usize, Component),
    /// One of the six errors of `F_0`, the placement of the machine, in the length unit or rad.
    Base(Component),
    /// Error of a joint, by its index among the variables, in rad or the length unit.
    Joint(usize),
}
