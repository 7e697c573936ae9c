//! Straight-line programs: what to compute, in which order, in no particular language.
//!
//! A [`Program`] is one function of the variables, parameters and inputs: [`Step`]s, each after those it uses,
//! and the values it returns. `functions` lists the functions of a manipulator.

mod count;
mod functions;
mod fuse;
mod order;
mod straight_line;

pub use count::Operations;
pub use functions::{FunctionKind, functions};
pub use straight_line::{Action, Operand, Program, Step};
