//! Control charts: an exponentially weighted moving average (EWMA) for every error, and one for the
//! residual.

use abbe::control::{SelfStarting, ewma_limit};
use serde::Serialize;

use super::check_values::CheckValues;
use super::options::Settings;
use super::single_errors::SingleErrors;
use super::vectors::{norm, product};

/// Control chart of one error, or of the residual.
#[derive(Clone, Debug, Serialize)]
pub struct Chart {
    /// Name of the error, or `what is left` for the residual.
    pub name: String,
    /// Unit of the values; empty for the residual.
    pub unit: &'static str,
    /// Errors that are indistinguishable from this one at the monitored configurations.
    pub indistinguishable: Vec<String>,
    /// Value at every check: the error under the assumption that all others are unchanged, in
    /// `unit`; for the residual, its norm in units of the instrument's uncertainty.
    pub values: Vec<f64>,
    /// EWMA at every check, as a share of the limit. An alarm is a value beyond ±1 for an error,
    /// above 1 for the residual.
    pub average: Vec<f64>,
    /// Index of the first check beyond the limit, from 0.
    pub alarm: Option<usize>,
}

/// Control limit of the moving averages.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Limit {
    /// Smallest mean number of checks between false alarms, over all charts together.
    pub checks_per_false_alarm: f64,
    /// Weight of a new check in an average, a factor from 0 to 1.
    pub lambda: f64,
    /// Limit as a factor of the standard deviation of an average.
    pub limit: f64,
}

impl Limit {
    /// Computes the limit for a number of charts.
    ///
    /// For Gaussian values of any correlation, the probability that no chart alarms is at least the
    /// product of the probabilities of the single charts (Royen's Gaussian correlation inequality,
    /// 2014). Each of `n` charts therefore has `n` times the required run length.
    pub(super) fn new(settings: &Settings, charts: usize) -> Self {
        let Settings { checks_per_false_alarm, lambda, .. } = *settings;
        let limit = ewma_limit(lambda, checks_per_false_alarm * charts.max(1) as f64);
        Self { checks_per_false_alarm, lambda, limit }
    }

    /// Computes the averages as shares of the limit from the standard normal values of a chart.
    fn averages(&self, standard: impl Iterator<Item = f64>) -> Vec<f64> {
        let most = self.limit * (self.lambda / (2.0 - self.lambda)).sqrt();
        let mut average = 0.0;
        let next = standard.map(|q| {
            average += self.lambda * (q - average);
            average / most
        });
        next.collect()
    }
}

/// Returns the charts of all errors and the chart of the residual.
pub(super) fn charts(errors: &SingleErrors, numbers: &CheckValues, limit: &Limit) -> (Vec<Chart>, Chart) {
    let chart = |(first, others): &(usize, Vec<usize>)| {
        let single = &errors.list[*first];
        let values: Vec<f64> = numbers.checks.iter().map(|check| value(&single.column, check)).collect();
        let mut series = SelfStarting::default();
        let average = limit.averages(values.iter().map(|value| series.next(*value)));
        Chart {
            name: single.name.clone(),
            unit: single.unit,
            indistinguishable: others.iter().map(|k| errors.list[*k].name.clone()).collect(),
            alarm: average.iter().position(|share| share.abs() > 1.0),
            values,
            average,
        }
    };
    (errors.charts.iter().map(chart).collect(), residual_chart(numbers, limit))
}

/// Estimates an error from the values of a check by least squares, with all other errors unchanged.
pub(super) fn value(column: &[f64], check: &[f64]) -> f64 {
    product(column, check) / product(column, column)
}

/// Returns the chart of the norm of the deviation from the preceding checks.
///
/// `w_k = √((k−1)/k) (r_k − r̄_{k−1})` are independent if the `r_k` are, and `|w|^{2/3}`, the cube
/// root of a sum of squares, is nearly normal (Wilson and Hilferty, 1931).
fn residual_chart(numbers: &CheckValues, limit: &Limit) -> Chart {
    let mut mean: Vec<f64> = Vec::new();
    let free = (numbers.free().max(1) as f64).sqrt();
    let mut norms = Vec::new();
    for (k, check) in numbers.checks.iter().enumerate() {
        mean.resize(check.len(), 0.0);
        let n = k as f64;
        let away: Vec<f64> = check.iter().zip(&mean).map(|(number, mean)| number - mean).collect();
        mean.iter_mut().zip(&away).for_each(|(mean, away)| *mean += away / (n + 1.0));
        norms.push(if k == 0 { 0.0 } else { norm(&away) * (n / (n + 1.0)).sqrt() / free });
    }
    let mut series = SelfStarting::default();
    let first = norms.iter().take(1).map(|_| 0.0);
    let standard: Vec<f64> =
        first.chain(norms.iter().skip(1).map(|norm| series.next(norm.powf(2.0 / 3.0)))).collect();
    let average = limit.averages(standard.into_iter());
    Chart {
        name: "residual change".to_owned(),
        unit: "",
        indistinguishable: Vec::new(),
        alarm: average.iter().position(|share| *share > 1.0),
        values: norms,
        average,
    }
}
