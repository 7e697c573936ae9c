//! The page of a measurement: the sizes of its errors, and its figures.

use abbe_spec::Spec;
use abbe_study::data::Map;
use abbe_study::measure::Report;
use abbe_study::number::{digits, fixed};

use super::figure::figures;
use super::provenance::{Provenance, instrument};
use super::{document, escaped, section};
use crate::figures::measured;
use crate::text::measurement::sentences;

/// The page of a measurement; `spec` and `map` are those of the job.
pub fn measurement(spec: &Spec, map: &Map, report: &Report, provenance: &Provenance) -> String {
    let heading = format!(
        "<header>\n<p class=\"kind\">Measured</p>\n<h1>{}</h1>\n<p class=\"study\">{}</p>\n</header>\n",
        escaped(&spec.title),
        escaped(&report.title)
    );
    let sentences = sentences(report);
    let words: String = sentences.iter().map(|sentence| format!("<p>{}</p>\n", escaped(sentence))).collect();
    let lines: String = report.file.lines().iter().map(|line| format!("{}<br>\n", escaped(line))).collect();
    let drawn = figures(&measured::scenes(report, spec), 0);
    let (errors, drawn) = match report.instruments.is_empty() {
        true => (
            section("ΔX = measured − ideal", &(table(report) + &words)),
            section("Figures", &format!("<p>Errors are in mm.</p>\n{drawn}")),
        ),
        false => {
            (section("Reading − prediction", &(instruments(report) + &words)), section("Figures", &drawn))
        }
    };
    let body = [
        heading,
        section("Rows", &format!("<p>{lines}</p>\n")),
        errors,
        drawn,
        section("Instrument", &instrument(spec, map)),
        section("Input files", &provenance.table()),
    ];
    document(&format!("{}: measured", spec.title), &body.concat())
}

fn table(report: &Report) -> String {
    let decimals = if report.length == "m" { 7 } else { 4 };
    let rows: String = report
        .errors
        .iter()
        .map(|size| {
            let numbers = [size.mean, size.rms, size.max, size.three_sigma];
            let decimals = if size.unit == "rad" { 6 } else { decimals };
            let cells: String = numbers
                .iter()
                .map(|v| format!("<td class=\"number\">{}</td>", fixed(*v, decimals)))
                .collect();
            format!("<tr><td class=\"words\">{} ({})</td>{cells}</tr>\n", size.name, size.unit)
        })
        .collect();
    format!(
        "<table class=\"ledger\">\n<thead><tr><th></th><th>mean</th><th>rms</th><th>largest</th><th>3 σ about the mean</th></tr></thead>\n<tbody>\n{rows}</tbody>\n</table>\n"
    )
}

/// What is left of every instrument's readings, each in its own unit.
fn instruments(report: &Report) -> String {
    let rows = report.instruments.iter().map(|one| {
        let cell = |text: String| format!("<td class=\"number\">{text}</td>");
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
        format!("<tr><td class=\"words\">{name} ({unit})</td>{}</tr>\n", cells.concat())
    });
    let heads = ["", "read", "ideal: rms", "mean", "std. error", "rms", "largest", "stated σ"];
    let heads: String = heads.iter().map(|head| format!("<th>{head}</th>")).collect();
    format!(
        "<table class=\"ledger\">\n<thead><tr>{heads}</tr></thead>\n<tbody>\n{}</tbody>\n</table>\n",
        rows.collect::<String>()
    )
}
