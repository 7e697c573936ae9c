//! The page of corrected commands: where the tool is without and with them.

use abbe_spec::Spec;
use abbe_study::compensate::{Report, Size};
use abbe_study::data::Map;
use abbe_study::number::{self, fixed};

use super::figure::figures;
use super::provenance::Provenance;
use super::{document, escaped, section};
use crate::figures::distances;

/// The most rows that are listed.
const LISTED: usize = 100;

/// The page of corrected commands; `spec` is that of the machine.
pub fn compensation(spec: &Spec, map: &Map, report: &Report, provenance: &Provenance) -> String {
    let heading = format!(
        "<header>\n<p class=\"kind\">Corrected commands</p>\n<h1>{}</h1>\n<p class=\"study\">{}</p>\n</header>\n",
        escaped(&spec.title),
        escaped(&map.title)
    );
    let lines = report.file.lines().iter().map(|line| format!("{}<br>\n", escaped(line))).collect::<String>();
    let drawn = figures(&distances::scenes(report, spec), 0);
    let body = [
        heading,
        section("Distance of the tool point from where it should be", &sizes(spec, report)),
        section("Figures", &format!("<p>Distances are in mm.</p>\n{drawn}")),
        section("Rows that are not compensated", &failed(report)),
        section("Rows", &format!("<p>{lines}</p>\n")),
        section("Input files", &provenance.table()),
    ];
    document(&format!("{}: corrected commands", spec.title), &body.concat())
}

fn sizes(spec: &Spec, report: &Report) -> String {
    let decimals = number::error_decimals(spec.length);
    let row = |(name, size): (&str, &Size)| {
        let cells =
            [size.mean, size.rms, size.max].map(|v| format!("<td>{}</td>", fixed(v, decimals))).concat();
        format!(
            "<tr><td class=\"words\">{name}</td>{cells}<td>{}</td></tr>\n",
            fixed(size.angle_max * 1e3, 4)
        )
    };
    let rows = [("as commanded", &report.before), ("corrected", &report.after)].map(row).concat();
    format!(
        "<table class=\"ledger\"><thead><tr><th></th><th>mean ({unit})</th><th>rms ({unit})</th><th>largest ({unit})</th>\
         <th>largest turn (mrad)</th></tr></thead>\n<tbody>{rows}</tbody></table>\n<p>{} of {} rows are compensated: no more than {} is left \
         at the tool point.</p>\n",
        report.compensated,
        report.asked(),
        number::length(report.tolerance, spec.length),
        unit = report.length
    )
}

fn failed(report: &Report) -> String {
    let failed: Vec<(u64, &String)> =
        report.rows.iter().filter_map(|row| Some((row.line, row.reason.as_ref()?))).collect();
    if failed.is_empty() {
        return "<p>None.</p>\n".to_owned();
    }
    let items = failed
        .iter()
        .take(LISTED)
        .map(|(line, reason)| format!("<li>line {line}: {}</li>\n", escaped(reason)));
    let more = failed.len().saturating_sub(LISTED);
    let more = if more > 0 { format!("<li>… and {more} more</li>\n") } else { String::new() };
    format!("<ul>\n{}{more}</ul>\n", items.collect::<String>())
}
