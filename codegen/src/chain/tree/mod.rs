//! Frames that branch, and loops: the quantities of a model by the structured rule.
//!
//! `view` holds the poses of the frames below one of them, and moves them; `closure` states the
//! equations φ of a loop and their rates under such motions. `factored` solves `φ_p x = b` in
//! straight-line code. `parts` eliminates the passive variables, and `model` gives the kinematics:
//!
//! ```text
//! φ(q, p, ε) = 0        δp = −φ_p⁻¹ (φ_ε ε + φ_q δq)        J_e = J_ε − J_p φ_p⁻¹ φ_ε
//! ```
//!
//! `triangular` sorts φ_p into irreducible blocks. `system` has the equations of a machine and
//! Newton's step, `units` closes it at home, `path` follows a path from there, and `loops`
//! has the systems of the nominal machine and with errors. `equations` has φ and φ_p themselves,
//! `lengths` converts errors of the lengths of legs to errors of frames, `reactions` has the
//! forces that close the loops of a loaded machine, and `curve` the tool point while errors grow.

mod closure;
mod factored;
mod loops;
mod parts;
mod path;
mod system;
mod units;
mod view;

pub(super) use closure::{add_lengths, length_slopes};
pub(super) use loops::curvature;
pub(crate) use loops::{ClosedLoops, RealNodes};
pub(super) use parts::Parts;
pub(crate) use parts::{Reaction, passive_by_symbol};
pub(crate) use path::{Path, STEPS};
pub use system::LoopEquations;
