//! Names that move within a range: joints, parameters and inputs.

use abbe_spec::expr::Symbol;

/// Maximum number of moving names that a node may depend on; no bound is proved for more.
pub const MOST_MOVING: usize = 32;

/// A name that moves within a range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moving {
    /// The symbol.
    pub symbol: Symbol,
    /// Range of the name: finite, lower end first.
    pub range: [f64; 2],
    /// Value of the name if the node does not depend on it.
    pub home: f64,
    /// Value at which the search starts.
    pub start: f64,
}
