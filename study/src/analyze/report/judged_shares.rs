//! Shares of the sources in the judged error.

use abbe::analysis::ErrorDistribution;

/// Shares of the sources in the judged error: of the judged machine, at the configuration of its
/// verdict.
#[derive(Clone, Debug)]
pub(in crate::analyze) struct JudgedShares {
    /// Factor for all sources at which this error of the machine as built equals the tolerance;
    /// `None` without a tolerance or an error, or if a probability or yield is judged.
    pub(in crate::analyze) factor_for_all: Option<f64>,
    /// Share of each source, in the order of the budget.
    pub(in crate::analyze) shares: Vec<f64>,
}

impl JudgedShares {
    /// Returns the shares in the error at a configuration. A calibration is the last source.
    pub(in crate::analyze) fn new(
        distribution: &ErrorDistribution,
        by_worst_case: bool,
        factor_for_all: Option<f64>,
        sources: usize,
    ) -> Self {
        let shares = if by_worst_case { distribution.worst_case().shares } else { distribution.shares() };
        let mut sums = vec![0.0; sources];
        for (source, share) in shares {
            if let Some(sum) = sums.get_mut(source.min(sources.saturating_sub(1))) {
                // Avoids −0.
                *sum += share + 0.0;
            }
        }
        Self { factor_for_all, shares: sums }
    }
}
