//! Drift of the residuals with the order of the rows, in words.

use abbe::LengthUnit;
use abbe::identify::{Drift, Follows};
use serde::Serialize;

use crate::number::{self, digits, percent};

/// False-alarm rate of the test.
const FALSE_ALARMS: f64 = 0.01;

/// Correlation and drift of the residuals over time.
#[derive(Clone, Debug, Serialize)]
pub struct ResidualDrift {
    /// The correlation of what is left with what is left of the next row.
    pub lag_1: f64,
    /// How likely that is in a random order.
    pub p_of_lag_1: f64,
    /// What follows time best: `x`, `y`, `z` or `distance`.
    pub follows: &'static str,
    /// The time constant as a share of the time that was taken; none for a straight line.
    pub settling: Option<f64>,
    /// By how much that changes from the first row to the last: the length unit.
    pub change: f64,
    /// How likely it follows time as well in a random order.
    pub p: f64,
    /// Whether that is called a drift.
    pub is_drift: bool,
    /// The rate of false alarms of that.
    pub false_alarms: f64,
    /// The mean distance of the first tenth of the rows, and of the last.
    pub ends: [f64; 2],
    /// All this as a sentence.
    pub sentence: String,
}

impl ResidualDrift {
    pub(crate) fn new(drift: Drift, unit: LengthUnit) -> Self {
        let Drift { lag_1, p_of_lag_1, follows, settling, change, p, ends } = drift;
        let follows = match follows {
            Follows::Axis(axis) => ["x", "y", "z"][axis],
            Follows::Distance => "distance",
        };
        let is_drift = p <= FALSE_ALARMS;
        let length = |value: f64| number::length(value, unit);
        let lag = digits(lag_1, 2);
        let what = match follows {
            "distance" => "its distance from the machine".to_owned(),
            axis => format!("it along {axis}"),
        };
        let sentence = match (is_drift, settling) {
            (true, Some(share)) => format!(
                "What is left settles with time, {what} by {} with a time constant of {} of the run: the machine warms up, or what \
                 holds it or the instrument settles. The first tenth of the rows is off by {} on average, the last by {}. \
                 Measure when it is warm, or leave the first rows out.",
                length(change.abs()),
                percent(share, 1.0),
                length(ends[0]),
                length(ends[1]),
            ),
            (true, None) => format!(
                "What is left drifts with time, {what} by {} from the first row to the last. The first tenth of the rows is off \
                 by {} on average, the last by {}.",
                length(change.abs()),
                length(ends[0]),
                length(ends[1]),
            ),
            (false, _) if p_of_lag_1 <= FALSE_ALARMS => format!(
                "What is left does not drift with time, but rows that follow each other are alike (correlation {lag}): the machine has \
                 errors that this model has not, and that change slowly along the way that was measured. So the rows say less than \
                 their number promises, and standard deviations may be too small.",
            ),
            _ => "What is left does not follow the order of the rows.".to_owned(),
        };
        let sure = match is_drift || p_of_lag_1 <= FALSE_ALARMS {
            true => format!(
                " Correlation with the next row {lag}. (A permutation test: of runs without drift 1 in {:.0} is called this.)",
                1.0 / FALSE_ALARMS
            ),
            false => String::new(),
        };
        let sentence = sentence + &sure;
        Self {
            lag_1,
            p_of_lag_1,
            follows,
            settling,
            change,
            p,
            is_drift,
            false_alarms: FALSE_ALARMS,
            ends,
            sentence,
        }
    }
}
