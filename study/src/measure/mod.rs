//! How good a machine is: accuracy, repeatability, and what the sources of its spec explain.
//!
//! `errors` are ΔX of every row; `iso9283` what the standard says of configurations that were visited again; `explained`
//! compares with the prediction; `readings` are the same of instruments that are read one by one.

mod errors;
mod explained;
mod iso9283;
mod readings;

use std::borrow::Cow;

use abbe::LengthUnit;
use abbe::identify::{self, Figures, Observation, drift};
use abbe_interpreter::Interpreter;
use abbe_spec::diagnostic::Diagnostics;
use serde::Serialize;

use crate::data::{Data, Instruments, Map, Summary, Table};
use crate::extrapolated::{Extrapolated, extrapolated};
use crate::identify::{ResidualDrift, Setup, Sizes, check_interpretation, too_large};
use crate::{Acceptance, Accepted, Machine, Notes, finite, mistake};

pub use errors::RowError;
use errors::{Errors, Visit};
use readings::{Readings, readings};

pub use explained::Explained;
pub use iso9283::{Directions, Distances, Drift, MeanAndMax, Repeated};
pub use readings::{InstrumentErrors, ReadingErrors, RowReadings};

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
    /// Instruments that are read one by one, each with reading minus prediction in its own unit.
    pub instruments: Vec<InstrumentErrors>,
    /// What the sources of the spec explain of it.
    pub explained: Explained,
    /// Configurations that were visited again.
    pub repeated: Repeated,
    /// Whether what the spec leaves is within the limits that were declared, if any were.
    pub accepted: Option<Accepted>,
    /// Rows outside the ranges that were fitted, and how well the machine is known there; nothing if there are none.
    pub extrapolated: Option<Extrapolated>,
    /// How many independent configurations the rows are of.
    pub configurations: usize,
    /// The standard error of the mean norm of ΔX, configurations counted; none if there is only one.
    pub standard_error: Option<f64>,
    /// Whether what the sources do not explain follows the order of the rows; none for too few rows to tell.
    pub order: Option<ResidualDrift>,
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
    /// What is left of every number of every row, where instruments are read.
    #[serde(skip)]
    pub row_readings: Vec<RowReadings>,
    /// What these numbers are called: by their instrument, and by the axis if it reads three.
    #[serde(skip)]
    pub numbers: Vec<String>,
    /// The points of visits of the same configuration about their barycentre, for pictures.
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

/// Values that come one after the other, for their [`Size`]. Sums about the mean so far: Welford, 1962.
#[derive(Clone, Copy, Default)]
struct Sums {
    count: f64,
    mean: f64,
    about_mean: f64,
    squares: f64,
    max: f64,
}

impl Sums {
    fn add(&mut self, value: f64) {
        self.count += 1.0;
        let before = value - self.mean;
        self.mean += before / self.count;
        self.about_mean += before * (value - self.mean);
        self.squares += value * value;
        self.max = self.max.max(value.abs());
    }

    fn size(&self, name: &'static str, unit: &'static str) -> Size {
        Size {
            name,
            unit,
            mean: self.mean + 0.0,
            rms: (self.squares / self.count.max(1.0)).sqrt(),
            max: self.max,
            three_sigma: 3.0 * (self.about_mean / (self.count - 1.0).max(1.0)).sqrt(),
        }
    }
}

/// How often it is said how far the work is.
const TOLD: usize = 1000;

/// By number of a configuration, whether more than one row is a visit of it.
fn visited_again(rows: &[Observation]) -> Vec<bool> {
    let count = rows.iter().map(|row| row.configuration as usize + 1).max().unwrap_or_default();
    let (mut once, mut again) = (vec![false; count], vec![false; count]);
    for row in rows {
        let at = row.configuration as usize;
        again[at] |= once[at];
        once[at] = true;
    }
    again
}

