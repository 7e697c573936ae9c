//! Full text of a monitor.

mod sentences;

use abbe_metrology::monitor::{Chart, Report};
use abbe_spec::Spec;
use abbe_study::number::{fixed, percent};

use super::{Table, wrapped};
pub(crate) use sentences::{findings, watched};

/// Number of charts shown.
const SHOWN: usize = 12;
/// Number of indistinguishable errors named.
const NAMED: usize = 4;

/// Returns what `abbe monitor` prints.
pub(in crate::text) fn monitoring(spec: &Spec, report: &Report) -> String {
    let mut parts = vec![format!("{}: watched\n\n", spec.title)];
    for file in report.files.iter().filter(|file| !file.unusable.is_empty()) {
        for line in file.lines() {
            parts[0] += &format!("{}\n", wrapped(&line, 2));
        }
    }
    let paragraphs = |sentences: &[String]| {
        sentences.iter().map(|sentence| wrapped(sentence, 0) + "\n").collect::<String>()
    };
    parts[0] += &paragraphs(&findings(report));
    parts.push(paragraphs(&watched(report)));
    parts.push(charts(report));
    parts.join("\n")
}

fn charts(report: &Report) -> String {
    let all = report.nearest_first();
    let now = |chart: &Chart| chart.average.last().copied().unwrap_or_default();
    let mut table = Table::new(&[
        "error",
        "indistinguishable from",
        "last value",
        "",
        "average as share of the limit",
        "alarm",
    ]);
    let hidden = all.len().saturating_sub(SHOWN);
    for chart in all.into_iter().take(SHOWN).chain([&report.left]) {
        let (factor, unit) = if chart.unit == "rad" { (1e3, "mrad") } else { (1.0, chart.unit) };
        let more = chart.indistinguishable.len().saturating_sub(NAMED);
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        let names =
            chart.indistinguishable.iter().take(NAMED).map(String::as_str).collect::<Vec<_>>().join(", ");
        table.row(vec![
            chart.name.clone(),
            names + &more,
            fixed(chart.values.last().copied().unwrap_or_default() * factor, 4),
            unit.to_owned(),
            percent(now(chart), 1.0),
            chart.alarm.map_or(String::new(), |check| report.dates[check].clone()),
        ]);
    }
    let mut text = table.right(&[2, 4]).to_string();
    if hidden > 0 {
        text += &format!("… and {hidden} more, nearer to zero\n");
    }
    if !report.unseen.is_empty() {
        text += &(wrapped(&not_observable(report), 0) + "\n");
    }
    text
}

/// Names the errors that the checks cannot show.
pub(crate) fn not_observable(report: &Report) -> String {
    format!(
        "Not observable, because indistinguishable from the station or without effect on the \
         measurements: {}.",
        report.unseen.join(", ")
    )
}
