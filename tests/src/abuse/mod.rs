//! Input that nobody would write: random specs that are right, and files with damage.
//!
//! Everything is drawn from [`Choices`]: from a seed in tests, from the bytes of a fuzzer there. `expressions` and `specs`
//! make what is right, with names and texts chosen to break generated code; `damage` takes any file and spoils it.

mod choices;
mod damage;
mod expressions;
mod specs;

pub use choices::Choices;
pub use damage::{damaged, damaged_table};
pub use expressions::expression;
pub use specs::{plain_spec, spec};
