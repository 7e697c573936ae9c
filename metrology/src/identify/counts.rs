//! Number of identifiable errors of a machine.

use std::fmt;

use abbe::identify::{Identifiable, Model, Unknown};
use serde::Serialize;

/// Number of identifiable errors of base and frames, out of how many.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Counts {
    /// Number of identifiable combinations.
    pub rank: usize,
    /// Number of unknown errors.
    pub unknowns: usize,
    /// Is true if the errors of the base are among the unknowns.
    pub base: bool,
}

impl Counts {
    pub(crate) fn new(model: &Model, identifiable: &Identifiable) -> Self {
        let machine = |unknown: &Unknown| matches!(unknown, Unknown::Base(..) | Unknown::Error(..));
        let stands = |unknown: &Unknown| matches!(unknown, Unknown::Fixture(..) | Unknown::Zero(_));
        let kept = || identifiable.kept.iter().map(|k| &model.unknowns[*k]);
        Self {
            // Fixtures and zeros that absorb errors are not errors of the machine.
            rank: match model.unknowns.iter().any(stands) {
                true => kept().filter(|unknown| machine(unknown)).count(),
                false => identifiable.errors,
            },
            unknowns: model.unknowns.iter().filter(|unknown| machine(unknown)).count(),
            base: model.unknowns.iter().any(|unknown| matches!(unknown, Unknown::Base(..))),
        }
    }
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let of = if self.base { "frames and base" } else { "frames" };
        write!(f, "{} of the {} errors of {of}", self.rank, self.unknowns)
    }
}
