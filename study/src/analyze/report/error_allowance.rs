//! Inverse budget: the errors that a tolerance allows.

use abbe::analysis::{Budget, ErrorDistribution, Measurand, WorstCase};
use abbe_spec::Spec;
use serde::Serialize;

/// Errors that a tolerance allows, as factors of the present errors.
#[derive(Clone, Debug, Serialize)]
pub struct ErrorAllowance {
    /// Factor for all sources at which the judged error as built equals the tolerance; `None` if
    /// there is no error, or if a probability or yield is judged.
    pub together: Option<f64>,
    /// Allowances of the sources, largest share first.
    pub sources: Vec<SourceAllowance>,
}

/// Errors that a tolerance allows one source.
#[derive(Clone, Debug, Serialize)]
pub struct SourceAllowance {
    /// Name of the source.
    pub name: String,
    /// Factor if there were no other source; `None` if it causes no error.
    pub alone: Option<f64>,
    /// Share of the source in the judged error at its place; negative if it counteracts the others.
    pub share: f64,
    /// Decrease of the judged error there if the source is reduced by one percent, in the
    /// tolerance's unit.
    pub gain_per_percent: f64,
}

impl ErrorAllowance {
    /// Inverts a budget for a tolerance of a measurand.
    pub(in crate::analyze) fn new(
        budget: &Budget,
        spec: &Spec,
        judged: &JudgedShares,
        (measurand, tolerance): (Measurand, f64),
    ) -> Self {
        let (sources, _) = budget.errors(measurand);
        let scale = |norm: f64| (norm > 0.0).then(|| tolerance / norm).filter(|scale| scale.is_finite());
        let sources = spec.enabled_sources().zip(sources).zip(&judged.shares);
        let sources = sources.map(|((source, errors), share)| SourceAllowance {
            name: source.name.clone(),
            alone: scale(errors.plain_max.norm),
            share: *share,
            // Avoids −0.
            gain_per_percent: 0.01 * share * judged.error + 0.0,
        });
        let mut sources: Vec<SourceAllowance> = sources.collect();
        sources.sort_by(|a, b| b.share.abs().total_cmp(&a.share.abs()));
        Self { together: judged.as_built.and_then(scale), sources }
    }
}

/// Shares of the sources in the judged error: of the judged machine, at the configuration of its
/// verdict.
#[derive(Clone, Debug)]
pub(in crate::analyze) struct JudgedShares {
    /// The error.
    pub(in crate::analyze) error: f64,
    /// Largest such error of the machine as built; `None` if a probability or yield is judged.
    pub(in crate::analyze) as_built: Option<f64>,
    /// Share of each source, in the order of the budget.
    pub(in crate::analyze) shares: Vec<f64>,
}

impl JudgedShares {
    /// Returns the shares in the error at a configuration. A calibration is the last source.
    pub(in crate::analyze) fn new(
        distribution: &ErrorDistribution,
        by_worst_case: bool,
        as_built: Option<f64>,
        sources: usize,
    ) -> Self {
        let (error, shares) = match by_worst_case {
            true => {
                let WorstCase { norm, shares } = distribution.worst_case();
                (norm, shares)
            }
            false => (distribution.radius(), distribution.shares()),
        };
        let mut sums = vec![0.0; sources];
        for (source, share) in shares {
            if let Some(sum) = sums.get_mut(source.min(sources.saturating_sub(1))) {
                *sum += share;
            }
        }
        Self { error, as_built, shares: sums }
    }
}
