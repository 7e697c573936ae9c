//! From a spec to the nodes of everything that is generated: poses, Jacobians, generalized errors.
//!
//! `walk` goes along the chain factor by factor and keeps every frame's pose in `F_0`; `error_jacobian` (with
//! `moments`) and `symbol_jacobian` read their columns off these poses by the structured product rule; `rows` turns a
//! small rotation into rows 4–6; `sources` gives ε, with `deviation` for errors of joints and parameters and `elastic`
//! for what gives way under loads. The other way, `accumulate` goes from the tip to the base over the
//! `local` motions and takes in every frame's errors: `displacement`, `covariance`, `by_source`, and `magnitudes`, whose
//! largest values are sought. `real` is the exact chain with errors, `remainder` what first order leaves out of it, `joint_step` (by `minors`) what takes
//! the errors back to first order, and `residual` what is left then; `dexterity` is how far joints move the tool (`joint_columns`), and `tool_compliance` how far a force does. [`Model`]
//! holds the results. What else leads to the same, `ways` and `moving` state: a program takes what needs the fewest operations.

mod accumulate;
mod by_source;
mod covariance;
mod deviation;
mod dexterity;
mod displacement;
mod elastic;
mod error_jacobian;
mod joint_columns;
mod joint_step;
mod local;
mod local_twist;
mod lower_pairs;
mod magnitudes;
mod minors;
mod model;
mod moments;
mod moving;
mod real;
mod remainder;
mod residual;
mod rows;
mod six;
mod sources;
mod symbol_jacobian;
mod tool_compliance;
mod walk;
mod ways;

pub(crate) use accumulate::Accumulated;
pub(crate) use covariance::Covariance;
pub use deviation::{FrameTwist, frame_twists, joint_twist};
pub use dexterity::Dexterity;
pub(crate) use displacement::Displacement;
pub(crate) use error_jacobian::Columns;
pub(crate) use local::Local;
pub use local_twist::LocalTwist;
pub(crate) use lower_pairs::lower_pairs;
pub use magnitudes::{Apart, Magnitude, Magnitudes};
pub(crate) use model::is_long;
pub use model::{Jacobian, Model};
pub(crate) use real::displaced;
pub use remainder::Remainder;
pub use residual::Residual;
pub(crate) use rows::Rows;
pub use sources::{EffectNode, effects};
pub(crate) use symbol_jacobian::swing;
pub use tool_compliance::ToolCompliance;
pub use walk::transform;
