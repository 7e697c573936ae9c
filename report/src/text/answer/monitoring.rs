//! The answer of a monitor: alarm or not, what changed, and the charts nearest to their limits.

use abbe_metrology::monitor::{Chart, Report};
use abbe_spec::Spec;
use abbe_study::number::{digits, percent};

use super::full::monitoring::findings;
use super::{Answer, aligned};

/// Number of charts shown.
const SHOWN: usize = 5;

pub(in crate::text) fn monitoring(spec: &Spec, report: &Report) -> String {
    let headline = match &report.alarm {
        Some(alarm) => format!("ALARM at {}", alarm.date),
        None => "no alarm".to_owned(),
    };
    let mut answer = Answer::new(&format!("{}: {headline}, {} checks", spec.title, report.dates.len()));
    let sentences: String = findings(report)
        .iter()
        .skip(usize::from(report.alarm.is_some()))
        .map(|sentence| super::wrapped(sentence, 0) + "\n")
        .collect();
    answer.block(&sentences);
    let now = |chart: &Chart| percent(chart.average.last().copied().unwrap_or_default(), 1.0);
    let mut rows = vec![["chart", "last value", "", "of the limit", "alarm"].map(str::to_owned)];
    rows.extend(report.nearest_first().into_iter().take(SHOWN).chain([&report.left]).map(|chart| {
        let (factor, unit) = if chart.unit == "rad" { (1e3, "mrad") } else { (1.0, chart.unit) };
        let last = digits(factor * chart.values.last().copied().unwrap_or_default(), 3);
        let alarm = chart.alarm.map_or(String::new(), |check| report.dates[check].clone());
        [chart.name.clone(), last, unit.to_owned(), now(chart), alarm]
    }));
    answer.block(&aligned(&rows, [false, true, false, true, false]));
    let charts = report.charts.len() + 1;
    let configurations = report.configurations;
    answer.facts([("Charts", format!("{charts}, from {configurations} configurations in each check"))]);
    answer.0
}
