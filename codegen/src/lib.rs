//! Generates the closed-form error Jacobian of a manipulator as Rust code from its spec file.
//!
//! In your build script, for every spec in a folder:
//!
//! ```no_run
//! abbe_codegen::compile("specs");
//! ```
//!
//! and in your library `abbe::include_manipulators!();`. The macro
//! `abbe_macro::manipulator!("specs/arm.toml")` needs no build script but generates the code each
//! time the crate is compiled. The command `abbe generate` writes the file once, for crates that
//! want no build-time dependency. All three generate the same code.
//!
//! `abbe_spec` reads and checks the spec. In this crate, `chain` builds the nodes of a `graph`,
//! `program` puts them in order, and `print` writes Rust or another language. `procedure` describes
//! algorithms with loops and branches, which are the same for every manipulator.

pub mod chain;
pub mod graph;
pub mod print;
pub mod procedure;
pub mod program;

mod compile;

pub use compile::{CompileError, compile, compile_into};
