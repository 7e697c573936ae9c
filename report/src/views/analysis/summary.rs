//! Summary in a few sentences: the largest error, its main sources, and the worst configuration.

use super::conclusions::show;
use abbe_study::analyze::{Ledger, LedgerEntry, Report};
use abbe_study::number::{self, percent, unbroken};
use abbe_study::study_file::Criterion;

/// Number of sources that are named.
const NAMED: usize = 3;

/// Returns sentences on the largest combined error and the sources that cause most of it; empty
/// if there is no error.
pub(super) fn summary(report: &Report) -> Vec<String> {
    let Ledger { sources, sums: [.., by_squares, worst_case] } = &report.ledger;
    let all = match report.study.criterion {
        Criterion::RootSumOfSquares => by_squares,
        _ => worst_case,
    };
    if sources.is_empty() || all.max == 0.0 {
        return Vec::new();
    }
    let share = match report.position_tolerance {
        Some(tolerance) => format!(
            ", {} of the tolerance of {}",
            percent(all.max, tolerance),
            number::length(tolerance, report.spec.length)
        ),
        None => String::new(),
    };
    let bounds = match (report.combined.radii.random_radius, report.study.criterion) {
        (0.0, _) => "",
        (_, Criterion::RootSumOfSquares) => ", random sources at their bounds by root sum of squares",
        _ => " over all signs",
    };
    let together =
        format!("Largest error{bounds}: {}{share}{}.", show(report, all.max), location(report, all));
    let name = |LedgerEntry { name, max, .. }: &LedgerEntry| format!("\"{name}\", {}", show(report, *max));
    let mut named = sources.iter().filter(|entry| entry.max > 0.0);
    let Some(first) = named.next() else { return vec![together] };
    let mut most = format!("Most of it: {}{}", name(first), location(report, first));
    for next in named.take(NAMED - 1) {
        most += &format!("; then {}", name(next));
    }
    vec![together, most + "."]
}

/// Returns `, at q1 = …`; empty without a worst configuration.
fn location(report: &Report, entry: &LedgerEntry) -> String {
    let worst = report.configuration(entry.configuration);
    worst.map(|worst| format!(", at {}", unbroken(&report.label(worst)))).unwrap_or_default()
}
