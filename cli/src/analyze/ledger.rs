//! The ledger: the sources in rows, their sums in the last ones.

use abbe::analysis::Extreme;

use super::{Analysis, json};
use crate::table::{Listing, unbroken};
use abbe_study::number::{self, fixed, percent};

/// One row: a source, or a sum over the sources. Norms of the position error, in the length unit.
pub(super) struct Entry<'a> {
    pub(super) name: &'a str,
    /// Of a source: its class, and its rank by the largest error, 1 for the largest.
    pub(super) source: Option<(&'static str, usize)>,
    pub(super) largest: Extreme,
    /// The root mean square over the configurations; the worst case has none.
    pub(super) rms: Option<f64>,
}

/// The sources in the order of the spec.
pub(super) fn sources<'a>(analysis: &'a Analysis) -> impl Iterator<Item = Entry<'a>> {
    let ranks = analysis.budget.ranks();
    analysis.budget.sources.iter().zip(ranks).map(|(errors, rank)| Entry {
        name: &analysis.description.sources[errors.source].name,
        source: Some((json::class(errors.class).0, rank)),
        largest: Extreme { value: errors.plain_max.norm, configuration: errors.worst },
        rms: Some(errors.rms),
    })
}

/// What they are together.
pub(super) fn sums(analysis: &Analysis) -> [Entry<'static>; 4] {
    let combined = &analysis.budget.combined;
    let [repeatable, random, both] = combined.rms.map(Some);
    [
        ("repeatable, with signs", combined.repeatable_radius, repeatable),
        ("random, root sum of squares", combined.random_radius, random),
        ("all together", combined.radius, both),
        ("worst case, all norms added", combined.worst_case_radius, None),
    ]
    .map(|(name, largest, rms)| Entry { name, source: None, largest, rms })
}

pub(super) fn listing(analysis: &Analysis) -> Listing {
    let tolerance = analysis.study.tolerance;
    let mut header = vec!["source", "max", "RMS", "rank", "worst at (the rest as at home)"];
    if tolerance.is_some() {
        header.insert(3, "of tolerance");
    }
    let mut rows = Vec::new();
    for Entry { name, source, largest, rms } in sources(analysis).chain(sums(analysis)) {
        let at = analysis
            .configuration(largest.configuration)
            .filter(|_| largest.value > 0.0)
            .map(|worst| number::configuration(&worst, analysis.workspace.home(), analysis.description))
            .map(|at| unbroken(&at));
        let show = |value| fixed(value, analysis.decimals());
        let mut cells = vec![
            name.to_owned(),
            show(largest.value),
            rms.map(show).unwrap_or_default(),
            source.map(|(_, rank)| rank.to_string()).unwrap_or_default(),
            at.unwrap_or_default(),
        ];
        if let Some(tolerance) = tolerance {
            cells.insert(3, percent(largest.value, tolerance));
        }
        rows.push(cells);
    }
    let numbers = 1..header.len() - 1;
    Listing { header, rows, numbers }
}
