//! The page of a machine that is watched: its charts over time, and what has changed.

use abbe_spec::Spec;
use abbe_study::data::Map;
use abbe_study::monitor::{Chart, Report};
use abbe_study::number::{fixed, percent};

use super::figure::figures;
use super::provenance::{Provenance, instrument};
use super::{document, escaped, section};
use crate::figures::charts;
use crate::text::monitoring::{findings, watched};

/// The page of a machine that is watched; `spec` and `map` are those of the job.
pub fn monitoring(spec: &Spec, map: &Map, report: &Report, provenance: &Provenance) -> String {
    let heading = format!(
        "<header>\n<p class=\"kind\">Watched</p>\n<h1>{}</h1>\n<p class=\"study\">{}</p>\n</header>\n",
        escaped(&spec.title),
        escaped(&report.title)
    );
    let paragraphs = |sentences: Vec<String>| {
        sentences.iter().map(|said| format!("<p>{}</p>\n", escaped(said))).collect::<String>()
    };
    let class = if report.alarm.is_some() { "missed" } else { "met" };
    let mut findings = findings(report);
    let first = if findings.is_empty() { String::new() } else { findings.remove(0) };
    let verdict = format!(
        "<section class=\"verdict\">\n<h2 class=\"{class}\">{}</h2>\n{}</section>\n",
        escaped(&first),
        paragraphs(findings)
    );
    let unusable = report.files.iter().filter(|file| !file.unusable.is_empty()).flat_map(|file| file.lines());
    let unusable = unusable.map(|line| format!("{}<br>\n", escaped(&line))).collect::<String>();
    let body = [
        heading,
        verdict,
        section("What was watched", &paragraphs(watched(report))),
        section("Charts", &(table(report) + &figures(&charts::scenes(report), 0))),
        section("Instrument", &instrument(spec, map)),
        if unusable.is_empty() {
            unusable
        } else {
            section("Rows that cannot be used", &format!("<p>{unusable}</p>\n"))
        },
        section("Input files", &provenance.table()),
    ];
    document(&format!("{}: watched", spec.title), &body.concat())
}

fn last(values: &[f64]) -> f64 {
    values.last().copied().unwrap_or_default()
}

fn table(report: &Report) -> String {
    let row = |chart: &Chart| {
        let (factor, unit) = if chart.unit == "rad" { (1e3, "mrad") } else { (1.0, chart.unit) };
        format!(
            "<tr><td class=\"words\">{}<small>{}</small></td><td>{}</td><td class=\"words\">{unit}</td><td>{}</td><td>{}</td></tr>\n",
            escaped(&chart.name),
            escaped(&chart.alike.join(", ")),
            fixed(last(&chart.values) * factor, 4),
            percent(last(&chart.average), 1.0),
            chart.alarm.map_or("", |check| &report.dates[check]),
        )
    };
    let rows = report.nearest_first().into_iter().chain([&report.left]).map(row).collect::<String>();
    let unseen = match report.unseen.len() {
        0 => String::new(),
        _ => format!(
            "<p>These cannot be told from where the instrument stands, or do not move what is measured: {}.</p>\n",
            escaped(&report.unseen.join(", "))
        ),
    };
    format!(
        "<table class=\"ledger\"><thead><tr><th class=\"words\">error, and below it those that act alike</th><th>last value</th><th></th>\
         <th>average, share of the limit</th><th>alarm</th></tr></thead>\n<tbody>{rows}</tbody></table>\n{unseen}"
    )
}
