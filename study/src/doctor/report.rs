//! What `abbe doctor` finds.

use serde::Serialize;

use crate::interpretations::Interpretation;

/// An interpretation and its residual.
#[derive(Clone, Debug, Serialize)]
pub struct Finding {
    /// What the numbers are then.
    #[serde(rename = "reading")]
    pub interpretation: Interpretation,
    /// The same in words.
    pub words: String,
    /// The root mean square residual of positions, in the spec's length unit.
    pub residual: f64,
    /// The root mean square residual of orientations, in rad; none if there are none.
    pub angle: Option<f64>,
    /// What is held against `within`, in the spec's length unit: both together, angles at a lever of three tenths of how far the
    /// positions spread, and more by what fitted numbers take away.
    pub both: f64,
}

/// The answer of `abbe doctor`.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// The machine's name.
    pub name: String,
    /// The length unit of residuals.
    pub length: &'static str,
    /// Number of rows that were read.
    pub rows: usize,
    /// The columns that were read as joints.
    pub joints: Vec<String>,
    /// The columns that were read as what was seen.
    pub seen: Vec<String>,
    /// Whether an interpretation fits.
    pub fits: bool,
    /// What may be left of a position for that.
    pub within: f64,
    /// Interpretations that fit and that these rows cannot tell apart, the simplest first; if none fits, none.
    pub found: Vec<Finding>,
    /// The first of these with less in it, where that leaves little as well, but more than noise does.
    pub simpler: Option<Finding>,
    /// The nearest of the others.
    pub others: Vec<Finding>,
    /// What is found, in one sentence.
    pub sentence: String,
    /// The map of the first interpretation; none if none fits.
    pub map: Option<String>,
    /// What the map cannot hold: to be changed in the spec.
    pub of_spec: Vec<String>,
}
