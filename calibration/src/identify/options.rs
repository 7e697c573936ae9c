//! How a fit is done.

use super::Loss;

/// How a fit is done.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Where it is judged what can be known; at zero, the nominal machine, if empty.
    ///
    /// A target exactly on the last axis hides more than one that is off it by as little as a real one is: the
    /// solution for base and tool alone is a good place.
    pub at: Vec<f64>,
    /// What a residual costs.
    pub loss: Loss,
    /// A standard deviation about zero for some unknowns, by index; none where nothing is known before.
    pub priors: Vec<Option<f64>>,
    /// What is expected of the unknowns, see [`Model::expected`](super::Model::expected): what the data tell worse than that
    /// is held at zero. If empty, everything is fitted that the data tell at all.
    pub expected: Vec<Option<f64>>,
    /// How many times the stated uncertainty the data are worth, when it is judged what they tell: 1 if they are as good.
    pub noise: f64,
    /// The bounds of some unknowns, by index.
    pub bounds: Vec<Option<[f64; 2]>>,
    /// The most steps.
    pub steps: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            at: Vec::new(),
            loss: Loss::Squares,
            priors: Vec::new(),
            expected: Vec::new(),
            noise: 1.0,
            bounds: Vec::new(),
            steps: 100,
        }
    }
}
