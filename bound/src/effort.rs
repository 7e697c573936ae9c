//! Limits and progress of a search.

/// Termination criteria of a search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Relative gap between the certified and the found value at which the search ends.
    pub gap: f64,
    /// Number of boxes after which the search ends.
    pub boxes: usize,
    /// Number of evaluations of quadratic parts after which the search ends; a box takes up to six
    /// for each combination of its angles.
    pub samples: usize,
    /// Known upper bound of the largest value; infinite if there is none.
    pub at_most: f64,
    /// Value below which the search ends, because so little does not matter.
    pub nothing: f64,
}

impl Effort {
    /// A gap of 1 %, and 300,000 boxes.
    pub const DEFAULT: Self =
        Self { gap: 0.01, boxes: 300_000, samples: usize::MAX, at_most: f64::INFINITY, nothing: 0.0 };
}

impl Default for Effort {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// Caller of a search, which ends where this returns `false`.
pub type Watch<'w> = dyn FnMut(&Progress) -> bool + 'w;

/// Progress of a search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Largest value found so far.
    pub found: f64,
    /// Certified upper bound so far.
    pub certified: f64,
    /// Number of boxes examined.
    pub boxes: usize,
}
