//! Hostile input: random valid specs, and damaged files.
//!
//! All randomness comes from [`Choices`]: from a seed in tests, from the bytes of a fuzzer.
//! `expressions` and `specs` create valid input, with names and texts chosen to break generated
//! code; `damage` corrupts any file.

mod choices;
mod damage;
mod expressions;
mod specs;

pub use choices::Choices;
pub use damage::{damaged, damaged_table};
pub use expressions::expression;
pub use specs::{plain_spec, spec};
