//! Describes a manipulator: a TOML file, read and checked.
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
//! A [`document`] is a file with the location of every item, and [`expr`] has its expressions with
//! units and dimensions. A [`Spec`] is the contents of a valid file, and a [`diagnostic`] describes
//! a mistake. No later stage can fail. Files of other kinds (studies, maps, plans) are read by the
//! same means.
//!
//! Later crates report by [`mistake`] and [`notes`], and show values by [`number`].

pub mod bounded;
pub mod csv_writer;
pub mod degrees;
pub mod diagnostic;
pub mod document;
pub mod edit;
pub mod expr;
pub mod keys;
pub mod literal;
pub mod mistake;
pub mod notes;
pub mod number;
pub mod option;
pub mod value;
pub mod visible;

mod kind;
mod manipulator;
mod not_toml;

pub use diagnostic::{Diagnostic, Diagnostics};
pub use document::{Document, Item, Section};
pub use expr::{Dimension, Elementary, Expression, Function, Lookup, Motion, Symbol, Table, motion};
pub use manipulator::{
    Axes, Beam, Cause, ChainNumber, Closure, Compliance, Covariance, Deviation, DeviationCause, DhConvention,
    DhNumber, Effect, Factor, Fitted, Frame, Identified, Input, Load, Loop, MAGNITUDE, Magnitude, Matrix,
    Parameter, Point, Source, Spec, Tree, Uncertain, Variable, as_identifier, check_name, rules, tables,
};
pub use notes::Notes;
