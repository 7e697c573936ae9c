//! The symbolic core: expressions as a graph in which equal subexpressions are one node.
//!
//! [`Graph`] holds the nodes. Its constructors (`arithmetic`, `functions`) simplify; `equal` states
//! equalities that a program chooses from; `diff` differentiates any node by any symbol; `evaluate`
//! computes values; `lower` converts checked expressions.

mod arena;
mod arithmetic;
mod diff;
mod equal;
mod functions;
mod lower;
mod substitute;
mod vector;

pub use arena::{Graph, Node, Op, Signed};
pub(crate) use lower::in_programs;
pub(crate) use vector::transposed;
pub use vector::{Frame, Six, Vector};
