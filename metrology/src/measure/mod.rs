//! The job `measure`: accuracy, repeatability, and the share explained by the sources of the spec.
//!
//! `errors` computes ΔX of each row; `iso9283` the characteristics of repeated visits; `explained`
//! compares with the prediction, and what remains with the stated uncertainty; `readings` does the
//! same for instruments that are read one number at a time.

mod errors;
mod explained;
mod iso9283;
mod readings;

use std::borrow::Cow;

use abbe::identify::{self, Figures, Observation, drift};
use abbe::{LengthUnit, Pose};
use abbe_interpreter::Interpreter;
use abbe_spec::{diagnostic::Diagnostics, option::option};
use serde::Serialize;

use crate::acceptance::{FITTED, TARGET};
use crate::data::{Data, Instruments, Map, Summary, Table};
use crate::identify::{ResidualDrift, RowNotes, Setup, Sizes, check_interpretation, too_large};
use crate::running_sums::RunningSums;
use crate::{Acceptance, AcceptanceVerdict, Judged};
use abbe_study::extrapolation::{Extrapolation, warn_of_extrapolation};
use abbe_study::{About, Machine, Notes, Residual, Residuals, Result, RunRecord, finite, mistake};

pub use errors::RowError;
use errors::{Errors, Visit};
use readings::{Readings, readings};

pub use explained::{Explained, ResidualTest};
pub use iso9283::{Directions, Distances, Drift, MeanAndMax, Repeated};
pub use readings::{InstrumentErrors, ReadingErrors, RowReadings};

/// Options of `measure`.
pub struct Measure {
    /// The machine.
    pub machine: Machine,
    /// Map of the data.
    pub map: Map,
    /// Measurements.
    pub data: Data,
    /// Limits for the errors.
    pub accept: Acceptance,
}

/// Errors of measured rows, before and after the predicted errors are subtracted.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Name of the machine.
    pub name: String,
    /// Length unit of all lengths.
    pub length: &'static str,
    /// Title of the map.
    pub title: String,
    /// Number of usable rows.
    pub rows: usize,
    /// ΔX = measured − ideal: along x, y, z and its norm; for poses, also about x, y, z.
    pub errors: Vec<Size>,
    /// Reading minus prediction of each instrument, in its own unit.
    pub instruments: Vec<InstrumentErrors>,
    /// Comparison with the prediction by the sources of the spec.
    pub explained: Explained,
    /// Test of the errors minus the repeatable sources against the stated uncertainty; none if the
    /// map states none, or for too few rows.
    pub residual_test: Option<ResidualTest>,
    /// Characteristics of repeated visits.
    pub repeated: Repeated,
    /// Verdict on the machine by the declared limits, if any.
    pub accepted: Option<AcceptanceVerdict>,
    /// Comparison of what the repeatable sources of the spec leave with the same limits.
    pub agreed: Option<AcceptanceVerdict>,
    /// Rows outside the fitted ranges, and the predicted uncertainty there; none if there are no
    /// such rows.
    pub extrapolated: Option<Extrapolation>,
    /// Number of independent configurations.
    pub configurations: usize,
    /// Cluster-robust standard error of the mean norm of ΔX, in the length unit; none for a single
    /// configuration.
    pub standard_error: Option<f64>,
    /// Drift test of the errors minus the repeatable sources; none for too few rows, or where a
    /// place moved between two rows.
    pub drift: Option<ResidualDrift>,
    /// Rows that do not say what the map says of them.
    pub notes: Vec<String>,
    /// Number of unusable rows.
    pub unusable: usize,
    /// Stated date, persons and instruments, and the version of abbe; absent if nothing is stated.
    #[serde(skip_serializing_if = "RunRecord::is_empty")]
    pub record: RunRecord,
    /// Length unit as a value.
    #[serde(skip)]
    pub unit: LengthUnit,
    /// Summary of the file.
    #[serde(skip)]
    pub file: Summary,
    /// The pose of the base or the fixtures were fitted.
    #[serde(skip)]
    pub base_fitted: bool,
    /// Places on the tool that the map does not state were fitted.
    #[serde(skip)]
    pub tool_fitted: bool,
    /// Poses of `F_0` in the frame of the instrument, one per station.
    #[serde(skip)]
    pub stations: Vec<Pose>,
    /// ΔX of each row.
    #[serde(skip)]
    pub row_errors: Vec<RowError>,
    /// Reading minus prediction of each row.
    #[serde(skip)]
    pub row_readings: Vec<RowReadings>,
    /// Names of the readings: those of the instruments, with the axis where there are three.
    #[serde(skip)]
    pub numbers: Vec<String>,
    /// Unit of each of these numbers.
    #[serde(skip)]
    pub number_units: Vec<String>,
    /// Points of repeated visits relative to their barycentre, for figures.
    #[serde(skip)]
    pub about_barycentres: Vec<[f64; 3]>,
}

