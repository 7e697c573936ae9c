//! The whole page.

use plotly::Plot;

use abbe::analysis::Measurand;
use abbe_study::analyze::{self, AfterCompensation, Report};

use super::{covered, escaped, facts, ledger, plots};
use crate::figure::Named;
use abbe_study::number::{percent, trimmed};

const STYLE: &str = include_str!("style.css");

/// The report, with its figures in their order, each with its drawing; `left_out` are sources that are switched off and had one.
///
/// `at_most` is the drawing of what is certified, if anything is.
pub(crate) fn page(
    figures: &[Named],
    drawings: &[String],
    at_most: Option<&str>,
    left_out: &[String],
    report: &Report,
) -> String {
    let parts = [
        heading(report),
        covered::verdict(report),
        summary(report),
        section("Every source alone", &format!("{METRICS}\n{}", ledger::sources(report))),
        section("All together", &(ledger::combined(report) + &conclusions(report))),
        certified(at_most, report),
        section("Ledger", &format!("{LEDGER}\n{}", ledger::listed(&analyze::ledger(report)))),
        covered::turns(report),
        allowed(report),
        covered::uncertainty(report),
        covered::monte_carlo(report),
        drawn(figures, drawings, left_out, report),
        section("Conventions", &facts::conventions(report)),
        section("Values", &facts::values(report)),
        notes(report),
        section("Input files", &facts::inputs(report)),
    ];
    document(&format!("{}: error analysis", report.spec.title), &parts.concat())
}

/// A page with its script and style in it.
pub(super) fn document(title: &str, body: &str) -> String {
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{}</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>\n{STYLE}</style>\n\
         <noscript><style>.plots {{ display: none !important; }} .drawing {{ display: block !important; }}</style></noscript>\n{}\n\
         </head>\n<body>\n<main>\n{body}</main>\n</body>\n</html>\n",
        escaped(title),
        script(),
    )
}

const METRICS: &str = "<p>Largest errors of the tool point over the workspace, along the axes of F<sub>0</sub>. \
    <i>Plain maximum</i>: the largest |ΔX|. <i>Half peak-to-peak</i>: half of what it varies by; of the norm the radius of the smallest sphere around all errors. \
    <i>Relative to home</i>: the largest difference from the error at home. Of a random source the bound, plus or \
    minus. Sources in order of their largest norm.</p>";

const LEDGER: &str =
    "<p>Norms of the errors of the tool point: the largest and the root mean square over the workspace.</p>";

/// The script that draws the figures: the first of two, the second sets formulas, of which there are none.
fn script() -> String {
    let scripts = Plot::offline_js_sources();
    let end = "</script>";
    scripts.find(end).map_or_else(String::new, |at| scripts[..at + end.len()].to_owned())
}

/// A part of a page.
pub(super) fn section(title: &str, body: &str) -> String {
    format!("<section>\n<h2>{title}</h2>\n{body}</section>\n")
}

fn heading(report: &Report) -> String {
    let description = report.spec.description.trim();
    let text = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    format!(
        "<header>\n<p class=\"kind\">Error analysis</p>\n<h1>{}</h1>\n<p class=\"study\">{}</p>\n<p>{}</p>\n</header>\n",
        escaped(&report.spec.title),
        escaped(&report.study.title),
        escaped(&text(description)),
    )
}

/// The few figures that matter most.
fn summary(report: &Report) -> String {
    let unit = report.spec.length.symbol();
    let radii = &report.combined.radii;
    let decimals = report.decimals().min(4);
    let show = |value| format!("{} {unit}", trimmed(value, decimals));
    let of = |value| {
        report.study.tolerance.map(|tolerance| format!("{} of the tolerance", percent(value, tolerance)))
    };
    let mut cards = vec![
        ("Radius of all errors".to_owned(), show(radii.radius), of(radii.radius)),
        (
            "Random errors alone".to_owned(),
            format!("± {}", show(radii.random_radius)),
            of(radii.random_radius),
        ),
    ];
    if let Some(AfterCompensation { total, .. }) = report.after_compensation {
        cards.push(("After compensation".to_owned(), format!("± {}", show(total)), of(total)));
    }
    if let Some(tolerance) = report.study.tolerance {
        cards.push(("Tolerance".to_owned(), format!("± {}", show(tolerance)), None));
    }
    let unreachable = &report.budget.unreachable;
    let unreached = if unreachable.count == 0 {
        "all reached".to_owned()
    } else {
        format!("{} unreachable: {}", unreachable.count, analyze::summary(unreachable, &report.spec))
    };
    cards.push(("Configurations".to_owned(), report.configurations.to_string(), Some(unreached)));
    let cards = cards.into_iter().map(|(name, value, note)| {
        let note = escaped(&note.unwrap_or_default());
        format!("<div class=\"card\"><span>{name}</span><b>{value}</b><small>{note}</small></div>\n")
    });
    let region = escaped(&report.workspace);
    format!(
        "<div class=\"cards\">\n{}</div>\n<p><b>Workspace.</b> {region}.</p>\n",
        cards.collect::<String>()
    )
}

