//! A manipulator's spec file: read, checked, and as the rest of the pipeline sees it.
//!
//! [`Spec`] is what a file says once nothing is wrong with it. `declarations` reads the names, `frames` the
//! transforms, `sources`, `effects` and `loads` the physical errors; `rigid` shows that every matrix is a rigid motion.

mod declarations;
mod effects;
mod frames;
mod loads;
mod names;
mod read;
mod rigid;
mod sources;
mod types;

pub use types::{
    Beam, Cause, Class, Compliance, Component, Distribution, Effect, Factor, Frame, Input, Load, Matrix,
    Orientation, Parameter, Source, Spec, Variable, VariableKind,
};
