//! The options of monitoring.

use crate::options::Number;

/// Number of checks in which there is one false alarm on average.
pub const FALSE_ALARM: Number<usize> = Number { default: 365, range: 10..=100_000 };

/// How a machine is watched.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// On average one false alarm in so many checks, at most, over all charts together.
    pub checks_per_false_alarm: f64,
    /// The weight of a new check in a moving average.
    pub lambda: f64,
    /// How far the tool point may move from where it was at first, in the length unit; if not given, the largest error
    /// that the map accepts, if it says one.
    pub tolerance: Option<f64>,
}

impl Default for Settings {
    fn default() -> Self {
        let checks_per_false_alarm = FALSE_ALARM.default as f64;
        Self { checks_per_false_alarm, lambda: 0.2, tolerance: None }
    }
}