/// One component of ΔX over all rows. Values are in `unit`.
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
    /// The largest absolute value.
    pub max: f64,
    /// Three standard deviations about the mean.
    pub three_sigma: f64,
}

impl Size {
    fn new(name: &'static str, unit: &'static str, sums: &RunningSums) -> Self {
        let three_sigma = 3.0 * (sums.about_mean / (sums.count - 1.0).max(1.0)).sqrt();
        Self { name, unit, mean: sums.mean + 0.0, rms: sums.rms(), max: sums.max, three_sigma }
    }
}

/// Number of rows between reports of progress.
const PROGRESS_STEP: usize = 1000;

/// Returns whether each configuration has more than one row.
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

/// Returns the mistake of an acceptance whose target is fitted to the rows that it judges.
fn fitted_target(map: &Map, limits: &str) -> Diagnostics {
    let message = "the place of a target on the tool is fitted to these rows: errors that it absorbs would not be judged";
    let help = format!(
        "state its position in the map; or judge what is left: `{TARGET} = \"{FITTED}\"` in `[accept]`, or `{}`",
        option("accept", format!("\"{limits}, {TARGET} {FITTED}\""))
    );
    mistake::with_help(map.path(), message, help)
}

impl Measure {
    /// Returns the options that the figures depend on.
    fn options(&self) -> Vec<(&'static str, String)> {
        let Self { machine, map, data: _, accept } = self;
        let station = if map.is_newly_stationed { "new" } else { "" };
        let commands = if map.is_corrected { "corrected" } else { "" };
        machine.options_with([
            ("station", station.to_owned()),
            ("commands", commands.to_owned()),
            ("accept", accept.text(machine.spec.length)),
        ])
    }

