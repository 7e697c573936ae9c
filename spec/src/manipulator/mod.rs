//! A manipulator as described by its spec file, read and checked.
//!
//! [`Spec`] is the contents of a valid file; `read` creates it from the text.

mod frame;
mod names;
mod read;
mod source;
mod spec;
mod tree;

use names::{check_identifier, check_manipulator_name, read_title};

pub use frame::{ChainNumber, DhConvention, DhNumber, Factor, Frame, Matrix};
pub use names::{as_identifier, check_name};
pub use read::keys::{rules, tables};
pub use source::{
    Axes, Beam, Cause, Compliance, Covariance, Deviation, DeviationCause, Effect, Identified, Load,
    Magnitude, Point, Source, Uncertain,
};
pub use spec::{Fitted, Input, MAGNITUDE, Parameter, Spec, Variable};
pub use tree::{Closure, Loop, Tree};
