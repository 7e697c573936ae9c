//! Programs: the steps of a computation in order, independent of a language.
//!
//! A [`Program`] is straight-line: [`Step`]s, each after its operands, and the values it returns.
//! `outputs` gives the nodes of each function. A [`Routine`] computes one function: usually with
//! one program, for long chains with several programs in loops (`loops`). [`Routines`] holds all
//! functions of a manipulator. `select` chooses, among equal nodes, those that take the fewest
//! operations together; `write` converts them to steps. `derivatives` differentiates a function by
//! the parameters. `bounds` proves that results are finite, `checked` tells which numbers a
//! function has to check at run time.

mod bounds;
mod checked;
mod count;
mod derivatives;
mod description;
mod loops;
mod outputs;
mod rounding;
mod routine;
mod routines;
mod select;
mod step;
mod straight_line;
mod tree;
mod write;

pub use checked::Checks;
pub use count::Operations;
pub use derivatives::parameter_derivatives;
pub use outputs::{results, straight_line};
pub use rounding::Rounded;
pub use routine::{Array, ArrayRows, Block, Repeated, Role, Routine, Row, Stage, Sums, Table};
pub use routines::Routines;
pub use step::{Action, Operand, Program, Step};
pub use tree::locals;
