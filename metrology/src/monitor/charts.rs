//! Control charts of every error and of all values together: each check against those before it,
//! and an exponentially weighted moving average (EWMA).
//!
//! A check is compared with the mean of the m checks before it that were not set apart themselves.
//! With its deviation `w = √(m/(m+1)) (r − r̄)` and ν free values, `|w|²/(ν σ²)` is F-distributed,
//! and so is `(cᵀ w)²/(cᵀc σ²)` for the column c of an error. σ² is what instrument and random
//! sources let expect, or the median of the mean squares of preceding differences, `|r_j −
//! r_{j−1}|²/2ν`, if that is larger: a jump moves one of them, an uncertainty that is stated too
//! small moves all. What is beyond a limit is set apart.

use abbe::control::{SelfStarting, ewma_limit};
use abbe::identify::f_beyond;
use serde::Serialize;

use super::{check_values::CheckValues, options::Settings, single_errors::SingleErrors, vectors::product};

/// Degrees of freedom of an expected variance.
const KNOWN: f64 = 1e4;

/// Share of the degrees of freedom of all preceding differences that their median has; consecutive
/// ones are correlated.
const OF_MEDIAN: f64 = 0.4;

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
    /// `unit`; for the residual, the root mean square of its deviation from the checks before, in
    /// units of the instrument's uncertainty.
    pub values: Vec<f64>,
    /// EWMA at every check, as a share of the limit. An alarm is a value beyond ±1. None for the
    /// residual.
    pub average: Vec<f64>,
    /// Deviation of every check from those before it, as a share of the limit. An alarm is a value
    /// beyond ±1.
    pub single: Vec<f64>,
    /// Index of the first check beyond a limit, from 0.
    pub alarm: Option<usize>,
}

impl Chart {
    /// Returns how far the chart is at a check, as a share of the nearer limit.
    pub fn share(&self, check: usize) -> f64 {
        let at = |shares: &[f64]| shares.get(check).map_or(0.0, |share| share.abs());
        at(&self.average).max(at(&self.single))
    }
}

/// Control limits.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Limit {
    /// Smallest mean number of checks between false alarms, over all charts together.
    pub checks_per_false_alarm: f64,
    /// Weight of a new check in an average, a factor from 0 to 1.
    pub lambda: f64,
    /// Limit as a factor of the standard deviation of an average.
    pub limit: f64,
    /// Probability with which one chart sets a single check apart by chance.
    pub chance: f64,
}

impl Limit {
    /// Computes the limits for a number of errors: two for each of them, and one for all values.
    ///
    /// For Gaussian values of any correlation, the probability that no chart alarms is at least the
    /// product of the probabilities of the single charts (Royen's Gaussian correlation inequality,
    /// 2014). Each of `n` limits therefore has `n` times the required run length.
    pub(super) fn new(settings: &Settings, errors: usize) -> Self {
        let Settings { checks_per_false_alarm, lambda, .. } = *settings;
        let length = checks_per_false_alarm * (2 * errors + 1) as f64;
        Self { checks_per_false_alarm, lambda, limit: ewma_limit(lambda, length), chance: 1.0 / length }
    }

    /// Returns the ratio of mean squares with these degrees of freedom that is exceeded by chance.
    fn ratio(&self, freedom: [f64; 2]) -> f64 {
        let [mut least, mut most] = [0.0, 1e6];
        for _ in 0..80 {
            let middle = 0.5 * (least + most);
            match f_beyond(middle, freedom[0], freedom[1]) > self.chance {
                true => least = middle,
                false => most = middle,
            }
        }
        most
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
    let single = SingleChecks::new(errors, numbers, limit);
    let chart = |(i, (first, others)): (usize, &(usize, Vec<usize>))| {
        let error = &errors.list[*first];
        let values: Vec<f64> = numbers.checks.iter().map(|check| value(&error.column, check)).collect();
        let mut series = SelfStarting::default();
        let average = limit.averages(values.iter().map(|value| series.next(*value)));
        let single: Vec<f64> = single.of_errors.iter().map(|shares| shares[i]).collect();
        let is_beyond = |(average, single): (&f64, &f64)| average.abs() > 1.0 || single.abs() > 1.0;
        Chart {
            name: error.name.clone(),
            unit: error.unit,
            indistinguishable: others.iter().map(|k| errors.list[*k].name.clone()).collect(),
            alarm: average.iter().zip(&single).position(is_beyond),
            values,
            average,
            single,
        }
    };
    let left = Chart {
        name: "residual change".to_owned(),
        unit: "",
        indistinguishable: Vec::new(),
        alarm: single.of_all.iter().position(|share| *share > 1.0),
        values: single.norms,
        average: Vec::new(),
        single: single.of_all,
    };
    (errors.charts.iter().enumerate().map(chart).collect(), left)
}

/// Estimates an error from the values of a check by least squares, with all other errors unchanged.
pub(super) fn value(column: &[f64], check: &[f64]) -> f64 {
    product(column, check) / product(column, column)
}

/// Deviations of every check from those before it.
#[derive(Default)]
struct SingleChecks {
    /// `√(|w|²/ν)`.
    norms: Vec<f64>,
    /// Shares of the limit of all values, and of that of each error.
    of_all: Vec<f64>,
    of_errors: Vec<Vec<f64>>,
}

impl SingleChecks {
    fn new(errors: &SingleErrors, numbers: &CheckValues, limit: &Limit) -> Self {
        let free = numbers.free().max(1) as f64;
        // Median of a mean square of ν normal numbers (Wilson and Hilferty, 1931).
        let median = (1.0 - 2.0 / (9.0 * free)).powi(3);
        let (mut all, mut differences) = (Self::default(), Vec::<f64>::new());
        let (mut mean, mut count) = (vec![0.0; numbers.checks.first().map_or(0, Vec::len)], 0.0);
        for (k, check) in numbers.checks.iter().enumerate() {
            differences.sort_by(f64::total_cmp);
            let seen = differences
                .get(differences.len().saturating_sub(1) / 2)
                .map_or(0.0, |square| square / median);
            let (variance, freedom) = match seen > numbers.expected {
                true => (seen, OF_MEDIAN * free * differences.len() as f64),
                false => (numbers.expected, KNOWN),
            };
            let root = f64::sqrt(count / (count + 1.0));
            let w: Vec<f64> = check.iter().zip(&mean).map(|(number, mean)| root * (number - mean)).collect();
            let square = product(&w, &w) / free;
            let of_all = (square / variance / limit.ratio([free, freedom])).sqrt();
            let most = (variance * limit.ratio([1.0, freedom])).sqrt();
            let of_error = |(first, _): &(usize, Vec<usize>)| {
                let column = &errors.list[*first].column;
                product(column, &w) / product(column, column).sqrt() / most
            };
            let of_errors: Vec<f64> = errors.charts.iter().map(of_error).collect();
            if of_all <= 1.0 && of_errors.iter().all(|share| share.abs() <= 1.0) {
                count += 1.0;
                mean.iter_mut().zip(check).for_each(|(mean, number)| *mean += (number - *mean) / count);
            }
            if let Some(before) = k.checked_sub(1).map(|before| &numbers.checks[before]) {
                let squares = check.iter().zip(before).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
                differences.push(squares / (2.0 * free));
            }
            all.norms.push(square.sqrt());
            all.of_all.push(of_all);
            all.of_errors.push(of_errors);
        }
        all
    }
}
