//! A manipulator's spec file: read, checked, and as the rest of the pipeline sees it.
//!
//! [`Spec`] is what a file says once nothing is wrong with it. `declarations` reads the names, `frames` the
//! transforms, `sources`, `effects`, `elastic`, `deviations` and `loads` the physical errors; `positive` checks the signs of masses and
//! stiffnesses, `rigid` that every matrix is a rigid motion, `lower_pairs` finds out which frames are plain joints.

mod covariance;
mod declarations;
mod describe;
mod deviations;
mod effects;
mod elastic;
mod fitted;
mod frames;
mod keys;
mod loads;
mod lower_pairs;
mod names;
mod points;
mod positive;
mod read;
mod rigid;
mod sources;
mod tables;
mod tunable;
mod types;

pub use abbe_core::{Class, Component, Distribution, LengthUnit, Orientation, VariableKind};
pub use covariance::{Covariance, Identified};
pub use fitted::Fitted;
pub use keys::TABLES;
pub use names::as_identifier;
pub use tunable::MAGNITUDE;
pub use types::{
    Axes, Beam, Cause, ChainNumber, Compliance, Deviation, DhConvention, DhNumber, Effect, Factor, Frame,
    Input, Load, Magnitude, Matrix, Parameter, Point, Source, Spec, Variable,
};
