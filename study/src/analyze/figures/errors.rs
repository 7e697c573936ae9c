//! The error of the tool point that a figure shows, and where.

use abbe::analysis::Configuration;
use serde::{Deserialize, Serialize};

/// The error of the tool point: the repeatable part, and the bound of the random one, plus or minus.
#[derive(Clone, Copy, Debug)]
pub(super) struct Errors {
    pub(super) repeatable: [f64; 3],
    pub(super) random: [f64; 3],
}

impl Errors {
    /// Both norms, added: as the radius of all sources together.
    pub(super) fn norm(&self) -> f64 {
        norm(self.repeatable) + norm(self.random)
    }
}

/// The Euclidean norm.
pub fn norm(vector: [f64; 3]) -> f64 {
    vector.iter().map(|entry| entry * entry).sum::<f64>().sqrt()
}

/// A configuration, serialized.
#[derive(Serialize, Deserialize)]
#[serde(remote = "Configuration")]
pub(super) struct Place {
    q: Vec<f64>,
    s: Vec<f64>,
    u: Vec<f64>,
}
