//! Searches the interpretation of rows that fits the nominal machine: without any statement
//! (`doctor`), or as a test of what a map states (`identify`, `measure`, `monitor`).
//!
//! An `interpretation` consists of units, a `pose_format` and `change`s. `joints` applies it to the
//! columns of joints, `observed` to the measurements. `search` computes the `pose_residual` of each
//! interpretation with zeros (`zeros`), base and tool (`registration`) fitted in closed form.
//! `ranked` selects those that no simpler one explains, and `words` describes them and formats
//! questions.

mod change;
mod interpretation;
mod joints;
mod observed;
mod pose_format;
mod pose_residual;
mod ranked;
mod registration;
mod search;
pub(crate) mod words;
mod zeros;

pub use change::Change;
pub(crate) use change::SIGNS;
pub use interpretation::Interpretation;
pub(crate) use joints::{LENGTHS, Length, angle, configurations, joint_values};
pub(crate) use observed::{Observed, changed, mirrored};
pub use pose_format::PoseFormat;
pub(crate) use ranked::{Ranked, ranked};
pub(crate) use search::{Candidate, Chain, MOST, Parts, Search, Tolerance, Trial};
