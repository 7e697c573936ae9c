//! Report of a plan.

use abbe::identify::{Model, Observation, Unknown};
use serde::Serialize;

use super::sets::SetSize;
use crate::data::{Map, Table};
use crate::identify::{Counts, Indistinguishable, Redundant, WeaklyDetermined};

/// Planned measurement, and the uncertainty predicted for it.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Name of the machine.
    pub name: String,
    /// Length unit of all lengths.
    pub length: &'static str,
    /// Title of the plan.
    pub title: String,
    /// Number of rows to measure.
    pub rows: usize,
    /// Number of rows of each set.
    pub sets: Vec<SetSize>,
    /// Range of each variable input over the rows.
    pub inputs: Vec<Input>,
    /// Rank of the identification Jacobian: the number of identifiable combinations of unknowns.
    pub rank: usize,
    /// Number of unknowns.
    pub unknowns: usize,
    /// Number of identifiable errors of base and frames alone, without targets on the tool.
    pub machine: Counts,
    /// Errors that these rows will determine poorly compared with their prior.
    pub weakly_determined: Vec<WeaklyDetermined>,
    /// Condition number of the kept columns of the design matrix, each scaled to unit length.
    #[serde(serialize_with = "abbe_study::finite::or_null")]
    pub condition: f64,
    /// `ln det` of the information matrix of columns scaled to unit length.
    pub log_det: f64,
    /// Number of exchanges of the optimization.
    pub exchanges: usize,
    /// Assumed error of the identified model itself: root mean square position error in the length
    /// unit.
    pub model_error: f64,
    /// Number of evaluated configurations of use.
    pub used: usize,
    /// Predicted standard deviation of the identified tool point at these configurations, with the
    /// model error, in the length unit.
    pub predicted: Predicted,
    /// Errors that move the tool point at these configurations but that the rows cannot determine.
    /// `predicted` excludes them.
    pub unseen: Vec<UndeterminedError>,
    /// Magnitudes that others stand for: the rows determine only their sum.
    pub sums: Vec<Redundant>,
    /// Combinations of unknowns that cannot be distinguished, with the reason.
    #[serde(skip)]
    pub groups: Vec<Indistinguishable>,
    /// Rows to measure.
    #[serde(skip)]
    pub observations: Vec<Observation>,
}

/// Range of an input over the rows of a plan.
#[derive(Clone, Debug, Serialize)]
pub struct Input {
    /// Name of the input.
    pub name: String,
    /// Coherent unit; empty for a pure number or an angle.
    pub unit: String,
    /// Smallest and largest value, in `unit`; equal for a constant input.
    pub between: [f64; 2],
}

/// Statistics of a standard deviation over the configurations of use, in the length unit.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Predicted {
    /// Mean.
    pub mean: f64,
    /// Root mean square.
    pub rms: f64,
    /// Maximum.
    pub max: f64,
    /// 95 % quantile.
    pub p95: f64,
}

/// Error that moves the tool point where the machine is used, but that the rows cannot determine.
#[derive(Clone, Debug, Serialize)]
pub struct UndeterminedError {
    /// Name: `e_r3`.
    pub name: String,
    /// Root mean square displacement of the tool point per `per`, beyond the equivalent kept
    /// errors, in the length unit.
    pub moves: f64,
    /// Unit of the error: `mrad`, the length unit, or empty for a magnitude.
    pub per: &'static str,
}

impl UndeterminedError {
    pub(super) fn new(model: &Model, k: usize, moves: f64) -> Self {
        let unknown = model.unknowns[k];
        let length = model.manipulator.description().length.symbol();
        let (moves, per) = match unknown {
            Unknown::Magnitude(_) => (moves, ""),
            _ if unknown.is_rotation() => (moves * 1e-3, "mrad"),
            _ => (moves, length),
        };
        Self { name: model.name(unknown), moves, per }
    }
}

impl Report {
    /// Returns the rows to measure in the columns and units of the map.
    pub fn table(&self, map: &Map) -> Table {
        let rows = self.observations.iter().map(|row| map.numbers(row, [0.0; 3], false));
        let labels = map.labels(&self.observations, &map.station_names());
        Table { heading: map.heading(false), rows: rows.collect(), labels, ..Table::default() }
    }
}
