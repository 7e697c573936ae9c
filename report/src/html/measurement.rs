//! Page of a measurement: statistics of its errors, and figures.

use abbe_metrology::data::Map;
use abbe_metrology::measure::{Report, Size};
use abbe_spec::Spec;
use abbe_study::explore;
use abbe_study::number::{digits, fixed};

use super::figure::figures;
use super::identification::accepted;
use super::provenance::{Provenance, instrument};
use super::table::{ledger, row_header};
use super::{Card, cards, document, escaped, findings, folded, heading, panel, panels, section};
use crate::figures::measured;
use crate::text::{self, Detail};

/// Builds the page of a measurement; `spec` and `map` are those of the job, and `live` is
/// the data of the live panel.
pub fn measurement(
    spec: &Spec,
    map: &Map,
    report: &Report,
    provenance: &Provenance,
    live: Option<&explore::Report>,
) -> String {
    let lines: String = report.file.lines().iter().map(|line| format!("{}<br>\n", escaped(line))).collect();
    let drawn = figures(&measured::scenes(report, spec), 0);
    let (errors, drawn) = match report.instruments.is_empty() {
        true => {
            (section("ΔX = measured − ideal", &table(report)), format!("<p>Errors are in mm.</p>\n{drawn}"))
        }
        false => (section("Reading − prediction", &instruments(report)), drawn),
    };
    let panels = panels(live);
    let before = [
        heading("Measured", &spec.title, &report.title),
        accepted(spec, report.accepted.as_ref()),
        summary(report),
        panel("Errors at a configuration", panels.as_ref()),
    ];
    let after = [
        section("Figures", &drawn),
        errors,
        section("Instrument", &instrument(spec, map)),
        folded("Rows", &format!("<p>{lines}</p>\n")),
        provenance.sections(&report.record, report.accepted.is_some()),
    ];
    let (before, after) = (before.concat(), after.concat());
    let findings = findings(|| text::measurement(spec, report, Detail::Full), &format!("{before}{after}"));
    document(&format!("{}: measured", spec.title), &[before, findings, after].concat(), panels.as_ref())
}

/// Formats the norm of the error as cards, if points were measured.
fn summary(report: &Report) -> String {
    let decimals = if report.length == "m" { 7 } else { 4 };
    let norm = report.errors.iter().find(|size| size.name == "norm");
    let show = |value: f64| format!("{} {}", fixed(value, decimals), report.length);
    let norms = norm.into_iter().flat_map(|norm| {
        [("Mean error", norm.mean), ("Root mean square", norm.rms), ("Largest error", norm.max)]
    });
    let norms =
        norms.map(|(name, value)| Card { name, value: show(value), note: "measured − ideal".to_owned() });
    let rows = Card {
        name: "Rows",
        value: report.rows.to_string(),
        note: format!("{} independent configurations", report.configurations),
    };
    cards(norms.chain([rows]))
}

fn table(report: &Report) -> String {
    let decimals = if report.length == "m" { 7 } else { 4 };
    let row = |size: &Size| {
        let (unit, factor, decimals) = match size.unit {
            "rad" => ("mrad", 1e3, 4),
            unit => (unit, 1.0, decimals),
        };
        let numbers = [size.mean, size.rms, size.max, size.three_sigma];
        let cells = numbers.map(|number| format!("<td>{}</td>", fixed(number * factor, decimals))).concat();
        format!("<tr>{}{cells}</tr>\n", row_header(&format!("{} ({unit})", size.name)))
    };
    let rows = report.errors.iter().map(row).collect::<String>();
    let columns = ["", "mean", "rms", "largest", "3 σ about the mean"];
    ledger("Errors of all rows", &columns, &[0], &format!("<tbody>{rows}</tbody>\n"))
}

/// Formats the residuals of each instrument in its own unit.
fn instruments(report: &Report) -> String {
    let rows = report.instruments.iter().map(|one| {
        let cell = |text: String| format!("<td>{text}</td>");
        let show = |value: f64| cell(digits(value, 4));
        let unknown = || cell(String::new());
        let cells = [
            cell(one.count.to_string()),
            show(one.ideal.rms),
            show(one.left.mean),
            one.left.standard_error.map_or_else(unknown, show),
            show(one.left.rms),
            show(one.left.max),
            one.uncertainty.map_or_else(unknown, show),
        ];
        let (name, unit) = (escaped(&one.name), escaped(&one.unit));
        format!("<tr>{}{}</tr>\n", row_header(&format!("{name} ({unit})")), cells.concat())
    });
    let columns = ["", "read", "ideal: rms", "mean", "std. error", "rms", "largest", "stated σ"];
    let body = format!("<tbody>{}</tbody>\n", rows.collect::<String>());
    ledger("Residuals by instrument, in its unit", &columns, &[0], &body)
}
