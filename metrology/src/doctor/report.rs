//! Report of `abbe doctor`.

use serde::Serialize;

use crate::interpretations::Interpretation;

/// An interpretation and its residual.
#[derive(Clone, Debug, Serialize)]
pub struct Finding {
    /// The interpretation.
    pub interpretation: Interpretation,
    /// Description of the interpretation.
    pub words: String,
    /// Root mean square residual of the positions, in the spec's length unit.
    pub residual: f64,
    /// Root mean square residual of the orientations, in rad; `None` if the data have no
    /// orientations.
    pub angle: Option<f64>,
    /// Root mean square distance of the positions from their mean, as this interpretation reads
    /// them, in the spec's length unit.
    pub spread: f64,
    /// Combined root mean square residual, in the spec's length unit, which is compared with
    /// `within`. Angles are multiplied by a lever of 0.3 × the spread of the positions. Corrected
    /// for the degrees of freedom that fitted numbers take.
    pub both: f64,
}

/// Units, order and format with which the numbers of a file agree with the spec.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Name of the machine.
    pub name: String,
    /// Symbol of the length unit.
    pub length: &'static str,
    /// Number of rows that were used.
    pub rows: usize,
    /// Names of the columns read as joints.
    pub joints: Vec<String>,
    /// Names of the columns read as measured values.
    pub seen: Vec<String>,
    /// Indicates that at least one interpretation fits.
    pub fits: bool,
    /// Largest combined residual at which an interpretation fits, in the spec's length unit.
    pub within: f64,
    /// Interpretations that fit and that the data cannot distinguish, simplest first.
    pub found: Vec<Finding>,
    /// Simplification of the first interpretation that is also within the tolerance, but fits
    /// significantly worse.
    pub simpler: Option<Finding>,
    /// Best of the interpretations that do not fit.
    pub others: Vec<Finding>,
    /// Names of the joints that do not move in these rows.
    pub still: Vec<String>,
    /// Names of the joints that move in these rows.
    pub moved: Vec<String>,
    /// Map of the first interpretation; `None` if no interpretation fits.
    pub map: Option<String>,
    /// Corrections that the map cannot express and that belong in the spec or the file, one
    /// sentence each.
    pub of_spec: Vec<String>,
}
