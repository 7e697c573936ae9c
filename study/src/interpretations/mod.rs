//! Are these rows read as they are meant? One search answers that where nothing is stated (`doctor`) and where a map states how a
//! file is to be read (`identify`, `measure`, `monitor`).
//!
//! An `interpretation` is units, a `pose_format` and `change`s. `joints` applies it to the columns of joints, `observed` to what was
//! measured. `search` computes the `residual` of each, with zeros (`zeros`), base and tool (`registration`) fitted in closed form;
//! `ranked` keeps those that nothing simpler explains; `words` states them and asks for them.

mod change;
mod interpretation;
mod joints;
mod observed;
mod pose_format;
mod ranked;
mod registration;
mod residual;
mod search;
pub(crate) mod words;
mod zeros;

pub use change::Change;
pub use interpretation::Interpretation;
pub(crate) use joints::{LENGTHS, Length, angle, configurations, joint_values};
pub(crate) use observed::{Observed, changed, mirrored};
pub use pose_format::PoseFormat;
pub(crate) use ranked::{Ranked, ranked};
pub(crate) use search::{Candidate, Chain, MOST, Parts, Search, Tolerance, Trial};
