//! The ledger: the sources in rows, their sums in the last ones.

use abbe::analysis::{Extreme, SourceErrors};

use super::report::Report;
use crate::listing::Listing;
use crate::number::{self, fixed, percent, unbroken};

/// One row: a source, or a sum over the sources. Norms of the position error, in the length unit.
pub struct Entry<'a> {
    /// What it is called.
    pub name: &'a str,
    /// Of a source: its class, and its rank by the largest error, 1 for the largest.
    pub source: Option<(&'static str, usize)>,
    /// The largest, and where.
    pub largest: Extreme,
    /// The root mean square over the configurations; the worst case has none.
    pub rms: Option<f64>,
}

/// The sources, the largest first.
pub(super) fn sources(report: &Report) -> Vec<Entry<'_>> {
    let entry = |(alone, rank): (&SourceErrors, usize)| Entry {
        name: &report.source(alone.source).name,
        source: Some((number::class(alone.class).0, rank)),
        largest: Extreme { value: alone.plain_max.norm, configuration: alone.worst },
        rms: Some(alone.rms),
    };
    let mut entries = report.budget.sources.iter().zip(report.budget.ranks()).map(entry).collect::<Vec<_>>();
    entries.sort_by_key(|entry| entry.source.map(|(_, rank)| rank));
    entries
}

/// What they are together.
pub(super) fn sums(report: &Report) -> [Entry<'static>; 4] {
    let combined = &report.budget.combined;
    let [repeatable, random, both] = combined.rms.map(Some);
    [
        ("repeatable, with signs", combined.repeatable_radius, repeatable),
        ("random, root sum of squares", combined.random_radius, random),
        ("all together", combined.radius, both),
        ("worst case, all norms added", combined.worst_case_radius, None),
    ]
    .map(|(name, largest, rms)| Entry { name, source: None, largest, rms })
}

/// The ledger as a table.
pub fn ledger(report: &Report) -> Listing {
    let tolerance = report.study.tolerance;
    let mut header = vec!["source", "max", "RMS", "rank", "worst at (the rest as at home)"];
    if tolerance.is_some() {
        header.insert(3, "of tolerance");
    }
    let mut rows = Vec::new();
    for Entry { name, source, largest, rms } in sources(report).into_iter().chain(sums(report)) {
        let at = report
            .configuration(largest.configuration)
            .filter(|_| largest.value > 0.0)
            .map(|worst| unbroken(&report.label(worst)));
        let show = |value| fixed(value, report.decimals());
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

/// What the tolerance allows each source, and what is gained by making it smaller.
pub fn allowed(report: &Report) -> Option<Listing> {
    let admissible = report.admissible.as_ref()?;
    let times = |scale: Option<f64>| {
        scale.map_or("any".to_owned(), |scale| format!("× {}", number::digits(scale, 3)))
    };
    let row = |source: usize| {
        vec![
            report.source(source).name.clone(),
            times(admissible.alone[source]),
            times(admissible.equal[source]),
            fixed(report.budget.gains[source], report.decimals() + 1),
        ]
    };
    let rows = report.budget.tighten_first().into_iter().map(row).collect();
    Some(Listing {
        header: vec!["source", "alone at most", "equal shares", "gain per percent"],
        rows,
        numbers: 1..4,
    })
}
