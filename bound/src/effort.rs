//! How long a search goes on, and what it has proved meanwhile.

/// How much is done.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Ends when the certified value exceeds the found one by no more than this share of it.
    pub gap: f64,
    /// Ends after so many boxes.
    pub boxes: usize,
    /// What is known to be no less than the largest value; infinite if nothing is.
    pub at_most: f64,
}

impl Effort {
    /// 1 %, and 300,000 boxes.
    pub const DEFAULT: Self = Self { gap: 0.01, boxes: 300_000, at_most: f64::INFINITY };
}

impl Default for Effort {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// What is proved so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Found.
    pub found: f64,
    /// Certified.
    pub certified: f64,
    /// How many boxes were looked at.
    pub boxes: usize,
}
