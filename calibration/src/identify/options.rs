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
    /// Prior standard deviations about zero, by index of the unknown; flat where there is none, see
    /// [`Model::priors`](super::Model::priors).
    ///
    /// With priors, all unknowns are fitted. If empty, those that the data cannot distinguish from
    /// others are fixed at zero.
    pub priors: Vec<Option<f64>>,
    /// Indices of unknowns whose priors are known up to a common factor, which the data choose.
    pub scaled: Vec<usize>,
    /// Largest number of iterations.
    pub steps: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self { at: Vec::new(), loss: Loss::Squares, priors: Vec::new(), scaled: Vec::new(), steps: 100 }
    }
}
