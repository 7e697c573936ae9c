//! How good a machine is: accuracy, repeatability, and what the sources of its spec explain.
//!
//! `errors` are ΔX of every row; `iso9283` what the standard says of configurations that were visited again; `explained`
//! compares with the prediction; `sentences` says the last two in words.

mod errors;
mod explained;
mod iso9283;
mod sentences;

use abbe::identify::{self, Figures, Observation, drift};
use abbe_codegen::diagnostic::Diagnostics;
use abbe_codegen::expr::LengthUnit;
use abbe_interpreter::Interpreter;
use serde::Serialize;

use crate::data::{Data, Map, Summary, Table, warn_of_extrapolation};
use crate::identify::{Order, Setup, Sizes, check_readings};
use crate::{Acceptance, Accepted, Machine, Notes, mistake, number};

pub use errors::RowError;
pub use explained::Explained;
pub use iso9283::{Directions, Distances, Drift, MeanAndMax, Repeated};

/// How good is this machine?
pub struct Measure {
    /// The machine as its spec has it.
    pub machine: Machine,
    /// What the columns of the data are.
    pub map: Map,
    /// The measurements.
    pub data: Data,
    /// Limits for what the sources of the spec leave.
    pub accept: Acceptance,
}

/// What was measured.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// The machine's name.
    pub name: String,
    /// The length unit of everything.
    pub length: &'static str,
    /// What the map is called.
    pub title: String,
    /// How many rows could be used.
    pub rows: usize,
    /// ΔX = measured − ideal: along x, y, z and as norm; of poses the turns about x, y, z as well.
    pub errors: Vec<Size>,
    /// What the sources of the spec explain of it.
    pub explained: Explained,
    /// Configurations that were visited again.
    pub repeated: Repeated,
    /// Whether what the spec leaves is within the limits that were declared, if any were.
    pub accepted: Option<Accepted>,
    /// How many independent configurations the rows are of.
    pub configurations: usize,
    /// The standard error of the mean norm of ΔX, configurations counted; none if there is only one.
    pub standard_error: Option<f64>,
    /// Whether what the sources do not explain follows the order of the rows; none for too few rows to tell.
    pub order: Option<Order>,
    /// How many rows could not be used.
    pub unusable: usize,
    /// The length unit as such.
    #[serde(skip)]
    pub unit: LengthUnit,
    /// The file.
    #[serde(skip)]
    pub file: Summary,
    /// Whether it was fitted where the instrument stands.
    #[serde(skip)]
    pub base_fitted: bool,
    /// ΔX of every row.
    #[serde(skip)]
    pub row_errors: Vec<RowError>,
    /// The points of visits of the same configuration about their barycentre.
    #[serde(skip)]
    pub about_barycentres: Vec<[f64; 3]>,
}

/// One component of ΔX over all rows.
#[derive(Clone, Debug, Serialize)]
pub struct Size {
    /// `x`, `norm`, `about x`.
    pub name: &'static str,
    /// The length unit, or rad.
    pub unit: &'static str,
    /// The mean.
    pub mean: f64,
    /// The root mean square.
    pub rms: f64,
    /// The largest, either sign.
    pub max: f64,
    /// Three standard deviations about the mean.
    pub three_sigma: f64,
}

impl Size {
    fn new(name: &'static str, unit: &'static str, values: &[f64]) -> Self {
        let n = values.len().max(1) as f64;
        let mean = values.iter().sum::<f64>() / n;
        let squares = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>();
        Self {
            name,
            unit,
            mean: mean + 0.0,
            rms: (values.iter().map(|v| v * v).sum::<f64>() / n).sqrt(),
            max: values.iter().fold(0.0, |most: f64, v| most.max(v.abs())),
            three_sigma: 3.0 * (squares / (n - 1.0).max(1.0)).sqrt(),
        }
    }
}

/// Errors of more than this share of the arm are none of a machine.
const LARGE: f64 = 1e-2;

