//! Control charts for a machine that is checked repeatedly.
//!
//! [`SelfStarting`] transforms the numbers of a series with unknown mean and standard deviation to
//! standard normal numbers without a reference period. [`ewma_limit`] returns the alarm limit of
//! their exponentially weighted moving average for a given run length. [`Change::fit`] estimates
//! the time, kind and size of a drift or jump, each with its uncertainty.

mod change;
mod ewma;
mod self_starting;

#[cfg(test)]
mod tests;

pub use change::{Change, Kind};
pub use ewma::{ewma_limit, ewma_run_length};
pub use self_starting::{SelfStarting, normal_quantile};
