//! Tables of an analysis: every source alone, all sources together, and published figures.

use abbe::analysis::Figures;
use abbe::{Class, Distribution};

use abbe_study::Listing;
use abbe_study::analyze::{Agreement, Comparison, Report, SourceReport};
use abbe_study::number::{fixed, percent, short, unbroken};
use abbe_study::study_file::{self, CombinedFigure, Metric};

use super::escaped;
use super::table::{ledger, row_header};

/// Formats every source alone, in descending order of its largest norm.
pub(super) fn sources(report: &Report) -> String {
    let mut sources = report.sources.iter().collect::<Vec<_>>();
    sources.sort_by(|a, b| b.plain_max.norm.total_cmp(&a.plain_max.norm));
    let rows = sources.into_iter().enumerate().map(|(rank, one)| source(rank + 1, one, report));
    let caption = "Largest errors of each source alone";
    table(caption, &["rank", "source", "metric"], &[1, 2], &rows.collect::<String>(), report)
}

/// Formats a table of errors along the axes, with shares of the tolerance and verdicts if there are
/// any.
fn table(caption: &str, first: &[&str], words: &[usize], bodies: &str, report: &Report) -> String {
    let unit = report.spec.length.symbol();
    let errors = ["x", "y", "z", "norm"].map(|axis| format!("{axis} ({unit})"));
    let share = report.study.tolerance.map(|_| "of tolerance");
    let verdict = (!report.study.published.is_empty()).then_some("verdict");
    let columns = first.iter().copied().chain(errors.iter().map(String::as_str)).chain(share).chain(verdict);
    let columns = columns.collect::<Vec<_>>();
    let verdict = verdict.map(|_| columns.len() - 1);
    ledger(caption, &columns, &words.iter().copied().chain(verdict).collect::<Vec<_>>(), bodies)
}

fn source(rank: usize, source: &SourceReport, report: &Report) -> String {
    let worst = report.configuration(source.configuration).filter(|_| source.plain_max.norm > 0.0);
    let metrics = Metric::ALL.map(|(name, metric)| {
        let figures = source.figures(metric);
        (name, figures, report.published(&study_file::Subject::Source(source.name.clone(), metric)))
    });
    let lines = metrics.iter().map(|(_, _, published)| 1 + usize::from(published.is_some())).sum::<usize>();
    let share = |figures: &Figures| {
        let share = report.study.tolerance.map(|tolerance| percent(figures.norm, tolerance));
        share.map_or_else(String::new, |share| format!("<td>{share}</td>"))
    };
    let mut rows = String::new();
    for (i, (name, figures, published)) in metrics.iter().enumerate() {
        let head = if i == 0 {
            let (name, at, class) = (escaped(&source.name), escaped(&source.at), class(source.class));
            let worst =
                worst.map(|worst| format!("<br>worst at {}", escaped(&unbroken(&report.label(worst)))));
            let worst = worst.unwrap_or_default();
            format!(
                "<td rowspan=\"{lines}\">{rank}</td><th scope=\"rowgroup\" class=\"words\" rowspan=\"{lines}\"><b>{name}</b>\
                 <small>{at}<br>{class}{worst}</small></th>"
            )
        } else {
            String::new()
        };
        let Figures { x, y, z, norm } = *figures;
        let cells = [x, y, z, norm].map(|figure| format!("<td>{}</td>", error(figure, report))).concat();
        rows += &format!(
            "<tr>{head}<td class=\"words metric\">{name}</td>{cells}{}{}</tr>\n",
            share(figures),
            no_verdict(report)
        );
        rows += &published.map(|published| comparison(published, report)).unwrap_or_default();
    }
    format!("<tbody>{rows}</tbody>\n")
}

/// Formats the row of a published figure.
fn comparison(published: &Comparison, report: &Report) -> String {
    let cells = published.figures.map(|figure| figure.map_or("–".to_owned(), short));
    let cells = cells.map(|cell| format!("<td>{cell}</td>")).concat();
    let skipped = report.study.tolerance.map_or("", |_| "<td></td>");
    format!(
        "<tr class=\"published\"><td class=\"words metric\">{}</td>{cells}{skipped}{}</tr>\n",
        attributed(report, &published.reference),
        verdict(published.agreement, report)
    )
}

