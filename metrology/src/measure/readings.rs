//! Readings compared with the prediction, for each instrument in its own unit.

use abbe::identify::{Distances, Failure, Measurement, Model, Observation};
use serde::Serialize;

use super::explained::Explained;
use crate::data::{Data, Instrument, Instruments};
use crate::identify::Setup;

/// An instrument, and its readings minus prediction.
#[derive(Clone, Debug, Serialize)]
pub struct InstrumentErrors {
    /// Name in the map.
    pub name: String,
    /// Unit of the figures, that of its column.
    pub unit: String,
    /// Number of readings.
    pub count: usize,
    /// Number of independent configurations.
    pub configurations: usize,
    /// Readings are angles.
    #[serde(skip)]
    pub(super) angle: bool,
    /// Stated standard deviation of a reading, in `unit`; none if it was estimated from the data.
    pub uncertainty: Option<f64>,
    /// Reading minus the ideal machine.
    pub ideal: ReadingErrors,
    /// Reading minus the machine with the repeatable sources of the spec.
    pub left: ReadingErrors,
}

/// Figures of reading minus prediction; of the norm where an instrument reads three coordinates.
/// They are in the `unit` of the instrument.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct ReadingErrors {
    /// The mean.
    pub mean: f64,
    /// Cluster-robust standard error of the mean; none for a single configuration.
    pub standard_error: Option<f64>,
    /// The root mean square.
    pub rms: f64,
    /// The largest absolute value.
    pub max: f64,
}

/// Readings minus prediction of a row, in the units of the instruments.
#[derive(Clone, Debug)]
pub struct RowReadings {
    /// Line in the file.
    pub line: u64,
    /// Differences in the order of the instruments; none where there is no reading.
    pub left: Vec<Option<f64>>,
    /// Predictions in the order of the instruments; none where there is no reading.
    pub predicted: Vec<Option<f64>>,
}

/// Results for readings.
pub(super) struct Readings {
    pub(super) instruments: Vec<InstrumentErrors>,
    pub(super) explained: Explained,
    pub(super) rows: Vec<RowReadings>,
    /// Norms of reading minus ideal machine, for lengths.
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
            angle: instrument.kind.is_angle,
            uncertainty: instrument.uncertainty.map(|sigma| sigma / instrument.factor),
            ideal: errors(&ideal),
            left: errors(&left),
        })
    });
    // Normalized by uncertainty, so that all units add.
    let squares = |of: &[Vec<Option<f64>>]| -> f64 {
        let numbers = of.iter().flat_map(|row| row.iter().zip(&setup.real.observables));
        numbers.filter_map(|(number, reading)| Some(((*number)? / reading.uncertainty).powi(2))).sum()
    };
    let share = 1.0 - squares(&left) / squares(&ideal).max(f64::MIN_POSITIVE);
    let norms = setup.ideal.all_distances(rows, &[])?;
    let in_units = |row: &[Option<f64>]| {
        let numbers = row.iter().zip(&setup.real.observables);
        let own = |reading: usize| all.list[reading].factor;
        numbers.map(|(number, reading)| Some((*number)? / own(reading.instrument))).collect()
    };
    Ok(Readings {
        instruments: instruments.collect(),
        explained: Explained::of_readings(setup, rows, share)?,
        rows: rows
            .iter()
            .zip(&left)
            .map(|(row, left)| RowReadings {
                line: row.line,
                left: in_units(left),
                predicted: in_units(&predicted(row, left)),
            })
            .collect(),
        norms,
    })
}

/// Returns the predictions of a row from its readings minus prediction.
fn predicted(row: &Observation, left: &[Option<f64>]) -> Vec<Option<f64>> {
    let Measurement::Readings(readings) = &row.measured else { return Vec::new() };
    readings.iter().zip(left).map(|(reading, left)| Some((*reading)? - (*left)?)).collect()
}

/// Returns reading minus model for each row.
fn differences(model: &Model, rows: &[Observation]) -> Result<Vec<Vec<Option<f64>>>, Failure> {
    let mut at = model.at(&[]);
    let difference = |row: &Observation| {
        let Measurement::Readings(readings) = &row.measured else { return Ok(Vec::new()) };
        Ok(readings.iter().zip(at.values(row)?).map(|(reading, value)| Some((*reading)? - value)).collect())
    };
    rows.iter().map(difference).collect()
}

/// Returns the differences of one instrument in its unit, with their configurations; the norm where
/// it has three, and for each corner that a camera sees.
fn of_instrument(instrument: &Instrument, rows: &[Observation], of: &[Vec<Option<f64>>]) -> Distances {
    let one = |(row, numbers): (&Observation, &Vec<Option<f64>>)| {
        let size = |own: &[Option<f64>]| match own {
            [number] => *number,
            several => {
                let square = several.iter().map(|number| Some((*number)?.powi(2))).sum::<Option<f64>>();
                square.map(f64::sqrt)
            }
        };
        let own = numbers[instrument.observables.clone()].chunks(instrument.kind.numbers);
        let sizes = own.filter_map(|own| Some((row.configuration, size(own)? / instrument.factor)));
        sizes.collect::<Vec<_>>()
    };
    rows.iter().zip(of).flat_map(one).collect()
}

impl InstrumentErrors {
    /// Returns whether the readings are angles.
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
