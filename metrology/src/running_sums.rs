//! Sums of numbers that come one by one.

/// Running sums of numbers and of their squares, about the current mean (Welford, 1962).
#[derive(Clone, Copy, Default)]
pub(crate) struct RunningSums {
    pub(crate) count: f64,
    pub(crate) mean: f64,
    /// Sum of squares about the mean.
    pub(crate) about_mean: f64,
    squares: f64,
    /// Largest absolute value.
    pub(crate) max: f64,
}

impl RunningSums {
    pub(crate) fn add(&mut self, value: f64) {
        self.count += 1.0;
        let before = value - self.mean;
        self.mean += before / self.count;
        self.about_mean += before * (value - self.mean);
        self.squares += value * value;
        self.max = self.max.max(value.abs());
    }

    pub(crate) fn rms(&self) -> f64 {
        (self.squares / self.count.max(1.0)).sqrt()
    }
}
