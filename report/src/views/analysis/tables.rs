//! Tables of an error budget.
//!
//! Agreement with a published figure, in words.
//!
//! The ledger as tables: one row per source, followed by their sums.

use abbe::analysis::{Extreme, Figures, Measurand, MonteCarlo};
use abbe_study::analyze::{Agreement, Ledger, LedgerEntry, Report, SourceReport};
use abbe_study::number::{self, fixed, percent, short, steady};
use abbe_study::study_file::{CombinedFigure, Metric, Subject};

use crate::document::{Section, Table};
use crate::unit::{self, decimals};

/// Tabulates three metrics of every source, and under each what is published on it, in descending
/// order of the largest norms.
pub(super) fn sources(report: &Report) -> Table {
    let mut sources: Vec<&SourceReport> = report.sources.iter().collect();
    sources.sort_by(|a, b| b.plain_max.norm.total_cmp(&a.plain_max.norm));
    let mut rows = Vec::new();
    for source in sources {
        let (class, distribution) = number::class(source.class);
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
    Table::listing(LARGEST, &[vec!["source"], columns(report, None)].concat(), rows)
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
    Table::listing(LARGEST, &columns(report, tolerance), rows)
}

const LARGEST: &str = "Largest errors over the workspace (mm)";

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
    let factor = unit::display_unit(report, Measurand::Position).0;
    let show = |figure: Option<f64>| {
        figure.map_or_else(String::new, |value| unit::fixed(report, Measurand::Position, value))
    };
    let of = tolerance.map(|tolerance| figures[3].map_or_else(String::new, |norm| percent(norm, tolerance)));
    let none = (!report.study.published.is_empty()).then(String::new);
    let mut lines = vec![
        std::iter::once(name.to_owned()).chain(figures.map(show)).chain(of).chain(none).collect::<Vec<_>>(),
    ];
    if let Some(published) = published {
        let publisher = format!("  {}", report.publisher());
        let figures = published
            .figures
            .map(|figure| figure.map_or("–".to_owned(), |figure| short(steady(factor * figure))));
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
    let (factor, unit) = unit::display_unit(report, Measurand::Position);
    let fixed = |value: f64, decimals| fixed(factor * value, decimals);
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
        number::short(drawn.draws as f64),
        drawn.seed,
    );
    section.table(norms).table(deviations).state("monte_carlo", explained)
}

/// Returns `met`, or `misses by 4 %`.
pub(super) fn agreement_text(agreement: Agreement, report: &Report) -> String {
    match agreement {
        Agreement::Met => "met".to_owned(),
        Agreement::Missed { share: Some(share), .. } => {
            let percent = 100.0 * share.abs();
            format!("misses by {percent:.*} %", usize::from(percent < 1.0))
        }
        Agreement::Missed { difference, .. } => {
            format!("misses by {}", number::length(difference.abs(), report.spec.length))
        }
    }
}

/// Returns the ledger of position errors as a table.
pub(super) fn ledger(report: &Report) -> Table {
    let tolerance = report.study.tolerance;
    let mut header = vec!["source", ">max", ">RMS", ">share", "worst at (the rest as at home)"];
    if tolerance.is_some() {
        header.insert(3, ">of tolerance");
    }
    let mut rows = Vec::new();
    let Ledger { sources, sums } = &report.ledger;
    for LedgerEntry { name, max, rms, share, configuration, .. } in sources.iter().chain(sums) {
        let at = report.label_at(configuration.filter(|_| *max > 0.0));
        let show = |value| unit::fixed(report, Measurand::Position, value);
        let mut cells = vec![
            name.clone(),
            show(*max),
            rms.map(show).unwrap_or_default(),
            share.map(|share| percent(share, 1.0)).unwrap_or_default(),
            at,
        ];
        if let Some(tolerance) = tolerance {
            cells.insert(3, percent(*max, tolerance));
        }
        rows.push(cells);
    }
    let caption = "Norms of the errors of the tool point (mm): the largest, the root mean square, and the share of the judged error";
    Table::listing(caption, &header, rows)
}

/// Returns the ledger of orientation errors in mrad, rows 4–6 and their norm; `None` if no source
/// rotates the tool.
pub(super) fn orientation_ledger(report: &Report) -> Option<Table> {
    let (errors, combined) = report.budget.errors(Measurand::Orientation);
    if combined.worst_case_radius.value == 0.0 {
        return None;
    }
    let mut order = errors.iter().collect::<Vec<_>>();
    order.sort_by(|a, b| b.plain_max.norm.total_cmp(&a.plain_max.norm));
    let show = |value| unit::fixed(report, Measurand::Orientation, value);
    let [first, second, third] =
        unit::row_names(report, Measurand::Orientation).map(|name| format!(">{name}"));
    let mut header =
        vec!["source", &first, &second, &third, ">norm", ">RMS", "worst at (the rest as at home)"];
    let tolerance = report.study.orientation_tolerance;
    if tolerance.is_some() {
        header.insert(5, ">of tolerance");
    }
    let row = |name: &str, rows: [Option<f64>; 3], norm: Extreme, rms: Option<f64>| {
        // An error that is constant over the workspace has no worst configuration.
        let varies = norm.value > rms.unwrap_or_default() * (1.0 + 1e-9);
        let mut cells = vec![name.to_owned()];
        cells.extend(rows.map(|row| row.map(show).unwrap_or_default()));
        cells.extend([show(norm.value), rms.map(show).unwrap_or_default()]);
        cells.push(report.label_at(norm.configuration.filter(|_| varies)));
        if let Some(tolerance) = tolerance {
            cells.insert(5, percent(norm.value, tolerance));
        }
        cells
    };
    let alone = order.into_iter().map(|alone| {
        let Figures { x, y, z, norm } = alone.plain_max;
        let norm = Extreme { value: norm, configuration: alone.worst };
        row(&report.sources[alone.source].name, [x, y, z].map(Some), norm, Some(alone.rms))
    });
    let [repeatable, random, both] = combined.rms.map(Some);
    let together = [
        row("repeatable, with signs", combined.repeatable.map(Some), combined.repeatable_radius, repeatable),
        row("random, root sum of squares", combined.random.map(Some), combined.random_radius, random),
        row("all together", [None; 3], combined.radius, both),
    ];
    let rows = alone.chain(together).collect();
    Some(Table::listing("Rows 4 to 6 of ΔX in mrad, largest over the workspace", &header, rows))
}
