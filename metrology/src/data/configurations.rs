//! Grouping of rows into configurations: joints and inputs that agree within their resolution.

use abbe::identify::Observation;
use abbe_spec::{Spec, expr::Unit};

use abbe_study::workspace::has_range;

/// Resolution of angles, in rad.
const ANGLE: f64 = 1e-4;

/// Resolution of an input, as a share of its range.
const SHARE: f64 = 0.01;

/// Returns the resolution of each variable and then of each input; 0.01 mm for lengths.
pub(super) fn resolution(spec: &Spec) -> Vec<Option<f64>> {
    let travel = Unit::named("mm").unwrap_or(Unit::NONE).convert(0.01, spec.length);
    let joints = spec.variables.iter().map(|variable| variable.kind.either(Some(ANGLE), Some(travel)));
    let inputs = spec.inputs.iter().map(|input| {
        let [lower, upper] = input.range;
        has_range(input).then_some(SHARE * (upper - lower))
    });
    joints.chain(inputs).collect()
}

/// Numbers the configurations of rows from 0 in order of first occurrence.
pub(super) fn number_configurations(rows: &mut [Observation], resolution: &[Option<f64>]) {
    // Refines the groups column by column.
    let mut numbers = vec![0; rows.len()];
    for (i, resolution) in resolution.iter().enumerate() {
        let values: Vec<f64> =
            rows.iter().map(|row| *row.q.iter().chain(row.u.iter()).nth(i).unwrap_or(&0.0)).collect();
        numbers = numbered(&numbers, &levels(&values, *resolution));
    }
    rows.iter_mut().zip(numbers).for_each(|(row, number)| row.configuration = number);
}

/// Numbers pairs from 0 in order of first occurrence, by sorting, because there can be a million.
fn numbered(first: &[u32], second: &[u32]) -> Vec<u32> {
    let mut order: Vec<u32> = (0..first.len() as u32).collect();
    let pair = |i: u32| (first[i as usize], second[i as usize]);
    order.sort_unstable_by_key(|i| (pair(*i), *i));
    // First row of each pair, stored for all of its rows.
    let mut numbers = vec![0; order.len()];
    for rows in order.chunk_by(|a, b| pair(*a) == pair(*b)) {
        rows.iter().for_each(|i| numbers[*i as usize] = rows[0]);
    }
    drop(order);
    let mut next = 0;
    for i in 0..numbers.len() {
        // Earlier rows have their final numbers already.
        let first = numbers[i] as usize;
        numbers[i] = if first == i { next } else { numbers[first] };
        next += u32::from(first == i);
    }
    numbers
}

/// Numbers the levels of values.
///
/// A level begins at its least value and has all values within the resolution of that one. Without
/// a resolution, it is a share of the range of the values.
fn levels(values: &[f64], resolution: Option<f64>) -> Vec<u32> {
    let mut order: Vec<u32> = (0..values.len() as u32).collect();
    let value = |i: u32| values[i as usize];
    order.sort_unstable_by(|a, b| value(*a).total_cmp(&value(*b)));
    let span = order.first().zip(order.last()).map_or(0.0, |(first, last)| value(*last) - value(*first));
    let resolution = resolution.unwrap_or(SHARE * span);
    let (mut level, mut begins) = (0, f64::NEG_INFINITY);
    let mut levels = vec![0; values.len()];
    for i in order {
        if value(i) - begins > resolution {
            (level, begins) = (level + 1, value(i));
        }
        levels[i as usize] = level;
    }
    levels
}

#[cfg(test)]
mod tests;
