//! Which convention is it? Some rows of joints and poses, and the interpretation under which they are those of a spec.
//!
//! `columns` finds numbers in a file, `kinematics` evaluates the spec in parts, `alternatives` are the interpretations that the
//! search (`interpretations`) tries. `map_writer` writes the map of the one that is found, `corrected_spec` the spec where it
//! is about the spec; `job` is the way from the question to the `report`, whose answer `sentence` gives in words.

mod alternatives;
mod columns;
mod corrected_spec;
mod job;
mod kinematics;
mod map_writer;
mod report;
mod sentence;

pub use self::job::Doctor;
pub use self::report::{Finding, Report};
pub use crate::interpretations::{Change, Interpretation, PoseFormat};
