//! The ledger: the sources by rank, then their sums.

use abbe::analysis::{Budget, Extreme};
use serde::Serialize;

use super::source_report::SourceReport;
use crate::number;

/// Norms of the position error, in the length unit.
#[derive(Clone, Debug, Serialize)]
pub struct Ledger {
    /// The sources, the largest first.
    pub sources: Vec<LedgerEntry>,
    /// Sums over the sources: repeatable, random, all together, worst case.
    pub sums: [LedgerEntry; 4],
}

/// A source, or a sum over the sources.
#[derive(Clone, Debug, Serialize)]
pub struct LedgerEntry {
    /// Its name.
    pub name: String,
    /// The largest norm.
    pub max: f64,
    /// Root mean square over the configurations; the worst case has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rms: Option<f64>,
    /// The largest norm as a share of the tolerance.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub share_of_tolerance: Option<f64>,
    /// Class of a source.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub class: Option<&'static str>,
    /// Rank of a source by its largest norm, 1 for the largest.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rank: Option<usize>,
    /// Index of the configuration with the largest norm.
    #[serde(skip)]
    pub configuration: Option<usize>,
}

impl Ledger {
    /// Ranks the sources of a budget.
    pub(in crate::analyze) fn new(budget: &Budget, sources: &[SourceReport], tolerance: Option<f64>) -> Self {
        let entry = |name: &str, largest: Extreme, rms| LedgerEntry {
            name: name.to_owned(),
            max: largest.value,
            rms,
            share_of_tolerance: tolerance.map(|tolerance| largest.value / tolerance),
            class: None,
            rank: None,
            configuration: largest.configuration,
        };
        let ranked = sources.iter().zip(&budget.sources).zip(budget.ranks());
        let ranked = ranked.map(|((source, errors), rank)| {
            let largest = Extreme { value: errors.plain_max.norm, configuration: errors.worst };
            let (class, _) = number::class(errors.class);
            LedgerEntry {
                class: Some(class),
                rank: Some(rank),
                ..entry(&source.name, largest, Some(errors.rms))
            }
        });
        let mut ranked = ranked.collect::<Vec<_>>();
        ranked.sort_by_key(|entry| entry.rank);
        let combined = &budget.combined;
        let [repeatable, random, both] = combined.rms.map(Some);
        Self {
            sources: ranked,
            sums: [
                entry("repeatable, with signs", combined.repeatable_radius, repeatable),
                entry("random, root sum of squares", combined.random_radius, random),
                entry("all together", combined.radius, both),
                entry("worst case, all norms added", combined.worst_case_radius, None),
            ],
        }
    }
}
