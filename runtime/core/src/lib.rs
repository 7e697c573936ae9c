//! Core types of `abbe`: scalars, poses, generalized errors, the exact chain, the compensator,
//! batches in lanes, and laws.
//!
//! Generated code and its users name the crate `abbe`, which re-exports everything here and
//! documents the conventions: units, frames, and the order of rows and columns. Without features
//! this crate is `no_std` and never allocates.
#![cfg_attr(not(feature = "std"), no_std)]

mod chain;
mod checked_functions;
pub mod checks;
pub mod compensator;
mod component;
mod description;
pub mod distinct;
#[cfg(feature = "std")]
mod drawn_pose;
mod error;
mod floats;
pub mod function;
mod manipulator;
#[cfg(feature = "nalgebra")]
mod nalgebra_views;
mod pose;
mod quantity;
// Without `lanes` only pairs of numbers use it.
#[cfg_attr(not(feature = "lanes"), allow(dead_code, unreachable_pub))]
mod register;
mod scalar;
mod shared;
#[doc(hidden)]
pub mod sin_cos;
mod source;
#[cfg(feature = "lanes")]
mod twist;
#[cfg(target_arch = "x86_64")]
mod x86;

#[cfg(feature = "lanes")]
pub mod lanes;
#[cfg(not(feature = "lanes"))]
#[doc(hidden)]
#[macro_export]
macro_rules! evaluate_functions {
    ($($any:tt)*) => {};
}
#[cfg(feature = "laws")]
pub mod laws;
#[cfg(feature = "laws")]
pub mod sampling;

#[cfg(test)]
extern crate self as abbe_core;

#[cfg(feature = "std")]
pub use chain::open_pose;
pub use chain::{
    chain, deviation, displacement, euler_margin, located, real_pose, rotation_vector, tool_pose,
};
pub use component::Component;
pub use description::{
    Branch, Description, Frame, Input, LengthUnit, Orientation, Parameter, SumLimit, Variable, VariableKind,
};
pub use distinct::ErrorColumns;
#[cfg(feature = "std")]
pub use drawn_pose::{drawn_pose, repeatable_magnitudes};
pub(crate) use error::Result;
pub use error::{Error, MINIMUM_MARGIN, Remedy};
pub use function::Function;

pub use manipulator::Manipulator;
#[cfg(feature = "nalgebra")]
pub use nalgebra_views::jacobian_view;
pub use pose::Pose;
pub use quantity::Quantity;
pub use scalar::{LookupTable, Scalar};
pub use shared::{List, Text};
pub use source::{Class, Distribution, Effect, Source, whole};
#[cfg(feature = "lanes")]
pub use twist::twist;

/// Includes every module that `abbe_codegen::compile` generated in this crate's build script.
///
/// ```ignore
/// // build.rs:   fn main() { abbe_codegen::compile("specs") }
/// abbe::include_manipulators!();
/// ```
#[macro_export]
macro_rules! include_manipulators {
    () => {
        include!(concat!(env!("OUT_DIR"), "/abbe_manipulators.rs"));
    };
}
