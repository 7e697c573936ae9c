//! Sampled norms beside certified upper bounds.

use super::report::Report;
use crate::bound::{CertifiedNorms, ErrorBound};
use crate::listing::Listing;
use crate::number::{self, unbroken};

/// Largest norm of one kind of error: the sampled value and its certified upper bound.
pub struct NormComparison<'a> {
    /// Name of the sources that cause it, for display.
    pub sources: &'static str,
    /// Largest ‖ΔX‖ of the position among the sampled configurations, in the length unit.
    pub sampled: f64,
    /// Certified upper bound over the enclosing box of the workspace, in the length unit.
    pub bound: &'a ErrorBound,
}

impl Report {
    /// Returns the sampled and certified norms of each kind of source that the spec has; empty if
    /// nothing is certified.
    pub fn norm_comparisons(&self) -> Vec<NormComparison<'_>> {
        let Some(CertifiedNorms { repeatable, random, radius, .. }) = &self.certified else {
            return Vec::new();
        };
        let radii = &self.combined.radii;
        let kinds = [
            ("the repeatable sources", radii.repeatable_radius, repeatable),
            ("the random sources", radii.random_radius, random),
            ("all sources together", radii.radius, radius),
        ];
        let compared = kinds.into_iter().filter_map(|(sources, sampled, bound)| {
            Some(NormComparison { sources, sampled, bound: bound.as_ref()? })
        });
        compared.collect()
    }

    /// Returns true if the enclosing box is larger than the workspace. Then the bound's maximum may
    /// lie outside the workspace.
    pub fn box_exceeds_workspace(&self) -> bool {
        self.certified.as_ref().is_some_and(|norms| norms.contains_more)
    }

    /// Describes the domain over which the certified norms hold.
    fn certified_domain(&self) -> &'static str {
        match self.box_exceeds_workspace() {
            true => "the enclosing joint box, which is larger than the workspace,",
            false => "the whole box of the workspace",
        }
    }
}

/// Reason why nothing is certified of machines that are not a chain.
pub const NOT_CERTIFIED: &str = "bounds are proved for chains of frames only";

/// Returns the table of sampled and certified norms; `None` if nothing is certified.
pub fn norm_comparison_table(report: &Report) -> Option<Listing> {
    let decimals = report.decimals();
    let row = |NormComparison { sources, sampled, bound }: NormComparison| {
        let certified = bound.certified.map(|certified| number::rounded_up(certified, decimals));
        let place = if bound.label.is_empty() { "home" } else { &bound.label };
        vec![
            sources.to_owned(),
            number::fixed(sampled, decimals),
            number::rounded_down(bound.found, decimals),
            certified.unwrap_or_else(|| "not known".to_owned()),
            unbroken(place),
        ]
    };
    let rows: Vec<Vec<String>> = report.norm_comparisons().into_iter().map(row).collect();
    let found = if report.box_exceeds_workspace() { "found in the box" } else { "at least" };
    let header = vec!["norm of", "sampled", found, "at most", "found at"];
    if rows.is_empty() { None } else { Some(Listing { header, rows, numbers: 1..4 }) }
}

/// Returns a sentence with the certified norms; `None` if nothing is certified of a chain.
pub(super) fn sentence(report: &Report) -> Option<String> {
    if !report.spec.is_serial() {
        return Some(format!("Certified: nothing; {NOT_CERTIFIED}."));
    }
    let unit = report.spec.length.symbol();
    let compared =
        report.norm_comparisons().into_iter().filter_map(|NormComparison { sources, sampled, bound }| {
            let certified = number::rounded_up(bound.certified?, report.decimals());
            Some(format!(
                "{certified} {unit} of {sources} ({} sampled)",
                number::fixed(sampled, report.decimals())
            ))
        });
    let compared: Vec<String> = compared.collect();
    (!compared.is_empty()).then(|| {
        format!(
            "Certified, to first order: over {} the norm is at most {}.",
            report.certified_domain(),
            compared.join(", ")
        )
    })
}
