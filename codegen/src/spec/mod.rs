//! A manipulator's spec file: read, checked, and as the rest of the pipeline sees it.
//!
//! [`Spec`] is what a file says once nothing is wrong with it. `declarations` reads the names, `frames` the
//! transforms, `sources`, `effects`, `deviations` and `loads` the physical errors; `rigid` shows that every matrix is a rigid motion.

mod declarations;
mod describe;
mod deviations;
mod effects;
mod frames;
mod keys;
mod loads;
mod names;
mod read;
mod rigid;
mod sources;
mod types;

pub use abbe::{Class, Component, Distribution, LengthUnit, Orientation, VariableKind};
pub use keys::TABLES;
pub use types::{
    Beam, Cause, ChainNumber, Compliance, Deviation, DhConvention, DhNumber, Effect, Factor, Frame, Input,
    Load, Magnitude, Matrix, Parameter, Source, Spec, Variable,
};
