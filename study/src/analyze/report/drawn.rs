//! What was drawn on the exact chain.

use abbe::analysis::MonteCarlo;
use serde::Serialize;

use super::error_sites::ErrorSite;
use crate::number::Named;

/// Errors drawn at the worst configuration and at home.
#[derive(Clone, Debug, Serialize)]
pub struct Drawn {
    /// Draws at each place.
    pub draws: usize,
    /// The seed of the draws.
    pub seed: u64,
    /// Where the radius of all errors is largest.
    pub worst: DrawnErrors,
    /// At home.
    pub home: DrawnErrors,
}

/// Errors drawn at one configuration.
#[derive(Clone, Debug, Serialize)]
pub struct DrawnErrors {
    /// The configuration.
    pub at: Named,
    /// Its parameters which the workspace moves.
    pub at_parameters: Named,
    /// The errors.
    #[serde(flatten)]
    pub errors: MonteCarlo,
}

impl DrawnErrors {
    /// Names the configuration of draws.
    pub(in crate::analyze) fn new(site: &ErrorSite, errors: MonteCarlo) -> Self {
        Self { at: site.variables.clone(), at_parameters: site.parameters.clone(), errors }
    }
}

impl Drawn {
    /// Both places, with their names.
    pub fn places(&self) -> [(&'static str, &MonteCarlo); 2] {
        [("worst", &self.worst.errors), ("home", &self.home.errors)]
    }
}
