//! The symbolic core: expressions as a graph in which equal subexpressions are one node.
//!
//! [`Graph`] holds the nodes; the rules by which they simplify are its constructors (`arithmetic`,
//! `functions`); `diff` is the derivative of any node by any symbol, `evaluate` its value, `vector` three-dimensional arithmetic, and
//! `lower` brings a checked expression in.

mod arena;
mod arithmetic;
mod diff;
mod evaluate;
mod functions;
mod lower;
mod vector;

pub use arena::{Graph, Node, Op};
pub use vector::{Frame, Vector};