/// The results in sentences.
fn conclusions(report: &Report) -> String {
    report.conclusions().iter().map(|sentence| format!("<p>{}</p>\n", escaped(sentence))).collect()
}

/// What was sampled, and what is certified.
fn certified(drawing: Option<&str>, report: &Report) -> String {
    let (Some(drawing), Some(listing)) = (drawing, analyze::at_most(report)) else { return String::new() };
    let unit = report.spec.length.symbol();
    let lines = match report.box_contains_more() {
        true => {
            "The line: what nothing in the box that contains the workspace exceeds, to first order. The box holds more than the \
             workspace, whose own maximum may be smaller"
        }
        false => {
            "The true maximum lies between the two lines: the first was found, and nothing in the box of the workspace exceeds the \
             second, to first order. Where both fall together it is one line"
        }
    };
    let tolerance = if report.study.tolerance.is_some() { "; the dashed line is the tolerance" } else { "" };
    let body = format!(
        "<figure>\n<div class=\"picture\">{}</div>\n<figcaption>Bars: what was sampled, a lower bound. {lines}{tolerance}.\
         </figcaption>\n</figure>\n<p>In {unit}.</p>\n{}",
        inline(drawing),
        ledger::listed(&listing)
    );
    section("At most", &body)
}

/// A drawing in a page, where it needs no name of a format.
fn inline(drawing: &str) -> String {
    drawing.replacen(" xmlns=\"http://www.w3.org/2000/svg\"", "", 1)
}

/// The budget backwards.
fn allowed(report: &Report) -> String {
    let about = "<p><i>Alone at most</i>: how much larger a source may be if it is the only one. <i>Equal shares</i>: how \
        much larger it may be if each takes the same share of the tolerance. <i>Gain</i>: by how much the radius shrinks \
        per percent that the source becomes smaller; the first is the one to tighten first.</p>\n";
    let tables = Measurand::ALL.into_iter().filter_map(|measurand| {
        let (_, unit) = analyze::unit::of(report, measurand);
        let table = ledger::listed(&analyze::allowed(report, measurand)?);
        Some(format!("<p>Gain in {unit}.</p>\n{table}"))
    });
    let tables = tables.collect::<String>();
    if tables.is_empty() { tables } else { section("What the tolerance allows", &format!("{about}{tables}")) }
}

fn drawn(figures: &[Named], drawings: &[String], left_out: &[String], report: &Report) -> String {
    let mut text = String::new();
    for (i, (figure, drawing)) in figures.iter().zip(drawings).enumerate() {
        let plots::Plots { plots, height, note } = plots::of(figure, report);
        let columns = plots.len();
        let panels = plots.iter().enumerate().map(|(j, plot)| {
            let id = format!("figure-{}-{}", i + 1, j + 1);
            format!(
                "<div class=\"plot\" style=\"height:{height}px\">{}</div>\n",
                plot.to_inline_html(Some(&id))
            )
        });
        let panels = panels.collect::<String>();
        let paper = &figure.asked.paper;
        let paper = if paper.is_empty() {
            String::new()
        } else {
            format!(" <span class=\"paper\">cf. {} of {}</span>", escaped(paper), escaped(report.publisher()))
        };
        let words =
            [&figure.asked.caption, &figure.workspace_note, &note].map(|words| escaped(words)).join(" ");
        text += &format!(
            "<figure>\n<h3>{}. {}{paper}</h3>\n<div class=\"plots of-{columns}\">\n{panels}</div>\n\
             <div class=\"drawing\">{}</div>\n<figcaption>{} <a href=\"{file}\">{file}</a></figcaption>\n</figure>\n",
            i + 1,
            escaped(&figure.title),
            // On paper, where nothing turns.
            inline(drawing),
            words.trim(),
            file = format_args!("{}.svg", figure.name),
        );
    }
    for source in left_out {
        text += &format!("<p>Not drawn: the source “{}” is switched off.</p>\n", escaped(source));
    }
    section(
        "Figures",
        &format!(
            "<p>Drag to turn or to zoom, point at a curve or a dot to see its configuration, double-click to go back. Errors are in mm, those of the orientation in mrad.</p>\n{text}"
        ),
    )
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
