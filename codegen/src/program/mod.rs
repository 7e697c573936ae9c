//! Programs: what to compute, in which order, in no particular language.
//!
//! A [`Program`] is straight-line: [`Step`]s, each after those it uses, and the values it returns. `outputs` says which
//! nodes are the outputs of which function; a [`Routine`] is how a function is computed: mostly one program, of long
//! chains several with loops around them (`loops`). [`Routines`] are all functions of a manipulator. Of
//! nodes that are equal `select` chooses those that take the fewest operations together, and `write` makes steps of them.

mod count;
mod description;
mod fuse;
mod loops;
mod order;
mod outputs;
mod rounding;
mod routine;
mod routines;
mod select;
mod step;
mod straight_line;
mod write;

pub use count::Operations;
pub use outputs::{results, straight_line};
pub use rounding::Rounded;
pub use routine::{Array, Block, Place, Repeated, Role, Routine, Row, Stage, Sums, Table};
pub use routines::Routines;
pub use step::{Action, Operand, Program, Step};
