//! The symbolic core: expressions as a graph in which equal subexpressions are one node.
//!
//! [`Graph`] holds the nodes. Its constructors (`arithmetic`, `functions`) simplify; `equal` states
//! equalities that a program chooses from; `diff` differentiates any node by any symbol; `evaluate`
//! computes values; `lower` converts checked expressions.

mod arena;
mod arithmetic;
mod classes;
mod diff;
mod equal;
mod evaluate;
mod functions;
mod lower;
mod node;
mod substitute;
mod vector;

pub use arena::Graph;
pub use classes::Signed;
pub(crate) use lower::in_programs;
pub use node::{Node, Op};
pub(crate) use vector::transposed;
pub use vector::{Frame, Vector};
