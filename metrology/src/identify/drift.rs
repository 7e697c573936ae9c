//! Describes drift of the residuals with the row order.

use abbe::LengthUnit;
use abbe::identify::{Drift, Follows};
use serde::Serialize;

use abbe_study::number::{self, digits, percent};

/// False-alarm rate of the test.
const FALSE_ALARMS: f64 = 0.01;

/// Autocorrelation and drift of the residuals over time.
#[derive(Clone, Debug, Serialize)]
pub struct ResidualDrift {
    /// Lag-1 autocorrelation of the residuals.
    pub lag_1: f64,
    /// Probability of such an autocorrelation in a random row order.
    pub p_of_lag_1: f64,
    /// Quantity that follows time best: `x`, `y`, `z` or `distance`.
    pub follows: &'static str,
    /// Time constant of the settling as a share of the run; none for a linear drift.
    pub settling: Option<f64>,
    /// Change of that quantity from the first row to the last, in the length unit.
    pub change: f64,
    /// Probability of following time as well in a random row order.
    pub p: f64,
    /// Is true if `p` is at most the false-alarm rate.
    pub is_drift: bool,
    /// False-alarm rate of the test.
    pub false_alarms: f64,
    /// Mean residual distance of the first tenth and of the last tenth of the rows, in the length
    /// unit.
    pub ends: [f64; 2],
    /// Statement of the result in words.
    pub sentence: String,
    /// First clause of the statement.
    #[serde(skip)]
    pub summary: String,
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
            "distance" => "their distance".to_owned(),
            axis => format!("along {axis}"),
        };
        let by = length(change.abs());
        let of_ends = format!(
            "Mean error of the first tenth of the rows {}, of the last {}.",
            length(ends[0]),
            length(ends[1])
        );
        let (summary, rest) = match (is_drift, settling) {
            (true, Some(share)) => (
                format!(
                    "The residuals may settle with time, {what} by {by} with a time constant of \
                     {} of the run",
                    percent(share, 1.0)
                ),
                format!(
                    "; the machine may be warming up, or a mounting settling. {of_ends} Measure \
                     when the machine is warm, or leave the first rows out."
                ),
            ),
            (true, None) => (
                format!("The residuals may drift with time, {what} by {by} from the first row to the last"),
                format!(". {of_ends}"),
            ),
            (false, _) if p_of_lag_1 <= FALSE_ALARMS => (
                format!("The residuals show no drift, but successive rows are correlated ({lag})"),
                ": the machine may have errors that the model does not have and that change \
                 slowly along the measured path. Standard deviations may be too small."
                    .to_owned(),
            ),
            _ => ("The residuals show no drift with the order of the rows".to_owned(), ".".to_owned()),
        };
        let sure = match is_drift || p_of_lag_1 <= FALSE_ALARMS {
            true => format!(
                " Correlation of successive rows {lag} (permutation test, false-alarm rate 1 in \
                 {:.0}).",
                1.0 / FALSE_ALARMS
            ),
            false => String::new(),
        };
        let sentence = summary.clone() + &rest + &sure;
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
            summary,
        }
    }
}
