//! What was sampled, beside what is certified.

use super::report::Report;
use crate::bound::{Largest, Norms};
use crate::listing::Listing;
use crate::number::{self, unbroken};

/// The norm of one kind of errors: what was sampled, and what is certified.
pub struct Sampled<'a> {
    /// The sources that make it, in words.
    pub sources: &'static str,
    /// The largest ‖ΔX‖ that was sampled, in the length unit.
    pub sampled: f64,
    /// What is certified over the box that contains the workspace, in the same unit.
    pub largest: &'a Largest,
}

impl Report {
    /// Sampled and certified norms, of every kind of sources that there are.
    pub fn sampled(&self) -> Vec<Sampled<'_>> {
        let Some(Norms { repeatable, random, radius, .. }) = &self.certified else { return Vec::new() };
        let radii = &self.combined.radii;
        let kinds = [
            ("the repeatable sources", radii.repeatable_radius, repeatable),
            ("the random sources", radii.random_radius, random),
            ("all sources together", radii.radius, radius),
        ];
        let known = kinds.into_iter().filter_map(|(sources, sampled, largest)| {
            Some(Sampled { sources, sampled, largest: largest.as_ref()? })
        });
        known.collect()
    }

    /// Whether the box of the certified norms holds more than the workspace, so that what was found may lie outside of it.
    pub fn box_contains_more(&self) -> bool {
        self.certified.as_ref().is_some_and(|norms| norms.contains_more)
    }

    /// In what the certified norms hold.
    fn certified_in(&self) -> &'static str {
        match self.box_contains_more() {
            true => "the box that contains the workspace, which holds more than it,",
            false => "the whole box of the workspace",
        }
    }
}

/// Sampled and certified norms as a table; none if nothing is certified.
pub fn at_most(report: &Report) -> Option<Listing> {
    let decimals = report.decimals();
    let row = |Sampled { sources, sampled, largest }: Sampled| {
        let certified = largest.certified.map(|certified| number::rounded_up(certified, decimals));
        let place = if largest.place.is_empty() { "home" } else { &largest.place };
        vec![
            sources.to_owned(),
            number::fixed(sampled, decimals),
            number::rounded_down(largest.found, decimals),
            certified.unwrap_or_else(|| "not known".to_owned()),
            unbroken(place),
        ]
    };
    let rows: Vec<Vec<String>> = report.sampled().into_iter().map(row).collect();
    let found = if report.box_contains_more() { "found in the box" } else { "at least" };
    let header = vec!["norm of", "sampled", found, "at most", "found at"];
    if rows.is_empty() { None } else { Some(Listing { header, rows, numbers: 1..4 }) }
}

/// What is certified, in a sentence; none if nothing is.
pub(super) fn sentence(report: &Report) -> Option<String> {
    let unit = report.spec.length.symbol();
    let known = report.sampled().into_iter().filter_map(|Sampled { sources, sampled, largest }| {
        let certified = number::rounded_up(largest.certified?, report.decimals());
        Some(format!(
            "{certified} {unit} of {sources} ({} sampled)",
            number::fixed(sampled, report.decimals())
        ))
    });
    let known: Vec<String> = known.collect();
    (!known.is_empty()).then(|| {
        format!(
            "Certified, to first order: in {} the norm is nowhere more than {}.",
            report.certified_in(),
            known.join(", ")
        )
    })
}
