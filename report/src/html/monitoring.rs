//! Page of a monitored machine: its charts over time, and changes.

use abbe_metrology::data::Map;
use abbe_metrology::monitor::{Chart, Report};
use abbe_spec::Spec;
use abbe_study::explore;
use abbe_study::number::{fixed, percent};

use super::figure::figures;
use super::provenance::{Provenance, instrument};
use super::table::ledger;
use super::{
    Card, cards, document, escaped, findings, folded, heading, panel, panels, paragraphs, section, verdict,
};
use crate::figures::charts;
use crate::text::{self, Detail, changes, not_observable};

/// Builds the page of a monitored machine; `spec` and `map` are those of the job, and `live` is
/// the data of the live panel.
pub fn monitoring(
    spec: &Spec,
    map: &Map,
    report: &Report,
    provenance: &Provenance,
    live: Option<&explore::Report>,
) -> String {
    let unusable = report.files.iter().filter(|file| !file.unusable.is_empty()).flat_map(|file| file.lines());
    let unusable = unusable.map(|line| format!("{}<br>\n", escaped(&line))).collect::<String>();
    let line = match &report.alarm {
        Some(_) => "Alarm: the machine has changed",
        None => "No alarm",
    };
    let panels = panels(live);
    let before = [
        heading("Monitored", &spec.title, &report.title),
        verdict(report.alarm.is_none(), line, &changes(report)),
        summary(report),
        panel("Residuals at a configuration", panels.as_ref()),
    ];
    let after = [
        section("Figures", &figures(&charts::scenes(report), 0)),
        section("Charts", &table(report)),
        section("Instrument", &instrument(spec, map)),
        match unusable.as_str() {
            "" => String::new(),
            lines => folded("Rows that cannot be used", &format!("<p>{lines}</p>\n")),
        },
        provenance.sections(&report.record, false),
    ];
    let (before, after) = (before.concat(), after.concat());
    let findings = findings(|| text::monitoring(spec, report, Detail::Full), &format!("{before}{after}"));
    document(&format!("{}: monitored", spec.title), &[before, findings, after].concat(), panels.as_ref())
}

/// Formats the most important figures as cards.
fn summary(report: &Report) -> String {
    let span = match &report.dates[..] {
        [first, .., last] => format!("{first} to {last}"),
        dates => dates.concat(),
    };
    let checks = Card { name: "Checks", value: report.dates.len().to_string(), note: span };
    let configurations = Card {
        name: "Configurations",
        value: report.configurations.to_string(),
        note: "in each check".to_owned(),
    };
    let nearest = report.nearest_first().first().map(|chart| Card {
        name: "Nearest to its limit",
        value: percent(last(&chart.average).abs(), 1.0),
        note: format!("of the limit: {}", chart.name),
    });
    cards([checks, configurations].into_iter().chain(nearest))
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
        _ => paragraphs(&[not_observable(report)]),
    };
    let columns = ["error", "last value", "unit", "average as share of the limit", "alarm"];
    let caption = "Control charts, nearest to the limit first; the small print names indistinguishable \
         errors";
    ledger(caption, &columns, &[0, 2], &format!("<tbody>{rows}</tbody>\n")) + &unseen
}
