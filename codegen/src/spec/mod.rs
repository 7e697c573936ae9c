//! A manipulator's spec file: read, checked, and as the rest of the pipeline sees it.
//!
//! [`Spec`] is what a file says once nothing is wrong with it. `declarations` reads the names, `frames` the
//! transforms, `sources` the physical errors; `rigid` shows that every matrix is a rigid motion.

mod declarations;
mod frames;
mod names;
mod read;
mod rigid;
mod sources;
mod types;

pub use types::{
    Class, Component, Distribution, Effect, Factor, Frame, Input, Matrix, Orientation, Parameter, Source,
    Spec, Variable, VariableKind,
};
