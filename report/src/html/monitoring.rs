//! Page of a monitored machine: its charts over time, and changes.

use abbe_spec::Spec;
use abbe_study::data::Map;
use abbe_study::monitor::{Chart, Report};
use abbe_study::number::{fixed, percent};

use super::figure::figures;
use super::provenance::{Provenance, instrument};
use super::table::ledger;
use super::{document, escaped, findings, folded, heading, section, verdict};
use crate::figures::charts;
use crate::text::{self, Detail};

/// Builds the page of a monitored machine; `spec` and `map` are those of the job.
pub fn monitoring(spec: &Spec, map: &Map, report: &Report, provenance: &Provenance) -> String {
    let unusable = report.files.iter().filter(|file| !file.unusable.is_empty()).flat_map(|file| file.lines());
    let unusable = unusable.map(|line| format!("{}<br>\n", escaped(&line))).collect::<String>();
    let line = match &report.alarm {
        Some(_) => "Alarm: the machine has changed",
        None => "No alarm",
    };
    let before =
        [heading("Monitored", &spec.title, &report.title), verdict(report.alarm.is_none(), line, &[])];
    let after = [
        section("Figures", &figures(&charts::scenes(report), 0)),
        section("Charts", &table(report)),
        section("Instrument", &instrument(spec, map)),
        match unusable.as_str() {
            "" => String::new(),
            lines => folded("Rows that cannot be used", &format!("<p>{lines}</p>\n")),
        },
        section("Input files", &provenance.table()),
    ];
    let (before, after) = (before.concat(), after.concat());
    let findings = findings(&text::monitoring(spec, report, Detail::Full), &format!("{before}{after}"));
    document(&format!("{}: monitored", spec.title), &[before, findings, after].concat())
}

fn last(values: &[f64]) -> f64 {
    values.last().copied().unwrap_or_default()
}

fn table(report: &Report) -> String {
    let row = |chart: &Chart| {
        let (factor, unit) = if chart.unit == "rad" { (1e3, "mrad") } else { (1.0, chart.unit) };
        format!(
            "<tr><th scope=\"row\" class=\"words\">{}<small>{}</small></th><td>{}</td><td class=\"words\">{unit}</td><td>{}</td>\
             <td>{}</td></tr>\n",
            escaped(&chart.name),
            escaped(&chart.indistinguishable.join(", ")),
            fixed(last(&chart.values) * factor, 4),
            percent(last(&chart.average), 1.0),
            chart.alarm.map_or("", |check| &report.dates[check]),
        )
    };
    let rows = report.nearest_first().into_iter().chain([&report.left]).map(row).collect::<String>();
    let unseen = match report.unseen.len() {
        0 => String::new(),
        _ => format!(
            "<p>Not observable, because indistinguishable from the station or without effect on \
             the measurements: {}.</p>\n",
            escaped(&report.unseen.join(", "))
        ),
    };
    let columns = ["error", "last value", "unit", "average as share of the limit", "alarm"];
    let caption = "Control charts, nearest to the limit first; the small print names indistinguishable \
         errors";
    ledger(caption, &columns, &[0, 2], &format!("<tbody>{rows}</tbody>\n")) + &unseen
}
