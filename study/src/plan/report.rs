//! What is to be measured, and what it will tell.

use abbe::identify::{Model, Observation, Unknown};
use serde::Serialize;

use super::sets::Counted;
use crate::data::{Map, Table};
use crate::identify::{Counts, Indistinguishable, WeaklyDetermined};

/// What is to be measured, and what it will tell.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// The machine's name.
    pub name: String,
    /// The length unit of everything.
    pub length: &'static str,
    /// What the plan is called.
    pub title: String,
    /// How many rows are to be measured.
    pub rows: usize,
    /// Set by set.
    pub sets: Vec<Counted>,
    /// Where the inputs are that have a range.
    pub inputs: Vec<Input>,
    /// How many combinations of the unknowns they determine.
    pub rank: usize,
    /// Of how many unknowns.
    pub unknowns: usize,
    /// Of base and frames alone, without the targets on the tool.
    pub machine: Counts,
    /// Errors of which these rows will tell too little beside what is known before.
    pub not_known: Vec<WeaklyDetermined>,
    /// The condition number.
    pub condition: f64,
    /// `ln det` of the information of columns of unit length.
    pub log_det: f64,
    /// How many exchanges led to an optimal plan.
    pub exchanges: usize,
    /// What the model itself is taken to leave of the tool point: root mean square distance, the length unit.
    pub model_error: f64,
    /// How many configurations of use were looked at.
    pub used: usize,
    /// Standard deviation of the identified tool point there, with the model's own error, the length unit.
    pub predicted: Predicted,
    /// What the rows cannot tell, though it moves the tool point there: it is not in these figures.
    pub unseen: Vec<Unseen>,
    /// What cannot be told apart, and why.
    #[serde(skip)]
    pub groups: Vec<Indistinguishable>,
    /// What is to be measured.
    #[serde(skip)]
    pub observations: Vec<Observation>,
}

/// Where an input that has a range is in the rows of a plan.
#[derive(Clone, Debug, Serialize)]
pub struct Input {
    /// Its name.
    pub name: String,
    /// Its coherent unit, empty for a pure number or an angle.
    pub unit: String,
    /// Its least and its largest value: the same of one that stays where it is.
    pub between: [f64; 2],
}

/// Figures of a standard deviation.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Predicted {
    /// The mean.
    pub mean: f64,
    /// The root mean square.
    pub rms: f64,
    /// The largest.
    pub max: f64,
    /// What 95 % do not exceed.
    pub p95: f64,
}

/// An error that the rows cannot tell, though it moves the tool point where the machine is used.
#[derive(Clone, Debug, Serialize)]
pub struct Unseen {
    /// Its name: `e_r3`.
    pub name: String,
    /// How far it moves the tool point there, root mean square, beside what stands for it: by mrad, or by length unit.
    pub moves: f64,
    /// What it is counted in: `mrad`, or the length unit.
    pub per: &'static str,
}

impl Unseen {
    pub(super) fn new(model: &Model, k: usize, moves: f64) -> Self {
        let unknown = model.unknowns[k];
        let turn = match unknown {
            Unknown::Base(_, component) | Unknown::Error(_, component) | Unknown::Tool(component) => {
                component.is_rotation()
            }
            Unknown::Magnitude(_) | Unknown::Target(..) | Unknown::Fixture(..) | Unknown::Zero(_) => false,
        };
        let length = model.manipulator.description().length.symbol();
        let (moves, per) = if turn { (moves * 1e-3, "mrad") } else { (moves, length) };
        Self { name: model.name(unknown), moves, per }
    }
}

impl Report {
    /// What is to be measured, in the columns and units of the map.
    pub fn table(&self, map: &Map) -> Table {
        let rows = self.observations.iter().map(|row| map.numbers(row, [0.0; 3], false));
        let labels = map.labels(&self.observations, &map.station_names());
        Table { heading: map.heading(false), rows: rows.collect(), labels }
    }
}
