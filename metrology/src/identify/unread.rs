//! Instruments that the fitted rows never read: their places and zeros stay unknown.

use std::borrow::Cow;

use abbe::identify::{Measurement, Model, Observation};

use crate::data::Data;

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
pub(super) fn without_unread<'d>(
    model: &Model,
    fitted: &[Observation],
    test: Cow<'d, Data>,
) -> Option<Cow<'d, Data>> {
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