/// Formats all sources together.
pub(super) fn combined(report: &Report) -> String {
    let combined = &report.combined;
    let mut rows = String::new();
    for (figure, name) in [
        (CombinedFigure::Repeatable, "repeatable: signed sum"),
        (CombinedFigure::Random, "random: root sum of squares of the bounds"),
        (CombinedFigure::Both, "total: repeatable + random"),
    ] {
        let ([x, y, z], norm) = report.combined_figure(figure);
        let cell = |figure: Option<f64>| figure.map_or_else(String::new, |figure| error(figure, report));
        let cells = [x, y, z, Some(norm)].map(|figure| format!("<td>{}</td>", cell(figure))).concat();
        let of = report.study.tolerance.map(|tolerance| format!("<td>{}</td>", percent(norm, tolerance)));
        let of = of.unwrap_or_default();
        rows += &format!("<tr>{}{cells}{of}{}</tr>\n", row_header(name), no_verdict(report));
        let published = report.published(&study_file::Subject::Combined(figure));
        rows += &published.map(|published| comparison(published, report)).unwrap_or_default();
    }
    for (name, axes, norm) in [
        ("random: standard deviation", combined.standard_deviation, combined.standard_radius),
        ("worst case: sum of absolute values", combined.worst_case, combined.worst_case_radius),
    ] {
        let [x, y, z] = axes;
        let cells = [x, y, z, norm].map(|figure| format!("<td>{}</td>", error(figure, report))).concat();
        let of = report.study.tolerance.map(|tolerance| format!("<td>{}</td>", percent(norm, tolerance)));
        let of = of.unwrap_or_default();
        rows += &format!("<tr>{}{cells}{of}{}</tr>\n", row_header(name), no_verdict(report));
    }
    let body = format!("<tbody>{rows}</tbody>\n");
    table("Errors of all sources together", &["sum"], &[0], &body, report)
}

/// Formats a listing as an HTML table with a caption.
pub(super) fn listed(caption: &str, listing: &Listing) -> String {
    let words = (0..listing.header.len()).filter(|column| !listing.numbers.contains(column));
    let words = words.collect::<Vec<_>>();
    let cell = |(column, cell): (usize, &String)| match column {
        0 => row_header(&escaped(cell)),
        _ if words.contains(&column) => format!("<td class=\"words\">{}</td>", escaped(cell)),
        _ => format!("<td>{}</td>", escaped(cell)),
    };
    let row = |row: &Vec<String>| {
        let cells = row.iter().enumerate().map(cell);
        format!("<tr>{}</tr>\n", cells.collect::<String>())
    };
    let rows = listing.rows.iter().map(row);
    let columns = listing.header.iter().map(|name| escaped(name)).collect::<Vec<_>>();
    let columns = columns.iter().map(String::as_str).collect::<Vec<_>>();
    ledger(&escaped(caption), &columns, &words, &format!("<tbody>{}</tbody>\n", rows.collect::<String>()))
}

fn attributed(report: &Report, reference: &str) -> String {
    let publisher = escaped(report.publisher());
    if reference.is_empty() { publisher } else { format!("{publisher}, {}", escaped(reference)) }
}

fn no_verdict(report: &Report) -> &'static str {
    if report.study.published.is_empty() { "" } else { "<td></td>" }
}

fn verdict(agreement: Agreement, report: &Report) -> String {
    let class = if agreement == Agreement::Met { "met" } else { "missed" };
    format!("<td class=\"words metric {class}\">{}</td>", escaped(&agreement.text(report)))
}

/// Formats an error with the decimals of the tables.
fn error(value: f64, report: &Report) -> String {
    fixed(value, report.decimals())
}

fn class(class: Class) -> &'static str {
    match class {
        Class::Repeatable => "repeatable",
        Class::Random(Distribution::Uniform) => "random, uniform: half-width",
        Class::Random(Distribution::Normal) => "random, normal: 3σ",
        Class::Random(Distribution::Triangular) => "random, triangular: half-width",
        Class::Random(Distribution::Arcsine) => "random, arcsine: amplitude",
    }
}
