//! The ledger, for machines.

use serde::Serialize;

use super::super::ledger;
use super::super::report::Report;

#[derive(Serialize)]
pub(super) struct Ledger<'a> {
    sources: Vec<Entry<'a>>,
    sums: Vec<Entry<'a>>,
}

#[derive(Serialize)]
struct Entry<'a> {
    name: &'a str,
    max: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    rms: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    share_of_tolerance: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    class: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rank: Option<usize>,
}

pub(super) fn of<'a>(report: &'a Report) -> Ledger<'a> {
    let entry = |entry: ledger::Entry<'a>| Entry {
        name: entry.name,
        max: entry.largest.value,
        rms: entry.rms,
        share_of_tolerance: report.study.tolerance.map(|tolerance| entry.largest.value / tolerance),
        class: entry.source.map(|(class, _)| class),
        rank: entry.source.map(|(_, rank)| rank),
    };
    Ledger {
        sources: ledger::sources(report).into_iter().map(entry).collect(),
        sums: ledger::sums(report).into_iter().map(entry).collect(),
    }
}
