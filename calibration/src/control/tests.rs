//! False-alarm rate of all charts together, over many machine-years.

use rand::RngExt;
use rand_distr::StandardNormal;

use super::{SelfStarting, ewma_limit};
use abbe_analysis::sampling::stream;

const LAMBDA: f64 = 0.2;
const CHARTS: usize = 20;
const YEAR: usize = 365;

/// Returns the share of machine-years without an alarm of any chart, each chart with `CHARTS` times
/// the run length of a year; the charts have the share `common` of their variance in common.
fn quiet(years: usize, common: f64) -> f64 {
    let limit = ewma_limit(LAMBDA, (YEAR * CHARTS) as f64) * f64::sqrt(LAMBDA / (2.0 - LAMBDA));
    let is_quiet = |year: usize| {
        let mut random = stream(23, year);
        let mut charts = [(SelfStarting::default(), 0.0_f64); CHARTS];
        for _ in 0..YEAR {
            let shared = common.sqrt() * random.sample::<f64, _>(StandardNormal);
            for (series, average) in &mut charts {
                let own = (1.0 - common).sqrt() * random.sample::<f64, _>(StandardNormal);
                *average += LAMBDA * (series.next(7.0 + 0.3 * (shared + own)) - *average);
                if average.abs() > limit {
                    return false;
                }
            }
        }
        true
    };
    (0..years).filter(|year| is_quiet(*year)).count() as f64 / years as f64
}

/// A rate of one alarm a year leaves 1/e of the years without any; over 500 years, the standard
/// error is 0.022.
#[test]
fn independent_charts_raise_one_false_alarm_a_year() {
    let quiet = quiet(500, 0.0);
    assert!((quiet - (-1.0_f64).exp()).abs() < 4.0 * 0.022, "{quiet}");
}

/// The promised rate is an upper bound for correlated charts.
#[test]
fn correlated_charts_raise_fewer() {
    let quiet = quiet(300, 0.8);
    assert!(quiet > (-1.0_f64).exp() - 4.0 * 0.028, "{quiet}");
}
