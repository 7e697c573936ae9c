//! Builds the nodes of everything that is generated from a spec: poses, Jacobians, generalized
//! errors.
//!
//! `walk` follows the chain factor by factor and keeps every frame's pose in `F_0`.
//! `error_jacobian` (with `moments`) and `symbol_jacobian` read their columns off these poses by
//! the structured product rule; `rows` converts a small rotation to rows 4–6. `sources` gives ε,
//! with `deviation` for errors of joints and parameters and `elastic` for deflection under loads.
//! In the other direction, `accumulate` goes from the tip to the base over the `local` motions and
//! adds every frame's errors: `displacement`, `covariance`, `by_source`, and the `magnitudes` to be
//! maximized. `real` is the exact chain with errors and `remainder` its difference from first
//! order. `joint_step` (by `minors`) cancels the errors to first order, `compensation_residual` is
//! the error left after it. `inverse` solves for the joints in closed form. `dexterity` holds rows
//! of `J_q` (`joint_columns`), `tool_compliance` the displacement per force. `equivalent_forms` and
//! `origin_form` state alternative forms, from which a program takes the cheapest. `tree` builds
//! the same quantities for frames that branch, and for loops, whose unknowns are `implicit` where
//! they are to be enclosed. [`Model`] holds the results.

mod accumulate;
mod by_source;
mod compensation_residual;
mod covariance;
mod deviation;
mod dexterity;
mod elastic;
mod equivalent_forms;
mod error_jacobian;
mod frame_twist;
mod implicit;
mod inverse;
mod joint_columns;
mod kinematics;
mod local;
mod lower_pairs;
mod magnitudes;
mod minors;
mod model;
mod real;
mod remainder;
mod rows;
mod sources;
mod symbol_jacobian;
mod tool_compliance;
mod tree;
mod walk;

use accumulate::{Links, six, vectors};
use elastic::{Element, Loads};
use joint_columns::{JOINTS_OF_A_POINT, JOINTS_OF_A_POSE, at_tool, errors_of_joints, joint_step, units};
use real::RealChain;
use sources::{Causes, PlacedErrors, elastic_errors};

pub(crate) use accumulate::{Accumulated, Displacement};
pub use compensation_residual::CompensationResidual;
pub(crate) use covariance::Covariance;
pub use deviation::{frame_twists, joint_twist};
pub use dexterity::Dexterity;
pub(crate) use error_jacobian::Columns;
pub use frame_twist::FrameTwist;
pub use implicit::Implicit;
pub(crate) use local::Local;
pub(crate) use lower_pairs::lower_pairs;
pub use magnitudes::{DIRECTION, Magnitude, Magnitudes, PerFrameMagnitudes};
pub(crate) use model::is_long;
pub use model::{Jacobian, Model};
pub(crate) use real::displaced;
pub use remainder::Remainder;
pub(crate) use rows::Rows;
pub use sources::{DeviationNode, EffectNode, deviations, effects};
pub use symbol_jacobian::LocalTwist;
pub(crate) use symbol_jacobian::swing;
pub use tool_compliance::ToolCompliance;
pub use tree::LoopEquations;
pub(crate) use tree::{ClosedLoops, Path, RealNodes, STEPS, passive_by_symbol};
pub use walk::transform;
