//! Instruments that the fitted rows never read: their places and zeros stay unknown.

use std::borrow::Cow;

use abbe::identify::{Measurement, Model, Observation};
use abbe_spec::diagnostic::Diagnostics;
use abbe_spec::option::{MEASURE_NEW_STATION, TEST};

use crate::data::Data;
use abbe_study::{Result, mistake};

/// Returns for each observable whether its instrument was read in any of the rows.
pub(super) fn read(model: &Model, rows: &[Observation]) -> Vec<bool> {
    let mut instruments = Vec::new();
    for row in rows {
        let Measurement::Readings(readings) = &row.measured else { continue };
        for (observable, reading) in model.observables.iter().zip(readings) {
            if reading.is_some() && !instruments.contains(&observable.instrument) {
                instruments.push(observable.instrument);
            }
        }
    }
    model.observables.iter().map(|observable| instruments.contains(&observable.instrument)).collect()
}

/// Removes the readings of instruments that have an unknown place or zero and that the fit never
/// read, and the rows without any other.
///
/// Returns none if no row is left.
fn without_unread<'d>(model: &Model, fitted: &[Observation], test: Cow<'d, Data>) -> Option<Cow<'d, Data>> {
    let read = read(model, fitted);
    let unknown = model
        .observables
        .iter()
        .zip(read)
        .map(|(observable, read)| !read && (observable.fixture.is_some() || !observable.zero_known));
    let unknown: Vec<bool> = unknown.collect();
    if !unknown.contains(&true) {
        return Some(test);
    }
    let mut test = test.into_owned();
    test.observations.retain_mut(|row| {
        let Measurement::Readings(readings) = &mut row.measured else { return true };
        readings.iter_mut().zip(&unknown).filter(|(_, unknown)| **unknown).for_each(|(one, _)| *one = None);
        row.count() > 0
    });
    (!test.observations.is_empty()).then_some(Cow::Owned(test))
}

/// Returns the test rows at the stations of the fit, with the readings whose instruments it
/// located.
pub(super) fn comparable<'d>(test: &'d Data, data: &Data, model: &Model) -> Result<Cow<'d, Data>> {
    let placed = test.at_stations(data).map_err(|name| unknown_station(test, &name))?;
    without_unread(model, &data.observations, placed).ok_or_else(|| nothing_placed(&test.file))
}

fn unknown_station(test: &Data, name: &str) -> Diagnostics {
    let message = format!("there is no station `{}` in the fitted data", name.escape_debug());
    let help = format!("fit a station of the identified machine by `{MEASURE_NEW_STATION}`");
    mistake::with_help(&test.file, message, help)
}

/// Returns the error that the test rows read only instruments that the fitted rows do not read.
fn nothing_placed(file: &str) -> Diagnostics {
    let message = "the fitted rows read none of the instruments of these rows, whose places are unknown";
    let help =
        format!("fit rows that read the same instruments, or omit {TEST} and rely on cross-validation");
    mistake::with_help(file, message, help)
}
