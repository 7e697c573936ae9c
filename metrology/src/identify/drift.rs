//! Tests drift of the residuals with the row order.

use abbe::identify::Drift;
use serde::Serialize;

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
}

impl ResidualDrift {
    pub(crate) fn new(drift: Drift) -> Self {
        let Drift { lag_1, p_of_lag_1, follows, settling, change, p, ends } = drift;
        let (is_drift, false_alarms) = (p <= FALSE_ALARMS, FALSE_ALARMS);
        Self { lag_1, p_of_lag_1, follows, settling, change, p, is_drift, false_alarms, ends }
    }
}
