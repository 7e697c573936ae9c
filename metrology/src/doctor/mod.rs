//! Finds the convention of unknown data: the interpretation under which joints and poses agree with
//! a spec.
//!
//! `job` runs the search and fills the report. `columns` reads the data, `kinematics` evaluates
//! the spec in parts, and `alternatives` lists the interpretations that the search
//! (`interpretations`) tries. `map_writer` writes the map of the best interpretation,
//! `corrected_spec` the spec if it has to change.

mod alternatives;
mod columns;
mod corrected_spec;
mod job;
mod kinematics;
mod map_writer;

pub use crate::interpretations::{Change, Interpretation, PoseFormat};
pub use job::{Doctor, Finding, Report};
