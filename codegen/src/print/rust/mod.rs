//! Rust: generic over the scalar, arrays by reference, and checked functions by macros of `abbe`.
//!
//! `functions` prints routines, `operators` prints expressions, `face` prints the public items of a
//! module, and `module` combines them.

mod face;
mod functions;
mod module;
mod operators;

pub use module::module;
