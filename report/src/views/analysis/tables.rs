//! Tables of an error budget.

use abbe::analysis::{Figures, MonteCarlo};
use abbe_study::analyze::{Report, SourceReport};
use abbe_study::number::{self as numbers, fixed, percent, short};
use abbe_study::study_file::{CombinedFigure, Metric, Subject};

use super::agreement::agreement_text;
use crate::document::{Section, Table};
use crate::unit::decimals;

/// Tabulates three metrics of every source, and under each what is published on it, in descending
/// order of the largest norms.
pub(super) fn sources(report: &Report) -> Table {
    let mut sources: Vec<&SourceReport> = report.sources.iter().collect();
    sources.sort_by(|a, b| b.plain_max.norm.total_cmp(&a.plain_max.norm));
    let mut rows = Vec::new();
    for source in sources {
        let (class, distribution) = numbers::class(source.class);
        let class = distribution.map_or(class.to_owned(), |distribution| format!("{class}, {distribution}"));
        let about = [source.name.clone(), class, source.at.clone()];
        let of = Metric::ALL.into_iter().flat_map(|(name, metric)| {
            let Figures { x, y, z, norm } = source.figures(metric);
            let subject = Subject::Source(source.name.clone(), metric);
            lines(report, name, [x, y, z, norm].map(Some), Some(&subject), None)
        });
        let about = about.into_iter().chain(std::iter::repeat(String::new()));
        rows.extend(about.zip(of).map(|(about, line)| [vec![about], line].concat()));
    }
    Table::listing(unit(report), &[vec!["source"], columns(report, None)].concat(), rows)
}

/// Tabulates all sources together.
pub(super) fn combined(report: &Report) -> Table {
    let names = [
        (CombinedFigure::Repeatable, "repeatable: signed sum"),
        (CombinedFigure::Random, "random: root sum of squares"),
        (CombinedFigure::Both, "total: repeatable + random"),
    ];
    let tolerance = report.study.tolerance;
    let mut rows = Vec::new();
    for (figure, name) in names {
        let ([x, y, z], norm) = report.combined_figure(figure);
        rows.extend(lines(report, name, [x, y, z, Some(norm)], Some(&Subject::Combined(figure)), tolerance));
    }
    let all = &report.combined;
    for (name, axes, norm) in [
        ("random: standard deviation", all.standard_deviation, all.standard_radius),
        ("worst case over all signs", all.worst_case, all.worst_case_radius),
    ] {
        let [x, y, z] = axes.map(Some);
        rows.extend(lines(report, name, [x, y, z, Some(norm)], None, tolerance));
    }
    Table::listing(unit(report), &columns(report, tolerance), rows)
}

fn unit(report: &Report) -> String {
    format!("Largest errors over the workspace ({})", report.spec.length.symbol())
}

/// Returns the columns of metric, axes, norm, share of the tolerance and agreement; the last two if
/// there are any.
fn columns(report: &Report, tolerance: Option<f64>) -> Vec<&'static str> {
    let share = tolerance.map(|_| ">of tolerance");
    let agreement = (!report.study.published.is_empty()).then_some("agreement");
    ["figure", ">x", ">y", ">z", ">norm"].into_iter().chain(share).chain(agreement).collect()
}

/// Formats figures, and below them the published ones, if there are any.
fn lines(
    report: &Report,
    name: &str,
    figures: [Option<f64>; 4],
    subject: Option<&Subject>,
    tolerance: Option<f64>,
) -> Vec<Vec<String>> {
    let published = subject.and_then(|subject| report.published(subject));
    let show = |figure: Option<f64>| figure.map_or_else(String::new, |value| fixed(value, decimals(report)));
    let of = tolerance.map(|tolerance| figures[3].map_or_else(String::new, |norm| percent(norm, tolerance)));
    let none = (!report.study.published.is_empty()).then(String::new);
    let mut lines = vec![
        std::iter::once(name.to_owned()).chain(figures.map(show)).chain(of).chain(none).collect::<Vec<_>>(),
    ];
    if let Some(published) = published {
        let publisher = format!("  {}", report.publisher());
        let figures = published.figures.map(|figure| figure.map_or("–".to_owned(), short));
        let skipped = tolerance.map(|_| String::new());
        let agreement = agreement_text(published.agreement, report);
        lines.push(
            std::iter::once(publisher).chain(figures).chain(skipped).chain([agreement]).collect::<Vec<_>>(),
        );
    }
    lines
}

/// Tabulates the Monte Carlo results, if there are draws.
pub(super) fn monte_carlo(report: &Report) -> Section {
    let section = Section::full("Monte Carlo on the exact chain");
    let Some(drawn) = &report.monte_carlo else { return section };
    let decimals = decimals(report);
    let norms = |(place, found): (&str, &MonteCarlo)| {
        let [a, b, c] = found.quantiles.map(|quantile| fixed(quantile.value, decimals));
        let errors = found.quantiles.map(|quantile| fixed(quantile.standard_error, decimals + 1));
        let inside = found.inside_ellipsoid.map(|share| format!("{:.2} %", 100.0 * share));
        let values = [place.to_owned(), a, b, c, fixed(found.largest, decimals), inside.unwrap_or_default()];
        let [a, b, c] = errors;
        [values, ["  standard error".to_owned(), a, b, c, String::new(), String::new()]]
    };
    let deviations = |(place, found): (&str, &MonteCarlo)| {
        let row = |name: &str, value: &dyn Fn(usize) -> f64, more: usize| {
            let [x, y, z] = [0, 1, 2].map(|i| fixed(value(i), decimals + more));
            [name.to_owned(), x, y, z]
        };
        let sigma = |i: usize| found.covariance[i][i].sqrt();
        // d√v = dv / 2√v.
        let error = |i: usize| match sigma(i) {
            0.0 => 0.0,
            sigma => found.standard_error[i][i] / (2.0 * sigma),
        };
        let first_order = |i: usize| found.first_order[i][i].sqrt();
        [row(place, &sigma, 0), row("  standard error", &error, 1), row("  first order", &first_order, 0)]
    };
    let unit = report.spec.length.symbol();
    let columns = ["at", ">50 %", ">95 %", ">99 %", ">largest", ">in ellipsoid"];
    let norms = Table::new(format!("Quantiles of the norm of the error ({unit})"), columns)
        .rows(drawn.results().into_iter().flat_map(norms));
    let columns = ["at", ">σ x", ">σ y", ">σ z"];
    let caption = format!("Standard deviations ({unit})");
    let deviations = Table::new(caption, columns).rows(drawn.results().into_iter().flat_map(deviations));
    let explained = format!(
        "{} draws per configuration, seed {}: quantiles and maximum of the norm of the total error, the share \
         of draws inside the first-order 95 % ellipsoid, which is 95 % if all random sources are normal, and \
         standard deviations.",
        numbers::short(drawn.draws as f64),
        drawn.seed,
    );
    section.table(norms).table(deviations).state("monte_carlo", explained)
}
