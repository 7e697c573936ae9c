//! Certified upper bounds of norms.

use super::report::Report;
use crate::bound::{CertifiedNorms, ErrorBound};

/// Largest norm of one kind of error over the enclosing box of the workspace.
pub struct NormComparison<'a> {
    /// Name of the sources that cause it, for display.
    pub sources: &'static str,
    /// Largest ‖ΔX‖ of the position among the sampled configurations, in the length unit; `None`
    /// for a worst case over the values of random sources, which is not sampled.
    pub sampled: Option<f64>,
    /// Certified upper bound over the enclosing box of the workspace, in the length unit.
    pub bound: &'a ErrorBound,
}

impl Report {
    /// Returns the sampled and certified norms of each kind of source that the spec has; empty if
    /// nothing is certified.
    pub fn norm_comparisons(&self) -> Vec<NormComparison<'_>> {
        let Some(CertifiedNorms { repeatable, random, total, .. }) = &self.certified else {
            return Vec::new();
        };
        let kinds = [
            ("the repeatable sources", Some(self.combined.radii.repeatable_radius), repeatable),
            ("the random sources in the worst case", None, random),
            ("all sources in the worst case", None, total),
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
}

/// Reason why nothing is certified of machines that are not a chain.
pub const NOT_CERTIFIED: &str = "bounds are proved for chains of frames only";
