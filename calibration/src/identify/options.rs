//! Options of a fit.

use super::Loss;

/// Options of a fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Point at which the information matrix is evaluated; the nominal machine, zero, if empty.
    ///
    /// A target exactly on the last axis hides more unknowns than a real one beside it, so the
    /// solution for base and tool alone is a good choice.
    pub at: Vec<f64>,
    /// Loss function of the residuals.
    pub loss: Loss,
    /// Prior standard deviations about zero, by index of the unknown; none without a prior.
    pub priors: Vec<Option<f64>>,
    /// Expected sizes of the unknowns, see [`Model::expected`](super::Model::expected).
    ///
    /// Unknowns that the data determine worse than that are fixed at zero. If empty, the fit
    /// includes every direction with nonzero information.
    pub expected: Vec<Option<f64>>,
    /// Factor of the stated uncertainty in decisions on identifiability.
    pub noise: f64,
    /// Bounds, by index of the unknown.
    pub bounds: Vec<Option<[f64; 2]>>,
    /// Largest number of iterations.
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
