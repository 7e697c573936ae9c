//! What a manipulator is: a TOML file, read and checked.
//!
//! ```
//! use abbe_spec::Spec;
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
//! assert_eq!(spec.frames[0].name, "carriage");
//! # Ok::<(), abbe_spec::diagnostic::Diagnostics>(())
//! ```
//!
//! A [`document`] is a file with the place of everything in it, and [`expr`] are the expressions in it, with units and
//! dimensions; a [`Spec`] is what the file says once nothing is wrong with it, and a [`diagnostic`] says what is. Nothing behind
//! it can fail. Files of other kinds (studies, maps, plans) are read with the same means.

pub mod bounded;
pub mod cell;
pub mod diagnostic;
pub mod document;
pub mod expr;
pub mod keys;
pub mod value;

mod kind;
mod manipulator;
mod not_toml;

pub use manipulator::{
    Axes, Beam, Cause, ChainNumber, Compliance, Covariance, Deviation, DhConvention, DhNumber, Effect,
    Factor, Fitted, Frame, Identified, Input, Load, MAGNITUDE, Magnitude, Matrix, Parameter, Point, Source,
    Spec, TABLES, Variable, as_identifier,
};
