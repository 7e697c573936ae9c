//! Finds readings in another unit than the map states, before a fit takes them for a larger or
//! smaller machine.

use abbe::identify::{Failure, Measurement, SizeInformation};

use super::setup::Setup;
use crate::data::{Data, Instrument, Map};
use crate::interpretations::LENGTHS;
use abbe_study::{About, Result, mistake, number::digits};

/// Relative deviation of a ratio from that of two units at which they explain it.
const NEAR: f64 = 0.1;

/// Ratios of reading and prediction that are no other unit.
const PLAUSIBLE: [f64; 2] = [0.5, 2.0];

/// Correlation of readings and predictions from which their ratio is that of two units.
const CORRELATED: f64 = 0.99;

/// Least number of readings.
const LEAST: usize = 5;

/// Returns an error if the readings of an instrument are as large as the nominal machine predicts
/// in another unit than that of the map.
pub(super) fn check_reading_units(setup: &Setup, map: &Map, data: &Data) -> Result<()> {
    let Some(all) = map.instruments() else { return Ok(()) };
    let pairs = pairs(setup, data).about(&data.file)?;
    let metres = setup.description.length.in_metres();
    for instrument in &all.list {
        let Some(ratio) = ratio(setup, instrument, &pairs[instrument.observables.start]) else { continue };
        if (PLAUSIBLE[0]..PLAUSIBLE[1]).contains(&ratio) {
            continue;
        }
        // A reading in the unit u, read in the unit of the map, is unit of the map / u as large.
        let stated = instrument.factor * metres;
        let is_it = |(_, unit): &&(&str, f64)| (ratio * unit / stated - 1.0).abs() < NEAR;
        if let Some((unit, _)) = LENGTHS.iter().find(is_it) {
            let message = format!(
                "the readings of `{}` are {} times what the nominal machine predicts",
                instrument.name.escape_debug(),
                digits(ratio, 3)
            );
            let help = format!("are they in {unit}, not {}? Then write `unit = \"{unit}\"`", instrument.unit);
            return Err(mistake::with_help(&data.file, message, help));
        }
    }
    Ok(())
}

/// Returns each reading with the prediction of the nominal machine, for each observable.
fn pairs(setup: &Setup, data: &Data) -> Result<Vec<Vec<(f64, f64)>>, Failure> {
    let mut at = setup.ideal.at(&[]);
    let mut pairs = vec![Vec::new(); setup.ideal.observables.len()];
    for row in &data.observations {
        let Measurement::Readings(readings) = &row.measured else { continue };
        for ((pairs, reading), value) in pairs.iter_mut().zip(readings).zip(at.values(row)?) {
            pairs.extend(reading.map(|reading| (reading, value)));
        }
    }
    Ok(pairs)
}

/// Returns the ratio of readings and predictions: of their means where the zero is known, otherwise
/// of their variations. None if they are no lengths, or say nothing about the ratio.
fn ratio(setup: &Setup, instrument: &Instrument, pairs: &[(f64, f64)]) -> Option<f64> {
    let observable = &setup.ideal.observables[instrument.observables.start];
    let is_length =
        !instrument.kind.is_angle && !instrument.kind.is_touched() && instrument.kind.numbers == 1;
    if !is_length || pairs.len() < LEAST {
        return None;
    }
    let count = pairs.len() as f64;
    let (reading, value) = pairs.iter().fold((0.0, 0.0), |(a, b), (r, v)| (a + r / count, b + v / count));
    if instrument.kind.size == SizeInformation::Length && observable.zero_known && observable.zero == 0.0 {
        return (value > 0.0 && reading > 0.0).then_some(reading / value);
    }
    let sum = |product: fn(f64, f64) -> f64| -> f64 {
        pairs.iter().map(|(r, v)| product(r - reading, v - value)).sum()
    };
    let (both, readings, values) = (sum(|r, v| r * v), sum(|r, _| r * r), sum(|_, v| v * v));
    (both > CORRELATED * (readings * values).sqrt()).then_some(both / values)
}