    /// Compares each row with the ideal machine and with the predicted one.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report> {
        self.evaluate(self.data.clone(), true, notes)
    }

    /// Computes the report without ΔX of each row, with little memory beyond the data.
    pub fn figures(mut self, notes: &mut dyn Notes) -> Result<Report> {
        let data = std::mem::take(&mut self.data);
        self.evaluate(data, false, notes)
    }

    fn evaluate(&self, data: Data, keep: bool, notes: &mut dyn Notes) -> Result<Report> {
        let Self { machine, map, accept, .. } = self;
        let interpreter = Interpreter::new(machine.spec.clone());
        let data = match data.completed(map, &interpreter, &machine.spec) {
            Cow::Owned(completed) => completed,
            Cow::Borrowed(_) => data,
        };
        let data = Data::closed(Cow::Owned(data), &interpreter)?.into_owned();
        map.carried_targets(machine).iter().for_each(|warning| notes.warn(warning));
        let mut setup = Setup::new(&interpreter, map, &data, 0)?;
        let fitted = check_interpretation(&setup, map, &data)?;
        let placed = setup.find_places(map, &data)?;
        let is_tool_fitted = placed.is_some() && setup.is_tool_open();
        if is_tool_fitted && !accept.limits.is_empty() && !accept.is_target_fitted {
            return Err(fitted_target(map, &accept.text(machine.spec.length)));
        }
        let mut evaluated = match map.instruments() {
            Some(all) => Evaluated::of_readings(&setup, all, data)?,
            None => Evaluated::of_points(&setup, data, keep, notes)?,
        };
        evaluated.data.note_on_time().iter().for_each(|note| notes.warn(note));
        let rows = &evaluated.data.observations;
        let places = || rows.iter().map(|row| (&row.q[..], &row.u[..]));
        let extrapolated = warn_of_extrapolation(
            &machine.spec,
            &interpreter,
            &setup.delivered_points(),
            "rows",
            places(),
            notes,
        );
        let Figures { rms, configurations, standard_error, .. } = evaluated.norms;
        if let Some(warning) = too_large(rms, fitted, &setup) {
            notes.warn(&warning);
        }
        let Explained { left_mean: mean, left_rms: rms, left_p95: p95, left_max: max, repeatable, .. } =
            evaluated.explained;
        let predicted = Sizes { mean, standard_error: None, rms, max, p95 };
        let noise = if map.states_uncertainty() { setup.real.uncertainty.length } else { 0.0 };
        let judge =
            |judged, sizes, noise| accept.verdict((judged, "these rows"), &sizes, (noise, configurations));
        let accepted = match map.is_corrected {
            true => judge(Judged::Corrected, predicted, noise),
            false => judge(Judged::Machine, evaluated.norms.into(), noise),
        };
        let agreed =
            if repeatable > 0 && !map.is_corrected { judge(Judged::Model, predicted, 0.0) } else { None };
        notes.go_on()?;
        let file = evaluated.data.file.clone();
        let residual_test = ResidualTest::new(&setup, map, rows, placed.as_ref()).about(&file)?;
        if !map.states_uncertainty() {
            (evaluated.explained.inside, evaluated.explained.likely) = (None, None);
        }
        let drift = drift(&setup.real, rows, &[]).about(&file)?;
        let RowNotes { notes: of_rows, has_moved } =
            RowNotes::new(&setup, &setup.real, &[], (&evaluated.data, &rows.iter().collect::<Vec<_>>()))
                .about(&file)?;
        let report = Report {
            name: machine.spec.name.clone(),
            length: machine.spec.length.symbol(),
            unit: machine.spec.length,
            title: map.title.clone(),
            rows: rows.len(),
            errors: std::mem::take(&mut evaluated.errors),
            instruments: std::mem::take(&mut evaluated.instruments),
            explained: evaluated.explained,
            residual_test,
            accepted,
            agreed,
            extrapolated,
            repeated: iso9283::repeated(&evaluated.visits, setup.pose || setup.ideal.targets_of(0).len() > 1),
            configurations,
            standard_error: Some(standard_error).filter(|error| error.is_finite()),
            drift: drift.map(ResidualDrift::new).filter(|_| !has_moved),
            notes: of_rows,
            unusable: evaluated.data.unusable.len(),
            record: map.record.with_options(self.options()),
            file: evaluated.data.summary(),
            base_fitted: placed.is_some() && (setup.is_station_open() || map.instruments().is_some()),
            tool_fitted: is_tool_fitted,
            about_barycentres: if keep { iso9283::about_barycentres(&evaluated.visits) } else { Vec::new() },
            stations: setup.ideal.stations.iter().map(|station| station.pose).collect(),
            row_errors: evaluated.rows,
            row_readings: evaluated.row_readings,
            numbers: map.instruments().map(Instruments::names).unwrap_or_default(),
            number_units: map.instruments().map(Instruments::units).unwrap_or_default(),
        };
        finite(file, report)
    }
}

/// Results of either kind of measurement.
struct Evaluated {
    errors: Vec<Size>,
    instruments: Vec<InstrumentErrors>,
    explained: Explained,
    /// Figures of the norms of the errors.
    norms: Figures,
    /// Rows of configurations with repeated visits.
    visits: Vec<Visit>,
    /// The rows, if they are kept.
    rows: Vec<RowError>,
    row_readings: Vec<RowReadings>,
    /// Usable rows.
    data: Data,
}

