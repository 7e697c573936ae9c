//! Monitors a machine with repeated checks and detects changes.
//!
//! `checks` are the files in chronological order, `configurations` the configurations they visit
//! and the rows of one check, and `check_values` the measurements and their derivatives.
//! `single_errors` are the errors that may have changed, and `charts` monitor each of them with one
//! false-alarm rate for all. `finding` estimates what has changed, since when and how fast. `job`
//! runs the evaluation with its `options` and returns the report.

mod charts;
mod check_values;
mod checks;
mod configurations;
mod finding;
mod job;
pub mod options;
mod single_errors;
mod vectors;

pub use charts::{Chart, Limit};
pub use checks::{Check, Checks};
pub use finding::{Exceedance, Finding};
pub use job::{Alarm, Monitor, Report};
pub use options::Settings;
