//! Rust: generic over the scalar, arrays by reference, and checked functions by the macros of `abbe`.
//!
//! `functions` prints routines, `operators` what expressions are made of; `face` is what users of a module see; `module`
//! puts them together.

mod face;
mod functions;
mod literal;
mod module;
mod operators;
mod tables;

pub use module::module;
