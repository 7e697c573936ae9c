//! Terms that selection can add to a fit.

use super::Observation;

/// A term: an unknown of the model times a factor that changes from row to row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ModelTerm {
    /// Index of the unknown.
    pub unknown: usize,
    /// Index of the factor; none where it is 1.
    pub factor: Option<usize>,
}

/// Terms that [`select`](super::select()) can add.
pub struct CandidateTerms<'a> {
    /// Terms that the model already has, beside the unknowns kept by the fit.
    pub taken: &'a [ModelTerm],
    /// Groups of terms that are added together, such as the sine and cosine of a joint.
    pub groups: &'a [Vec<ModelTerm>],
    /// Computes the factors of an observation, in order.
    pub factors: &'a dyn Fn(&Observation) -> Vec<f64>,
    /// Significance level of the selection of the best group.
    pub chance: f64,
}
