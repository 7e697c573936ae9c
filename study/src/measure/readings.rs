//! Readings against what the machine predicts: instrument by instrument, each in its own unit.

use abbe::identify::{Distances, Failure, Measurement, Model, Observation};
use serde::Serialize;

use super::explained::Explained;
use crate::data::{Data, Instrument, Instruments, Kind};
use crate::identify::Setup;

/// An instrument, and how far its readings are from what is predicted.
#[derive(Clone, Debug, Serialize)]
pub struct InstrumentErrors {
    /// What the map calls it.
    pub name: String,
    /// The unit of the figures: that of its column.
    pub unit: String,
    /// How often it was read.
    pub count: usize,
    /// At how many independent configurations.
    pub configurations: usize,
    /// Whether it reads angles.
    #[serde(skip)]
    pub(super) angle: bool,
    /// One standard deviation of a number, as stated; none if the data were to tell it.
    pub uncertainty: Option<f64>,
    /// From what the ideal machine would show.
    pub ideal: ReadingErrors,
    /// From what the machine with the repeatable sources of its spec would show.
    pub left: ReadingErrors,
}

/// Reading minus prediction; of three coordinates that are read at once the norm.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct ReadingErrors {
    /// The mean.
    pub mean: f64,
    /// The standard error of that, configurations counted; none if there is only one.
    pub standard_error: Option<f64>,
    /// The root mean square.
    pub rms: f64,
    /// The largest, either sign.
    pub max: f64,
}

/// What is left of every number of a row: reading minus prediction in the unit of its instrument, none where it was not read.
#[derive(Clone, Debug)]
pub struct RowReadings {
    /// Its line in the file.
    pub line: u64,
    /// Number by number, in the order of the instruments.
    pub left: Vec<Option<f64>>,
}

/// All that readings say of a machine.
pub(super) struct Readings {
    pub(super) instruments: Vec<InstrumentErrors>,
    pub(super) explained: Explained,
    pub(super) rows: Vec<RowReadings>,
    /// The norms of what the ideal machine leaves of lengths.
    pub(super) norms: Distances,
}

pub(super) fn readings(setup: &Setup, all: &Instruments, data: &Data) -> Result<Readings, Failure> {
    let rows = &data.observations;
    let (ideal, left) = (differences(&setup.ideal, rows)?, differences(&setup.real, rows)?);
    let instruments = all.list.iter().filter_map(|instrument| {
        let errors = |of: &[Vec<Option<f64>>]| ReadingErrors::new(&of_instrument(instrument, rows, of));
        let read = of_instrument(instrument, rows, &left).into_figures();
        (read.count > 0).then(|| InstrumentErrors {
            name: instrument.name.clone(),
            unit: instrument.unit.clone(),
            count: read.count,
            configurations: read.configurations,
            angle: instrument.kind == Kind::Angle,
            uncertainty: instrument.uncertainty.map(|sigma| sigma / instrument.factor),
            ideal: errors(&ideal),
            left: errors(&left),
        })
    });
    // Numbers of all units count by their uncertainty.
    let squares = |of: &[Vec<Option<f64>>]| -> f64 {
        let numbers = of.iter().flat_map(|row| row.iter().zip(&setup.real.readings));
        numbers.filter_map(|(number, reading)| Some(((*number)? / reading.uncertainty).powi(2))).sum()
    };
    let share = 1.0 - squares(&left) / squares(&ideal).max(f64::MIN_POSITIVE);
    let norms = setup.ideal.all_distances(rows, &[])?;
    let in_units = |row: &[Option<f64>]| {
        let numbers = row.iter().zip(&setup.real.readings);
        let own = |reading: usize| all.list[reading].factor;
        numbers.map(|(number, reading)| Some((*number)? / own(reading.instrument))).collect()
    };
    Ok(Readings {
        instruments: instruments.collect(),
        explained: Explained::of_readings(setup, rows, share)?,
        rows: rows
            .iter()
            .zip(&left)
            .map(|(row, left)| RowReadings { line: row.line, left: in_units(left) })
            .collect(),
        norms,
    })
}

/// Reading minus model, row by row and number by number.
fn differences(model: &Model, rows: &[Observation]) -> Result<Vec<Vec<Option<f64>>>, Failure> {
    let mut room = model.room();
    let difference = |row: &Observation| {
        let Measurement::Readings(readings) = &row.measured else { return Ok(Vec::new()) };
        let values = model.values(&mut room, row, &[])?;
        Ok(readings.iter().zip(values).map(|(reading, value)| Some((*reading)? - value)).collect())
    };
    rows.iter().map(difference).collect()
}

/// Of one instrument, in its unit, each with its configuration: its number, or the norm of its three.
fn of_instrument(instrument: &Instrument, rows: &[Observation], of: &[Vec<Option<f64>>]) -> Distances {
    let one = |(row, numbers): (&Observation, &Vec<Option<f64>>)| {
        let own = &numbers[instrument.readings.clone()];
        let size = match own {
            [number] => (*number)?,
            several => several.iter().map(|number| Some((*number)?.powi(2))).sum::<Option<f64>>()?.sqrt(),
        };
        Some((row.configuration, size / instrument.factor))
    };
    rows.iter().zip(of).filter_map(one).collect()
}

impl InstrumentErrors {
    /// Whether it reads angles.
    pub fn is_angle(&self) -> bool {
        self.angle
    }
}

impl ReadingErrors {
    fn new(errors: &Distances) -> Self {
        let figures = errors.figures();
        Self {
            mean: figures.mean + 0.0,
            standard_error: Some(figures.standard_error).filter(|error| error.is_finite()),
            rms: figures.rms,
            max: errors.values().iter().fold(0.0, |most: f64, error| most.max(error.abs())),
        }
    }
}
