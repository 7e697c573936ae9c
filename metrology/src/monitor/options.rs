//! Options of monitoring.

use abbe_study::options::NumericOption;

/// Mean number of checks between false alarms.
pub const FALSE_ALARM: NumericOption<usize> = NumericOption { default: 365, range: 10..=100_000 };

/// Settings of monitoring.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// Smallest mean number of checks between false alarms, over all charts together.
    pub checks_per_false_alarm: f64,
    /// Weight of a new check in a moving average.
    pub lambda: f64,
    /// Largest permitted displacement of the tool point from its initial position, in the length
    /// unit. If none, the largest error that the map accepts, if there is one.
    pub tolerance: Option<f64>,
}

impl Default for Settings {
    fn default() -> Self {
        Self { checks_per_false_alarm: FALSE_ALARM.default as f64, lambda: 0.2, tolerance: None }
    }
}