impl Measure {
    /// Compares every row with the ideal machine and with the predicted one.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report, Diagnostics> {
        self.judged(self.data.clone(), true, notes)
    }

    /// The same without ΔX row by row, for a table or pictures: of a million rows there is not much more than these.
    pub fn figures(mut self, notes: &mut dyn Notes) -> Result<Report, Diagnostics> {
        let data = std::mem::take(&mut self.data);
        self.judged(data, false, notes)
    }

    fn judged(&self, data: Data, keep: bool, notes: &mut dyn Notes) -> Result<Report, Diagnostics> {
        let Self { machine, map, accept, .. } = self;
        let interpreter = Interpreter::new(machine.spec.clone());
        let data = match data.completed(map, &interpreter, &machine.spec) {
            Cow::Owned(completed) => completed,
            Cow::Borrowed(_) => data,
        };
        let mut setup = Setup::new(&interpreter, map, &data, 0)?;
        let fitted = check_interpretation(&setup, map, &data)?;
        let base_fitted = setup.find_places(map, &data)?;
        let mut seen = match map.instruments() {
            Some(all) => Seen::of_readings(&setup, all, data)?,
            None => Seen::of_points(&setup, data, keep, notes)?,
        };
        let rows = &seen.data.observations;
        let places = rows.iter().map(|row| (&row.q[..], &row.u[..]));
        let extrapolated = extrapolated(&machine.spec, &interpreter, "rows", places, notes);
        let Figures { rms, configurations, standard_error, .. } = seen.norms;
        if let Some(said) = too_large(rms, fitted, &setup) {
            notes.warn(&said);
        }
        let Explained { left_mean: mean, left_rms: rms, left_p95: p95, left_max: max, .. } = seen.explained;
        let accepted = accept.judge("these rows", &Sizes { mean, standard_error: None, rms, max, p95 });
        notes.go_on()?;
        let order = drift(&setup.real, rows, &[]);
        let order = order.map_err(|failure| mistake::whole(&seen.data.file, &failure))?;
        let file = seen.data.file.clone();
        let report = Report {
            name: machine.spec.name.clone(),
            length: machine.spec.length.symbol(),
            unit: machine.spec.length,
            title: map.title.clone(),
            rows: rows.len(),
            errors: std::mem::take(&mut seen.errors),
            instruments: std::mem::take(&mut seen.instruments),
            explained: seen.explained,
            accepted,
            extrapolated,
            repeated: iso9283::repeated(&seen.visits, setup.pose || setup.ideal.targets.len() > 1),
            configurations,
            standard_error: Some(standard_error).filter(|error| error.is_finite()),
            order: order.map(|drift| ResidualDrift::new(drift, setup.description.length)),
            unusable: seen.data.unusable.len(),
            file: seen.data.summary(),
            base_fitted,
            about_barycentres: if keep { iso9283::about_barycentres(&seen.visits) } else { Vec::new() },
            row_errors: seen.rows,
            row_readings: seen.row_readings,
            numbers: map.instruments().map(Instruments::names).unwrap_or_default(),
        };
        finite(file, report)
    }
}

/// What rows say of a machine, whatever they have.
struct Seen {
    errors: Vec<Size>,
    instruments: Vec<InstrumentErrors>,
    explained: Explained,
    /// The norms of the errors.
    norms: Figures,
    /// Rows of configurations that were visited again.
    visits: Vec<Visit>,
    /// All rows, if they are kept.
    rows: Vec<RowError>,
    row_readings: Vec<RowReadings>,
    /// The rows that were used.
    data: Data,
}

impl Seen {
    fn of_points(
        setup: &Setup,
        mut data: Data,
        keep: bool,
        notes: &mut dyn Notes,
    ) -> Result<Self, Diagnostics> {
        errors::leave_out(setup, &mut data)?;
        let fail = |failure: identify::Failure| mistake::whole(&data.file, &failure);
        let unit = setup.description.length.symbol();
        let numbers = if setup.pose || setup.ideal.targets.len() > 1 { 6 } else { 3 };
        let mut sizes = vec![Sums::default(); numbers + 1];
        let (mut errors, mut norms) = (Errors::new(setup), identify::Distances::default());
        let again = visited_again(&data.observations);
        let (mut visits, mut rows) = (Vec::new(), Vec::new());
        for (i, row) in data.observations.iter().enumerate() {
            if i.is_multiple_of(TOLD) {
                notes.progress(i, data.observations.len());
                notes.go_on()?;
            }
            let row = errors.of(row).map_err(fail)?;
            let distance = row.distance();
            sizes[..numbers].iter_mut().zip(row.error).for_each(|(size, value)| size.add(value));
            sizes[numbers].add(distance);
            norms.push(row.observation.configuration, distance);
            if again[row.observation.configuration as usize] {
                visits.push(Visit::new(&row));
            }
            if keep {
                rows.push(row);
            }
        }
        notes.progress(data.observations.len(), data.observations.len());
        let norms = norms.into_figures();
        let of = |i: usize, name, unit| sizes[i].size(name, unit);
        let mut errors: Vec<Size> = (0..3).map(|i| of(i, ["x", "y", "z"][i], unit)).collect();
        errors.push(of(numbers, "norm", unit));
        errors.extend((3..numbers).map(|i| of(i, ["about x", "about y", "about z"][i - 3], "rad")));
        let explained = explained::explained(setup, &data.observations).map_err(fail)?;
        Ok(Self {
            errors,
            instruments: Vec::new(),
            explained,
            norms,
            visits,
            rows,
            row_readings: Vec::new(),
            data,
        })
    }

    fn of_readings(setup: &Setup, all: &Instruments, data: Data) -> Result<Self, Diagnostics> {
        let Readings { instruments, explained, rows: row_readings, norms } =
            readings(setup, all, &data).map_err(|failure| mistake::whole(&data.file, &failure))?;
        let (errors, visits, rows) = (Vec::new(), Vec::new(), Vec::new());
        Ok(Self {
            errors,
            instruments,
            explained,
            norms: norms.into_figures(),
            visits,
            rows,
            row_readings,
            data,
        })
    }
}

impl Report {
    /// ΔX row by row, or what is left of every reading.
    pub fn table(&self) -> Table {
        if !self.instruments.is_empty() {
            return self.readings_table();
        }
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

    fn readings_table(&self) -> Table {
        let line = std::iter::once("line".to_owned());
        let rows = self.row_readings.iter();
        Table {
            heading: line.chain(self.numbers.iter().cloned()).collect(),
            rows: rows
                .map(|row| std::iter::once(Some(row.line as f64)).chain(row.left.iter().copied()).collect())
                .collect(),
            ..Table::default()
        }
    }
}