impl Evaluated {
    fn of_points(setup: &Setup, mut data: Data, keep: bool, notes: &mut dyn Notes) -> Result<Self> {
        errors::leave_out(setup, &mut data)?;
        let unit = setup.description.length.symbol();
        let numbers = if setup.pose || setup.ideal.targets_of(0).len() > 1 { 6 } else { 3 };
        let mut sizes = vec![RunningSums::default(); numbers + 1];
        let (errors, mut norms) = (Errors::new(setup), identify::Distances::default());
        let again = visited_again(&data.observations);
        let (mut visits, mut rows) = (Vec::new(), Vec::new());
        for (i, row) in data.observations.iter().enumerate() {
            if i.is_multiple_of(PROGRESS_STEP) {
                notes.progress(i, data.observations.len());
                notes.go_on()?;
            }
            let row = errors.row_error(row).about(&data.file)?;
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
        let of = |i: usize, name, unit| Size::new(name, unit, &sizes[i]);
        let mut errors: Vec<Size> = (0..3).map(|i| of(i, ["x", "y", "z"][i], unit)).collect();
        errors.push(of(numbers, "norm", unit));
        errors.extend((3..numbers).map(|i| of(i, ["about x", "about y", "about z"][i - 3], "rad")));
        let explained = explained::explained(setup, &data.observations).about(&data.file)?;
        let (instruments, row_readings) = (Vec::new(), Vec::new());
        Ok(Self { errors, instruments, explained, norms, visits, rows, row_readings, data })
    }

    fn of_readings(setup: &Setup, all: &Instruments, data: Data) -> Result<Self> {
        let Readings { instruments, explained, rows: row_readings, norms } =
            readings(setup, all, &data).about(&data.file)?;
        let (errors, norms, visits, rows) = (Vec::new(), norms.into_figures(), Vec::new(), Vec::new());
        Ok(Self { errors, instruments, explained, norms, visits, rows, row_readings, data })
    }
}

impl Report {
    /// Returns ΔX of the measured points, before and after the prediction by the repeatable sources
    /// of the spec is subtracted; `None` for instruments that measure no points, and without rows.
    pub fn residuals(&self) -> Option<Residuals> {
        let position = |error: &[f64; 6]| [error[0], error[1], error[2]];
        let (ideal, predicted) = ("measured − ideal", "measured − predicted");
        let (before, after) = match self.explained.repeatable {
            0 => (None, ideal),
            _ => (Some(ideal), predicted),
        };
        Residuals::new(before, after, &self.row_errors, |row| {
            let RowError { observation, error, point, residual } = row;
            let station = &self.stations[observation.station as usize];
            let after = position(if before.is_some() { residual } else { error });
            let before = before.map(|_| position(error));
            Residual { before, ..Residual::new(observation, &observation.q, *point, after) }.in_f0(station)
        })
    }

    /// Returns the table of the rows: ΔX, the tool point predicted by the machine with its
    /// repeatable sources, and measured minus predicted; or readings minus prediction and
    /// predictions.
    pub fn table(&self) -> Table {
        if !self.instruments.is_empty() {
            return self.readings_table();
        }
        let names = ["x", "y", "z", "about_x", "about_y", "about_z"];
        let units = [self.length, self.length, self.length, "rad", "rad", "rad"];
        // One less without the norm.
        let shown = self.errors.len() - 1;
        let mut columns = vec![("line".to_owned(), "")];
        for (prefix, shown) in [("", shown), ("predicted_", 3), ("residual_", shown)] {
            let named = names.iter().zip(units).take(shown);
            columns.extend(named.map(|(name, unit)| (format!("{prefix}{name}"), unit)));
        }
        let rows = self.row_errors.iter().map(|row| {
            let mut values = vec![row.observation.line as f64];
            values.extend(&row.error[..shown]);
            values.extend(row.predicted());
            values.extend(&row.residual[..shown]);
            values.into_iter().map(Some).collect()
        });
        let (heading, units) = columns.into_iter().map(|(name, unit)| (name, unit.to_owned())).unzip();
        Table { heading, units, rows: rows.collect(), ..Table::default() }
    }

    fn readings_table(&self) -> Table {
        let line = std::iter::once("line".to_owned());
        let predicted = self.numbers.iter().map(|name| format!("predicted_{name}"));
        let rows = self.row_readings.iter().map(|row| {
            let values = row.left.iter().chain(&row.predicted).copied();
            std::iter::once(Some(row.line as f64)).chain(values).collect()
        });
        let units =
            std::iter::once(String::new()).chain([&self.number_units; 2].into_iter().flatten().cloned());
        Table {
            units: units.collect(),
            heading: line.chain(self.numbers.iter().cloned()).chain(predicted).collect(),
            rows: rows.collect(),
            ..Table::default()
        }
    }
}
