//! A manipulator as described by its spec file, read and checked.
//!
//! [`Spec`] is the contents of a valid file; `read` creates it from the text.

mod chain_number;
mod closure;
mod covariance;
mod declared;
mod fitted;
mod frame;
mod load;
mod names;
mod read;
mod source;
mod spec;
mod tree;
mod tunable;

pub use chain_number::{ChainNumber, DhConvention, DhNumber};
pub use closure::{Closure, Loop};
pub use covariance::{Covariance, Identified};
pub use declared::{Input, Parameter, Variable};
pub use fitted::Fitted;
pub use frame::{Factor, Frame, Matrix};
pub use load::{Axes, Load, Point};
pub use names::{as_identifier, check_name};
pub use read::keys::{TABLES, rules};
pub use source::{Beam, Cause, Compliance, Deviation, DeviationCause, Effect, Magnitude, Source, Uncertain};
pub use spec::Spec;
pub use tree::Tree;
pub use tunable::MAGNITUDE;
