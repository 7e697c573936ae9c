//! Whether a machine that is checked again and again is still what it was.
//!
//! `checks` are the files in the order of their dates; `places` the configurations that they visit; `numbers` what is measured at
//! every check, and how it moves; `single_errors`
//! what may have changed; `charts` watch each of these, with one rate of false alarms for all; `finding` says what has changed, since
//! when and how fast. `job` is the way from the question and its `options` to the `report`.

mod charts;
mod checks;
mod finding;
mod job;
mod numbers;
pub mod options;
mod places;
mod report;
mod single_errors;
mod vectors;

pub use charts::{Chart, Limit};
pub use checks::{Check, Checks};
pub use finding::{Finding, Leaving};
pub use job::Monitor;
pub use options::Settings;
pub use report::{Alarm, Report};
