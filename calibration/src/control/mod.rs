//! Control charts: whether a machine that is checked again and again is still what it was, and since when not.
//!
//! [`SelfStarting`] makes numbers of a series standard normal that have an unknown mean and standard deviation, without a
//! reference period; [`ewma_limit`] is where an exponentially weighted moving average of such numbers alarms, from the run
//! length that is wanted; [`Change::fit`] says since when a series drifts or whether it jumped, and how fast, each with its uncertainty.

mod change;
mod distributions;
mod ewma;
mod self_starting;

#[cfg(test)]
mod tests;

pub use change::{Change, Kind};
pub use distributions::{normal_quantile, student_quantile, student_tails};
pub use ewma::{ewma_limit, ewma_run_length};
pub use self_starting::SelfStarting;
