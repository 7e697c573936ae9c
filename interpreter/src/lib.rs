//! Runs a spec without rustc: the same programs as the generated code, for a block of
//! configurations at a time.
//!
//! ```
//! use abbe::Manipulator;
//! use abbe_spec::Spec;
//! use abbe_interpreter::Interpreter;
//!
//! let spec = Spec::parse("slide.toml", r#"
//!     [manipulator]
//!     name = "slide"
//!     length = "mm"
//!     [[frame]]
//!     name = "carriage"
//!     variable = { name = "d1", kind = "prismatic" }
//!     transform = "Tx(d1)"
//! "#)?;
//! let slide = Interpreter::new(spec);
//! assert_eq!(slide.pose(&[12.0], &[])?.position(), [12.0, 0.0, 0.0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! `operation` groups the steps of a program in chains, each one operation on slots. `pack` builds
//! a tape of them, and `lanes` evaluates it.

mod interpreter;
mod lanes;
mod operation;
mod pack;

pub use interpreter::Interpreter;
