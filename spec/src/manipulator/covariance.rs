//! How well the errors of an identified machine are known, and how they depend on each other.

use abbe_core::Component;

/// The covariance of what was identified.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Covariance {
    /// Of what, in order.
    pub of: Vec<Identified>,
    /// Row by row, in the units of these: the length unit, rad, or 1.
    pub rows: Vec<Vec<f64>>,
}

/// Something that was identified.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Identified {
    /// What a source is multiplied with, 1 = as the spec has it; by index among all sources.
    Magnitude(usize),
    /// One of the six errors of a frame, from 0: the length unit, or rad.
    Error(usize, Component),
}
