//! Sampled norms beside certified upper bounds.

use super::report::Report;
use crate::bound::{CertifiedNorms, ErrorBound};

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
}

/// Reason why nothing is certified of machines that are not a chain.
pub const NOT_CERTIFIED: &str = "bounds are proved for chains of frames only";
