//! Rates of false alarms, weights and tolerances.

/// How a machine is watched.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// On average one false alarm in so many checks, at most, over all charts together.
    pub checks_per_false_alarm: f64,
    /// The weight of a new check in a moving average.
    pub lambda: f64,
    /// How far the tool point may move from where it was at first. The length unit.
    pub tolerance: Option<f64>,
}

impl Default for Settings {
    fn default() -> Self {
        Self { checks_per_false_alarm: 365.0, lambda: 0.2, tolerance: None }
    }
}
