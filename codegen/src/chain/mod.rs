//! From a spec to the nodes of everything that is generated: poses, Jacobians, generalized errors.
//!
//! `walk` goes along the chain factor by factor and keeps every frame's pose in `F_0`; `error_jacobian` (with
//! `moments`) and
//! `symbol_jacobian` read their columns off these poses by the structured product rule; `rows` turns a small
//! rotation into rows 4–6; `sources` gives ε. [`Model`] holds the results.

mod error_jacobian;
mod model;
mod moments;
mod rows;
mod sources;
mod symbol_jacobian;
mod walk;

pub use model::{Jacobian, Model};
pub use sources::EffectNode;
pub use walk::transform;
