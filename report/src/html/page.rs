//! Page of an analysis.

use abbe::analysis::Measurand;
use abbe_study::analyze::{self, AfterCompensation, Report};
use abbe_study::explore;
use abbe_study::number::{percent, trimmed};
use abbe_study::study_file::Content;

use super::{Card, cards, document, escaped, findings, folded, heading, panel, panels, paragraphs, section};
use super::{covered, facts, figure, ledger};
use crate::figures::NamedFigure;
use crate::scene::Scene;
use crate::text::{self, Detail};

/// Builds the page of an analysis with its figures, which begin with the Pareto chart and the
/// cloud.
///
/// `sampled` is the figure of certified bounds, if there are any. `left_out` are disabled sources
/// whose figures are missing. `live` is the data of the live panel, which follows the verdict.
pub(crate) fn page(
    figures: &[(NamedFigure, Scene)],
    sampled: Option<&Scene>,
    left_out: &[String],
    report: &Report,
    live: Option<&explore::Report>,
) -> String {
    let is_first = |(named, _): &&(NamedFigure, Scene)| {
        matches!(named.request.content, Content::Pareto | Content::Cloud)
    };
    let (first, others) = figures.split_at(figures.iter().take_while(is_first).count());
    let panels = panels(live);
    let before = [
        heading("Error analysis", &report.spec.title, &report.study.title),
        description(report),
        covered::verdict(report),
        panel("Errors at a configuration", panels.as_ref()),
        summary(report),
    ];
    let after = [
        drawn("Figures", first, 0),
        section("All sources together", &(ledger::combined(report) + &paragraphs(&report.conclusions()))),
        certified(sampled, report),
        allowed(report),
        drawn("More figures", others, first.len()) + &not_drawn(left_out),
        folded("Each source alone", &format!("{METRICS}\n{}", ledger::sources(report))),
        folded("Ledger", &ledger::listed(LEDGER, &analyze::ledger(report))),
        covered::turns(report),
        covered::uncertainty(report),
        covered::monte_carlo(report),
        notes(report),
        folded("Conventions", &facts::conventions(report)),
        folded("Values", &facts::values(report)),
        facts::inputs(report),
    ];
    let (before, after) = (before.concat(), after.concat());
    let findings = findings(|| text::analysis(report, Detail::Full), &format!("{before}{after}"));
    let title = format!("{}: error analysis", report.spec.title);
    document(&title, &[before, findings, after].concat(), panels.as_ref())
}

const METRICS: &str = "<p>Largest errors of the tool point over the workspace, along the axes of \
    F<sub>0</sub>. <i>Plain maximum</i>: the largest |ΔX|. <i>Half peak-to-peak</i>: half of the \
    range of ΔX; for the norm, the radius of the smallest sphere that contains all errors. \
    <i>Relative to home</i>: the largest difference from the error at home. For a random source, \
    the bound (±). Sources are sorted by their largest norm.</p>";

const LEDGER: &str =
    "Norms of the errors of the tool point: the largest and the root mean square over the workspace";

fn description(report: &Report) -> String {
    let words = report.spec.description.split_whitespace().collect::<Vec<_>>().join(" ");
    if words.is_empty() { words } else { paragraphs(&[words]) }
}

/// Formats the most important figures as cards.
fn summary(report: &Report) -> String {
    let unit = report.spec.length.symbol();
    let radii = &report.combined.radii;
    let decimals = report.decimals().min(4);
    let show = |value| format!("{} {unit}", trimmed(value, decimals));
    let of = |value| {
        report.study.tolerance.map(|tolerance| format!("{} of the tolerance", percent(value, tolerance)))
    };
    let card = |name, value, note: Option<String>| Card { name, value, note: note.unwrap_or_default() };
    let mut all = vec![
        card("Total error radius", show(radii.radius), of(radii.radius)),
        card("Random errors only", format!("± {}", show(radii.random_radius)), of(radii.random_radius)),
    ];
    if let Some(AfterCompensation { total, .. }) = report.after_compensation {
        all.push(card("After compensation", format!("± {}", show(total)), of(total)));
    }
    if let Some(tolerance) = report.study.tolerance {
        all.push(card("Tolerance", format!("± {}", show(tolerance)), None));
    }
    let unreachable = &report.budget.unreachable;
    let unreached = match unreachable.count {
        0 => "all reachable".to_owned(),
        count => format!("{count} unreachable: {}", analyze::unreachable_summary(unreachable, &report.spec)),
    };
    all.push(card("Configurations", report.configurations.to_string(), Some(unreached)));
    let singular = if report.singular() > 0 {
        format!("<p>{}</p>\n", escaped(&report.singular_sentence()))
    } else {
        String::new()
    };
    format!("{}<p><b>Workspace.</b> {}.</p>\n{singular}", cards(all), escaped(&report.workspace))
}

/// Formats sampled errors and certified bounds.
fn certified(sampled: Option<&Scene>, report: &Report) -> String {
    let (Some(scene), Some(listing)) = (sampled, analyze::norm_comparison_table(report)) else {
        return String::new();
    };
    let unit = report.spec.length.symbol();
    let figure = figure::unnumbered("", scene, "");
    let caption = format!("Largest norms, sampled and certified ({unit})");
    section("Certified bounds", &(figure + &ledger::listed(&caption, &listing)))
}

/// Formats the allowed sizes of the sources.
fn allowed(report: &Report) -> String {
    let about = "<p><i>Alone at most</i>: factor by which a source may grow if all other errors \
        are zero. <i>Equal shares</i>: factor by which it may grow if every source takes an equal \
        share of the tolerance. <i>Gain</i>: decrease of the radius per percent decrease of the \
        source; tighten the first source first.</p>\n";
    let tables = Measurand::ALL.into_iter().filter_map(|measurand| {
        let (_, unit) = analyze::unit::display_unit(report, measurand);
        let caption = format!("Allowed factors of the sources, and gain per percent ({unit})");
        Some(ledger::listed(&caption, &analyze::allowance_table(report, measurand)?))
    });
    let tables = tables.collect::<String>();
    if tables.is_empty() { tables } else { section("Error allowance", &format!("{about}{tables}")) }
}

/// Formats figures, numbered after `before` others.
fn drawn(title: &str, figures: &[(NamedFigure, Scene)], before: usize) -> String {
    let figures = figures.iter().enumerate().map(|(i, (named, scene))| {
        let (file, note) = (format!("{}.svg", named.name), escaped(&named.workspace_note));
        figure::figure(before + i + 1, scene, &format!("{note} <a href=\"{file}\">{file}</a>"))
    });
    match figures.collect::<String>() {
        none if none.is_empty() => none,
        figures => {
            section(title, &format!("<p>Errors are in mm, those of the orientation in mrad.</p>\n{figures}"))
        }
    }
}

fn not_drawn(sources: &[String]) -> String {
    let sentence = |source: &String| format!("Not drawn: the source “{source}” is disabled.");
    paragraphs(&sources.iter().map(sentence).collect::<Vec<_>>())
}

fn notes(report: &Report) -> String {
    let notes = &report.study.not_reproducible;
    if notes.is_empty() {
        return String::new();
    }
    let items = notes.iter().map(|note| format!("<li>{}</li>\n", escaped(note)));
    let title = format!("Not reproducible from {}", escaped(report.publisher()));
    section(&title, &format!("<ul>\n{}</ul>\n", items.collect::<String>()))
}
