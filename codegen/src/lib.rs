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
//! The path of a spec, which `abbe_spec` reads and checks, through this crate: `chain` builds the nodes of a `graph`, `program` puts
//! them in order, `print` writes Rust or another language.

pub mod chain;
pub mod graph;
pub mod print;
pub mod program;

mod compile;

pub use compile::{CompileError, compile, compile_into};