/// What is to be said of errors that are too large for a machine; `fitted` is what is left with base and tool fitted.
fn far(rms: f64, fitted: Option<f64>, setup: &Setup) -> String {
    let length = |value| number::length(value, setup.description.length);
    let share = number::percent(rms, setup.arm);
    let said = format!("these errors are {} (root mean square), {share} of the arm:", length(rms));
    match fitted {
        Some(left) if left < rms / 5.0 => format!(
            "{said} with base and tool fitted {} are left. Where does the instrument stand (`base = \"unknown\"` in the map finds \
             it), and where does the target sit?",
            length(left)
        ),
        _ => format!(
            "{said} neither another place of base and tool nor another reading (units, signs, orders of columns) that was tried brings \
             the machine near them. Are they measurements of this machine?"
        ),
    }
}

impl Measure {
    /// Compares every row with the ideal machine and with the predicted one.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report, Diagnostics> {
        let Self { machine, map, data, accept } = self;
        let interpreter = Interpreter::new(machine.spec.clone());
        if map.instruments().is_some() {
            let help = "`abbe identify` says what is left of every instrument's readings";
            let message = "how far off the tool is, points and poses tell: this map has instruments that are read one by one";
            return Err(mistake::with_help(map.path(), message, help));
        }
        let data = &data.completed(map, &interpreter, &machine.spec);
        let mut setup = Setup::new(&interpreter, map, data, 0)?;
        let fitted = check_readings(&setup, map, data)?;
        let base_fitted = setup.find_stations(map, data)?;
        let mut data = data.clone();
        let rows = errors::row_errors(&setup, &mut data)?;
        let places = rows.iter().map(|row| (&row.observation.q[..], &row.observation.u[..]));
        warn_of_extrapolation(&machine.spec, "rows", places, notes);
        let unit = machine.spec.length.symbol();
        let along = |axis: usize| rows.iter().map(|row| row.error[axis]).collect::<Vec<_>>();
        let mut errors: Vec<Size> = ["x", "y", "z"]
            .into_iter()
            .enumerate()
            .map(|(i, name)| Size::new(name, unit, &along(i)))
            .collect();
        let norm = Size::new("norm", unit, &rows.iter().map(RowError::distance).collect::<Vec<_>>());
        if norm.rms > LARGE * setup.arm {
            notes.warn(&far(norm.rms, fitted, &setup));
        }
        errors.push(norm);
        if setup.pose || setup.ideal.targets.len() > 1 {
            let names = ["about x", "about y", "about z"].into_iter().enumerate();
            errors.extend(names.map(|(i, name)| Size::new(name, "rad", &along(3 + i))));
        }
        let explained = explained::explained(&setup, &rows);
        let explained = explained.map_err(|failure| mistake::whole(&data.file, failure))?;
        let Explained { left_mean: mean, left_rms: rms, left_p95: p95, left_max: max, .. } = explained;
        let accepted = accept.judge("these rows", &Sizes { mean, standard_error: None, rms, max, p95 });
        let observations: Vec<&Observation> = rows.iter().map(|row| &row.observation).collect();
        let order = drift(&setup.real, &observations, &[]);
        let order = order.map_err(|failure| mistake::whole(&data.file, failure))?;
        let norms = rows.iter().map(|row| (row.observation.configuration, row.distance()));
        let Figures { configurations, standard_error, .. } = identify::Distances(norms.collect()).figures();
        Ok(Report {
            name: machine.spec.name.clone(),
            length: unit,
            unit: machine.spec.length,
            title: map.title.clone(),
            rows: rows.len(),
            errors,
            explained,
            accepted,
            repeated: iso9283::repeated(&rows, setup.pose || setup.ideal.targets.len() > 1),
            configurations,
            standard_error: Some(standard_error).filter(|error| error.is_finite()),
            order: order.map(|drift| Order::new(drift, setup.description.length)),
            unusable: data.unusable.len(),
            file: Summary { rows: rows.len(), ..data.summary() },
            base_fitted,
            about_barycentres: iso9283::about_barycentres(&rows),
            row_errors: rows,
        })
    }
}

impl Report {
    /// ΔX row by row.
    pub fn table(&self) -> Table {
        let names = ["line", "x", "y", "z", "about_x", "about_y", "about_z"];
        // One more for the line, and none for the norm.
        let names = &names[..self.errors.len()];
        let rows = self.row_errors.iter().map(|row| {
            let values = row.error[..names.len() - 1].iter().map(|value| Some(*value));
            std::iter::once(Some(row.observation.line as f64)).chain(values).collect()
        });
        let heading = names.iter().map(|name| (*name).to_owned()).collect();
        Table { heading, rows: rows.collect(), ..Table::default() }
    }
}
