//! The symbolic core: expressions as a graph in which equal subexpressions are one node.
//!
//! [`Graph`] holds the nodes; the rules by which they simplify are its constructors (`arithmetic`,
//! `functions`), and what takes other operations to the same value is stated in `equal`; `diff` is the derivative of any node by any symbol, `evaluate` its value, `substitute` puts nodes in the place of symbols, `vector` is three-dimensional arithmetic, and
//! `lower` brings a checked expression in.

mod arena;
mod arithmetic;
mod classes;
mod diff;
mod equal;
mod evaluate;
mod functions;
mod hash;
mod lower;
mod node;
mod substitute;
mod vector;

pub use arena::Graph;
pub use classes::Signed;
pub use node::{Node, Op};
pub use vector::{Frame, Vector};
