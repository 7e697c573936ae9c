//! The control charts: a moving average for every error, and one for what is left.

use abbe::control::{SelfStarting, ewma_limit};
use serde::Serialize;

use super::numbers::Numbers;
use super::options::Settings;
use super::single_errors::SingleErrors;
use super::vectors::{norm, product};

/// The chart of one error, or of what is left.
#[derive(Clone, Debug, Serialize)]
pub struct Chart {
    /// The error that it watches.
    pub name: String,
    /// The unit of its values.
    pub unit: &'static str,
    /// Errors that act as it does at these configurations.
    pub alike: Vec<String>,
    /// The error at every check, as if all others stayed what they are; of what is left its norm, in units of the instrument's
    /// uncertainty.
    pub values: Vec<f64>,
    /// The moving average at every check, as a share of the limit: an alarm beyond ±1, of what is left beyond 1.
    pub average: Vec<f64>,
    /// The first check that is beyond, from 0.
    pub alarm: Option<usize>,
}

/// Where averages alarm.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Limit {
    /// On average one false alarm in so many checks, at most, over all charts together.
    pub checks_per_false_alarm: f64,
    /// The weight of a new check in an average.
    pub lambda: f64,
    /// In standard deviations of an average.
    pub limit: f64,
}

impl Limit {
    /// For so many charts.
    ///
    /// For Gaussian numbers, whatever correlation they have, the probability that no chart alarms is at least the product of those
    /// of each (Royen's Gaussian correlation inequality, 2014): with `n` charts, each of `n` times the run length, there is no more
    /// than one false alarm in a run length.
    pub(super) fn new(settings: &Settings, charts: usize) -> Self {
        let Settings { checks_per_false_alarm, lambda, .. } = *settings;
        let limit = ewma_limit(lambda, checks_per_false_alarm * charts.max(1) as f64);
        Self { checks_per_false_alarm, lambda, limit }
    }

    /// The average as a share of the limit, from the standard normal numbers of a chart.
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

/// The charts of all errors, and that of what is left.
pub(super) fn charts(errors: &SingleErrors, numbers: &Numbers, limit: &Limit) -> (Vec<Chart>, Chart) {
    let chart = |(first, others): &(usize, Vec<usize>)| {
        let single = &errors.list[*first];
        let values: Vec<f64> = numbers.checks.iter().map(|check| value(&single.column, check)).collect();
        let mut series = SelfStarting::default();
        let average = limit.averages(values.iter().map(|value| series.next(*value)));
        Chart {
            name: single.name.clone(),
            unit: single.unit,
            alike: others.iter().map(|k| errors.list[*k].name.clone()).collect(),
            alarm: average.iter().position(|share| share.abs() > 1.0),
            values,
            average,
        }
    };
    (errors.charts.iter().map(chart).collect(), left(numbers, limit))
}

/// The least squares estimate of an error from the numbers of a check, as if it were the only one.
pub(super) fn value(column: &[f64], check: &[f64]) -> f64 {
    product(column, check) / product(column, column)
}

/// The norm of what differs from the checks before.
///
/// `w_k = √((k−1)/k) (r_k − r̄_{k−1})` are independent where the `r_k` are, and `|w|^{2/3}`, a cube root of a sum of squares, is
/// nearly normal (Wilson and Hilferty, 1931).
fn left(numbers: &Numbers, limit: &Limit) -> Chart {
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
        name: "what is left".to_owned(),
        unit: "",
        alike: Vec::new(),
        alarm: average.iter().position(|share| *share > 1.0),
        values: norms,
        average,
    }
}
