//! Names that move: joints, parameters and inputs.

use abbe_spec::expr::Symbol;

/// How many names may move: of a node that more of them move nothing is proved.
pub const MOST_MOVING: usize = 32;

/// A name that moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moving {
    /// Which.
    pub symbol: Symbol,
    /// From where to where; both finite, in this order.
    pub range: [f64; 2],
    /// Where it is if it does not matter.
    pub home: f64,
    /// Where the search begins, before it looks elsewhere.
    pub start: f64,
}
