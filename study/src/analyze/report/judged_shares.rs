//! Shares of the sources in the judged error.

use abbe::analysis::{ErrorDistribution, SourceErrors};

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
    /// Returns the shares of the sources of a budget in the error at a configuration.
    pub(in crate::analyze) fn new(
        distribution: &ErrorDistribution,
        by_worst_case: bool,
        factor_for_all: Option<f64>,
        sources: &[SourceErrors],
    ) -> Self {
        let shares = if by_worst_case { distribution.worst_case().shares } else { distribution.shares() };
        let of = |source: &SourceErrors| {
            let own = shares.iter().filter(|(of, _)| *of == source.source).map(|(_, share)| share);
            // Avoids −0.
            own.sum::<f64>() + 0.0
        };
        Self { factor_for_all, shares: sources.iter().map(of).collect() }
    }
}
