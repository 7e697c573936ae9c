//! Certified upper bounds of norms, beside sampled ones.

use abbe_study::analyze::{NOT_CERTIFIED, NormComparison, Report};
use abbe_study::number::{self, unbroken};

use crate::document::Table;
use crate::unit::decimals;

/// Returns the table of sampled and certified norms; `None` if nothing is certified.
pub(super) fn norm_comparison_table(report: &Report) -> Option<Table> {
    let decimals = decimals(report);
    let row = |NormComparison { sources, sampled, bound }: NormComparison| {
        let certified = bound.certified.map(|certified| number::rounded_up(certified, decimals));
        let place = if bound.label.is_empty() { "home" } else { &bound.label };
        vec![
            sources.to_owned(),
            sampled.map(|sampled| number::fixed(sampled, decimals)).unwrap_or_default(),
            number::rounded_down(bound.found, decimals),
            certified.unwrap_or_else(|| "not known".to_owned()),
            unbroken(place),
        ]
    };
    let rows: Vec<Vec<String>> = report.norm_comparisons().into_iter().map(row).collect();
    let found = if report.box_exceeds_workspace() { "found in the box" } else { "at least" };
    let header = ["norm of", "sampled", found, "at most", "found at"];
    if rows.is_empty() { None } else { Some(Table::listing(&header, rows, 1..4)) }
}

/// Returns a sentence with the certified norms; `None` if nothing is certified of a chain.
pub(super) fn certified_norms(report: &Report) -> Option<String> {
    if !report.spec.is_serial() {
        return Some(format!("Certified: nothing; {NOT_CERTIFIED}."));
    }
    let unit = report.spec.length.symbol();
    let compared =
        report.norm_comparisons().into_iter().filter_map(|NormComparison { sources, sampled, bound }| {
            let certified = number::rounded_up(bound.certified?, decimals(report));
            let sampled =
                sampled.map(|sampled| format!(" ({} sampled)", number::fixed(sampled, decimals(report))));
            Some(format!("{certified} {unit} of {sources}{}", sampled.unwrap_or_default()))
        });
    let compared: Vec<String> = compared.collect();
    (!compared.is_empty()).then(|| {
        format!(
            "Certified, to first order: over {} the norm is at most {}.",
            certified_domain(report),
            compared.join(", ")
        )
    })
}

/// Describes the domain over which the certified norms hold.
fn certified_domain(report: &Report) -> &'static str {
    match report.box_exceeds_workspace() {
        true => "the enclosing joint box, which is larger than the workspace,",
        false => "the whole box of the workspace",
    }
}
