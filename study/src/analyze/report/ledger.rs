//! The ledger: sources by rank, followed by their sums.
//!
//! Shares of the sources in the judged error.

use abbe::analysis::{Budget, ErrorDistribution, Extreme, SourceErrors};
use serde::Serialize;

use super::source_report::SourceReport;
use crate::{factors, number};

/// Ledger of the position errors: norms in the length unit.
#[derive(Clone, Debug, Serialize)]
pub struct Ledger {
    /// Sources, largest maximum first.
    pub sources: Vec<LedgerEntry>,
    /// Sums over the sources: repeatable, random, all, worst case.
    pub sums: [LedgerEntry; 4],
}

/// Row of the ledger: a source, or a sum over the sources. Norms are in the length unit.
#[derive(Clone, Debug, Serialize)]
pub struct LedgerEntry {
    /// Name of the source or sum.
    pub name: String,
    /// Largest norm over the workspace.
    pub max: f64,
    /// Root mean square of the norm over the configurations; `None` for the worst case.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rms: Option<f64>,
    /// Largest norm as a share of the tolerance, which the source alone would use up at one over
    /// this factor; `None` without a tolerance.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub share_of_tolerance: Option<f64>,
    /// Share of the source in the judged error at the configuration of the verdict, of which a
    /// source that is 1 % smaller takes 1 % away: negative if it counteracts the others; `None` for
    /// sums.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub share: Option<f64>,
    /// Factor with which, and with those of all other sources, the study keeps its tolerances; and
    /// with all smaller ones. `None` for sums, and if the study keeps them, is not judged as built
    /// by the worst case or the root sum of squares, or has more than 20,000 configurations.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub factor: Option<f64>,
    /// Class of the source; `None` for sums.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub class: Option<&'static str>,
    /// Rank of the source by its largest norm, 1 for the largest; `None` for sums.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rank: Option<usize>,
    /// Index of the configuration with the largest norm.
    #[serde(skip)]
    pub configuration: Option<usize>,
}

impl Ledger {
    /// Creates the ledger of a budget.
    pub(in crate::analyze) fn new(
        budget: &Budget,
        sources: &[SourceReport],
        tolerance: Option<f64>,
        judged: &JudgedShares,
        allocation: Option<&factors::Report>,
    ) -> Self {
        let entry = |name: &str, largest: Extreme, rms| LedgerEntry {
            name: name.to_owned(),
            max: largest.value,
            rms,
            share_of_tolerance: tolerance.map(|tolerance| largest.value / tolerance),
            share: None,
            factor: None,
            class: None,
            rank: None,
            configuration: largest.configuration,
        };
        let ranked = sources.iter().zip(&budget.sources).zip(&judged.shares);
        let ranked = ranked.map(|((source, errors), share)| {
            let largest = Extreme { value: errors.plain_max.norm, configuration: errors.worst };
            let (class, _) = number::class(errors.class);
            let allocated = allocation.iter().flat_map(|allocation| &allocation.sources);
            let mut allocated = allocated.filter(|allocated| allocated.source == source.name);
            LedgerEntry {
                share: Some(*share),
                factor: allocated.next().map(|allocated| factors::printed(allocated.factor)),
                class: Some(class),
                ..entry(&source.name, largest, Some(errors.rms))
            }
        });
        let mut ranked = ranked.collect::<Vec<_>>();
        ranked.sort_by(|a, b| b.max.total_cmp(&a.max));
        ranked.iter_mut().zip(1..).for_each(|(entry, rank)| entry.rank = Some(rank));
        let combined = &budget.combined;
        let [repeatable, random, both] = combined.rms.map(Some);
        Self {
            sources: ranked,
            sums: [
                entry("repeatable, with signs", combined.repeatable_radius, repeatable),
                entry("random, root sum of squares", combined.random_radius, random),
                entry("all together", combined.radius, both),
                entry("worst case over all signs", combined.worst_case_radius, None),
            ],
        }
    }
}

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
