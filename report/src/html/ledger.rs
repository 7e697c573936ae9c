//! The tables of the report: every source alone, all together, and what is printed beside them.

use abbe::analysis::Figures;
use abbe::{Class, Distribution};

use abbe_study::Listing;
use abbe_study::analyze::{Agreement, Comparison, Report, SourceReport};
use abbe_study::number::{fixed, percent, short, unbroken};
use abbe_study::study_file::{self, CombinedFigure, Metric};

use super::escaped;

/// Every source alone, the largest first.
pub(super) fn sources(report: &Report) -> String {
    let unit = report.spec.length.symbol();
    let share = report.study.tolerance.map_or("", |_| "<th>of tolerance</th>");
    let mut rows = String::new();
    let mut sources = report.sources.iter().collect::<Vec<_>>();
    sources.sort_by(|a, b| b.plain_max.norm.total_cmp(&a.plain_max.norm));
    for (rank, one) in sources.into_iter().enumerate() {
        rows += &source(rank + 1, one, report);
    }
    format!(
        "<table class=\"ledger\"><thead><tr><th>rank</th><th class=\"words\">source</th>\
         <th class=\"words\">metric</th><th>x ({unit})</th><th>y ({unit})</th><th>z ({unit})</th>\
         <th>norm ({unit})</th>{share}{}</tr></thead>\n{rows}</table>\n",
        head_of_verdicts(report)
    )
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
                "<td rowspan=\"{lines}\">{rank}</td><td class=\"words\" rowspan=\"{lines}\"><b>{name}</b>\
                 <small>{at}<br>{class}{worst}</small></td>"
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

/// The row of a published figure.
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

/// All sources together.
pub(super) fn combined(report: &Report) -> String {
    let unit = report.spec.length.symbol();
    let combined = &report.combined;
    let share = report.study.tolerance.map_or("", |_| "<th>of tolerance</th>");
    let mut rows = String::new();
    for (figure, name) in [
        (CombinedFigure::Repeatable, "repeatable: sum, with signs"),
        (CombinedFigure::Random, "random: root sum of squares of bounds"),
        (CombinedFigure::Both, "radius: both norms, added"),
    ] {
        let ([x, y, z], norm) = report.combined_figure(figure);
        let cell = |figure: Option<f64>| figure.map_or_else(String::new, |figure| error(figure, report));
        let cells = [x, y, z, Some(norm)].map(|figure| format!("<td>{}</td>", cell(figure))).concat();
        let of = report.study.tolerance.map(|tolerance| format!("<td>{}</td>", percent(norm, tolerance)));
        let of = of.unwrap_or_default();
        rows += &format!("<tr><td class=\"words\">{name}</td>{cells}{of}{}</tr>\n", no_verdict(report));
        let published = report.published(&study_file::Subject::Combined(figure));
        rows += &published.map(|published| comparison(published, report)).unwrap_or_default();
    }
    for (name, axes, norm) in [
        ("random: standard deviation", combined.standard_deviation, combined.standard_radius),
        ("worst case: absolute values, added", combined.worst_case, combined.worst_case_radius),
    ] {
        let [x, y, z] = axes;
        let cells = [x, y, z, norm].map(|figure| format!("<td>{}</td>", error(figure, report))).concat();
        let of = report.study.tolerance.map(|tolerance| format!("<td>{}</td>", percent(norm, tolerance)));
        let of = of.unwrap_or_default();
        rows += &format!("<tr><td class=\"words\">{name}</td>{cells}{of}{}</tr>\n", no_verdict(report));
    }
    format!(
        "<table class=\"ledger\"><thead><tr><th class=\"words\">all together</th><th>x ({unit})</th>\
         <th>y ({unit})</th><th>z ({unit})</th><th>norm ({unit})</th>{share}{}\
         </tr></thead>\n<tbody>{rows}</tbody></table>\n",
        head_of_verdicts(report)
    )
}

/// Any listing as a table of HTML.
pub fn listed(listing: &Listing) -> String {
    let class = |column: usize| if listing.numbers.contains(&column) { "" } else { " class=\"words\"" };
    let cells = |tag: &str, cells: &mut dyn Iterator<Item = &str>| {
        let cells =
            cells.enumerate().map(|(i, cell)| format!("<{tag}{}>{}</{tag}>", class(i), escaped(cell)));
        format!("<tr>{}</tr>\n", cells.collect::<String>())
    };
    let head = cells("th", &mut listing.header.iter().copied());
    let rows = listing.rows.iter().map(|row| cells("td", &mut row.iter().map(String::as_str)));
    format!(
        "<table class=\"ledger\"><thead>{head}</thead>\n<tbody>{}</tbody></table>\n",
        rows.collect::<String>()
    )
}

fn attributed(report: &Report, reference: &str) -> String {
    let publisher = escaped(report.publisher());
    if reference.is_empty() { publisher } else { format!("{publisher}, {}", escaped(reference)) }
}

/// Verdicts are on what is published: without that there is no column for them.
fn head_of_verdicts(report: &Report) -> &'static str {
    if report.study.published.is_empty() { "" } else { "<th class=\"words\">verdict</th>" }
}

fn no_verdict(report: &Report) -> &'static str {
    if report.study.published.is_empty() { "" } else { "<td></td>" }
}

fn verdict(agreement: Agreement, report: &Report) -> String {
    let class = if agreement == Agreement::Met { "met" } else { "missed" };
    format!("<td class=\"words metric {class}\">{}</td>", escaped(&agreement.text(report)))
}

/// An error, with the decimals of the tables.
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
