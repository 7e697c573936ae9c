//! From a manipulator's spec file to its closed-form error Jacobian, as Rust.
//!
//! In your build script, for every spec in a folder:
//!
//! ```no_run
//! abbe_codegen::compile("specs");
//! ```
//!
//! and in your library `abbe::include_manipulators!();`. The macro `abbe_macro::manipulator!("specs/arm.toml")`
//! needs no build script, but generates anew whenever the crate is compiled; the command `abbe generate` writes
//! the file once, for crates that want nothing of this at build time. All three give the same code.
//!
//! The path of a spec through this crate: `spec` reads and checks it (with `expr`, and `diagnostic` for what is
//! wrong), `chain` builds the nodes of a `graph`, `program` puts them in order, `print` writes Rust or another language.

pub mod bounded;
pub mod cell;
pub mod chain;
pub mod diagnostic;
pub mod document;
pub mod expr;
pub mod graph;

pub mod keys;
pub mod print;
pub mod program;
pub mod spec;

mod compile;
mod kind;
mod not_toml;

pub use compile::{CompileError, compile, compile_into};
