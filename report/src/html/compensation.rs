//! Page of a compensation: position errors before and after.

use abbe::Description;
use abbe_metrology::compensate::{NormStatistics, Report};
use abbe_metrology::data::Map;
use abbe_spec::Spec;
use abbe_study::explore;
use abbe_study::number::{self, visible};

use super::figure::figures;
use super::provenance::Provenance;
use super::table::{ledger, row_header};
use super::{Card, cards, document, escaped, findings, folded, heading, panel, panels, section, verdict};
use crate::figures::distances;
use crate::text::{self, Detail};

/// Maximum number of listed rows.
const LISTED: usize = 100;

/// Builds the page of a compensation; `spec` and `map` are those of the job, and `machine` is the
/// description of its manipulator. `live` is the data of the live panel.
pub fn compensation(
    spec: &Spec,
    machine: &Description,
    map: &Map,
    report: &Report,
    provenance: &Provenance,
    live: Option<&explore::Report>,
) -> String {
    let lines = report.file.lines().iter().map(|line| format!("{}<br>\n", escaped(line))).collect::<String>();
    let drawn = figures(&distances::scenes(report, spec), 0);
    let line = format!("{} of {} commands corrected", report.compensated, report.total_rows());
    let panels = panels(live);
    let before = [
        heading("Corrected commands", &spec.title, &map.title),
        verdict(report.complete(), &line, &[]),
        summary(spec, report),
        panel("Errors at a command", panels.as_ref()),
    ];
    let after = [
        section("Figures", &format!("<p>Distances are in mm.</p>\n{drawn}")),
        section("Position error of the tool point", &sizes(spec, report)),
        failed(report),
        folded("Rows", &format!("<p>{lines}</p>\n")),
        provenance.sections(&report.record, false),
    ];
    let (before, after) = (before.concat(), after.concat());
    let findings =
        findings(|| text::compensation(machine, report, Detail::Full), &format!("{before}{after}"));
    document(
        &format!("{}: corrected commands", spec.title),
        &[before, findings, after].concat(),
        panels.as_ref(),
    )
}

fn summary(spec: &Spec, report: &Report) -> String {
    let decimals = number::error_decimals(spec.length);
    let card = |name, size: &NormStatistics| Card {
        name,
        value: format!("{} {}", visible(size.mean, decimals), report.length),
        note: format!("mean; maximum {} {}", visible(size.max, decimals), report.length),
    };
    let tolerance = Card {
        name: "Tolerance",
        value: number::length(report.tolerance, spec.length),
        note: "largest error allowed at the tool point".to_owned(),
    };
    cards([card("As commanded", &report.before), card("Corrected", &report.after), tolerance])
}

fn sizes(spec: &Spec, report: &Report) -> String {
    let decimals = number::error_decimals(spec.length);
    let row = |(name, size): (&str, &NormStatistics)| {
        let cells =
            [size.mean, size.rms, size.max].map(|v| format!("<td>{}</td>", visible(v, decimals))).concat();
        format!("<tr>{}{cells}<td>{}</td></tr>\n", row_header(name), visible(size.angle_max * 1e3, 4))
    };
    let rows = [("as commanded", &report.before), ("corrected", &report.after)].map(row).concat();
    let unit = report.length;
    let columns = ["mean", "rms", "largest"].map(|name| format!("{name} ({unit})"));
    let columns =
        [""].into_iter().chain(columns.iter().map(String::as_str)).chain(["max orientation error (mrad)"]);
    let body = format!("<tbody>{rows}</tbody>\n");
    ledger("Position errors before and after", &columns.collect::<Vec<_>>(), &[0], &body)
}

fn failed(report: &Report) -> String {
    let failed: Vec<(u64, &String)> =
        report.rows.iter().filter_map(|row| Some((row.line, row.reason.as_ref()?))).collect();
    if failed.is_empty() {
        return String::new();
    }
    let items = failed
        .iter()
        .take(LISTED)
        .map(|(line, reason)| format!("<li>line {line}: {}</li>\n", escaped(reason)));
    let more = failed.len().saturating_sub(LISTED);
    let more = if more > 0 { format!("<li>… and {more} more</li>\n") } else { String::new() };
    let list = format!("<ul>\n{}{more}</ul>\n", items.collect::<String>());
    section("Rows not compensated", &list)
}
