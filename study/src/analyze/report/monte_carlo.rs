//! Monte Carlo draws on the exact chain.

use abbe::analysis::MonteCarlo;
use serde::Serialize;

use super::error_sites::ErrorSite;
use crate::number::Named;

/// Errors drawn at the worst configuration and at home.
#[derive(Clone, Debug, Serialize)]
pub struct MonteCarloReport {
    /// Number of draws at each configuration.
    pub draws: usize,
    /// Seed of the draws.
    pub seed: u64,
    /// Errors at the configuration with the largest radius.
    pub worst: MonteCarloErrors,
    /// Errors at home.
    pub home: MonteCarloErrors,
}

/// Errors drawn at one configuration.
#[derive(Clone, Debug, Serialize)]
pub struct MonteCarloErrors {
    /// Joint variables and varying inputs of the configuration.
    pub at: Named,
    /// Parameters of the configuration that vary over the workspace.
    pub at_parameters: Named,
    /// Statistics of the errors.
    #[serde(flatten)]
    pub errors: MonteCarlo,
}

impl MonteCarloErrors {
    /// Adds the names of the configuration to its draws.
    pub(in crate::analyze) fn new(site: &ErrorSite, errors: MonteCarlo) -> Self {
        Self { at: site.variables.clone(), at_parameters: site.parameters.clone(), errors }
    }
}

impl MonteCarloReport {
    /// Returns both results, with their names.
    pub fn results(&self) -> [(&'static str, &MonteCarlo); 2] {
        [("worst", &self.worst.errors), ("home", &self.home.errors)]
    }
}
