//! The whole page.

use plotly::Plot;

use super::{escaped, facts, ledger, plots};
use crate::report::figure::Figure;
use crate::report::subject::Subject;
use abbe_study::number::{percent, trimmed};

const STYLE: &str = include_str!("style.css");

/// The report, with its figures in their order, each with its drawing; `left_out` are sources that are switched off and had one.
pub(in crate::report) fn page(
    figures: &[Figure],
    drawings: &[String],
    left_out: &[&str],
    subject: &Subject,
) -> String {
    let parts = [
        heading(subject),
        summary(subject),
        section("Every source alone", &format!("{METRICS}\n{}", ledger::sources(subject))),
        section("All together", &(ledger::combined(subject) + &conclusions(subject))),
        section("Ledger", &format!("{LEDGER}\n{}", ledger::listed(&subject.ledger))),
        allowed(subject),
        drawn(figures, drawings, left_out, subject),
        section("Conventions", &facts::conventions(subject)),
        section("Values", &facts::values(subject)),
        notes(subject),
        section("Input files", &facts::inputs(subject)),
    ];
    document(&format!("{}: error analysis", subject.description.title), &parts.concat())
}

/// A page with its script and style in it.
pub(crate) fn document(title: &str, body: &str) -> String {
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
    <i>Plain maximum</i>: the largest |ΔX|. <i>Half peak-to-peak</i>: half of what it varies by. \
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
pub(crate) fn section(title: &str, body: &str) -> String {
    format!("<section>\n<h2>{title}</h2>\n{body}</section>\n")
}

fn heading(subject: &Subject) -> String {
    let description = subject.spec.description.trim();
    let text = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    format!(
        "<header>\n<p class=\"kind\">Error analysis</p>\n<h1>{}</h1>\n<p class=\"study\">{}</p>\n<p>{}</p>\n</header>\n",
        escaped(&subject.description.title),
        escaped(&subject.study.title),
        escaped(&text(description)),
    )
}

/// The few figures that matter most.
fn summary(subject: &Subject) -> String {
    let unit = subject.description.length.symbol();
    let combined = &subject.budget.combined;
    let decimals = subject.decimals.min(4);
    let show = |value| format!("{} {unit}", trimmed(value, decimals));
    let of = |value| {
        subject.study.tolerance.map(|tolerance| format!("{} of the tolerance", percent(value, tolerance)))
    };
    let mut cards = vec![
        ("Radius of all errors".to_owned(), show(combined.radius.value), of(combined.radius.value)),
        (
            "Random errors alone".to_owned(),
            format!("± {}", show(combined.random_radius.value)),
            of(combined.random_radius.value),
        ),
    ];
    if let Some(compensated) = &subject.study.compensated {
        let total = compensated.residual + combined.random_radius.value;
        cards.push(("After compensation".to_owned(), format!("± {}", show(total)), of(total)));
    }
    if let Some(tolerance) = subject.study.tolerance {
        cards.push(("Tolerance".to_owned(), format!("± {}", show(tolerance)), None));
    }
    let (unreached, reasons) = &subject.unreachable;
    let unreached = if *unreached == 0 {
        "all reached".to_owned()
    } else {
        format!("{unreached} unreachable: {reasons}")
    };
    cards.push(("Configurations".to_owned(), subject.configurations.to_string(), Some(unreached)));
    let cards = cards.into_iter().map(|(name, value, note)| {
        let note = escaped(&note.unwrap_or_default());
        format!("<div class=\"card\"><span>{name}</span><b>{value}</b><small>{note}</small></div>\n")
    });
    let region = escaped(subject.region);
    format!(
        "<div class=\"cards\">\n{}</div>\n<p><b>Workspace.</b> {region}.</p>\n",
        cards.collect::<String>()
    )
}

/// The results in sentences.
fn conclusions(subject: &Subject) -> String {
    subject.conclusions.iter().map(|sentence| format!("<p>{}</p>\n", escaped(sentence))).collect()
}

/// The budget backwards.
fn allowed(subject: &Subject) -> String {
    let about = "<p><i>Alone at most</i>: how much larger a source may be if it is the only one. <i>Equal shares</i>: how \
        much larger it may be if each takes the same share of the tolerance. <i>Gain</i>: by how much the radius shrinks \
        per percent that the source becomes smaller; the first is the one to tighten first.</p>\n";
    let table = subject.allowed.as_ref().map(|allowed| format!("{about}{}", ledger::listed(allowed)));
    table.map_or_else(String::new, |table| section("What the tolerance allows", &table))
}

fn drawn(figures: &[Figure], drawings: &[String], left_out: &[&str], subject: &Subject) -> String {
    let mut text = String::new();
    for (i, (figure, drawing)) in figures.iter().zip(drawings).enumerate() {
        let plots::Plots { plots, height, note } = plots::of(figure, subject);
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
            format!(
                " <span class=\"paper\">cf. {} of {}</span>",
                escaped(paper),
                escaped(subject.publisher())
            )
        };
        let words =
            [&figure.asked.caption, &figure.workspace_note, &note].map(|words| escaped(words)).join(" ");
        text += &format!(
            "<figure>\n<h3>{}. {}{paper}</h3>\n<div class=\"plots of-{columns}\">\n{panels}</div>\n\
             <div class=\"drawing\">{}</div>\n<figcaption>{} <a href=\"{file}\">{file}</a></figcaption>\n</figure>\n",
            i + 1,
            escaped(&figure.title),
            // On paper, where nothing turns; a page needs no name of a format.
            drawing.replacen(" xmlns=\"http://www.w3.org/2000/svg\"", "", 1),
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
            "<p>Drag to turn or to zoom, point at a curve or a dot to see its configuration, double-click to go back. Errors are in mm.</p>\n{text}"
        ),
    )
}

fn notes(subject: &Subject) -> String {
    let notes = &subject.study.not_reproducible;
    if notes.is_empty() {
        return String::new();
    }
    let items = notes.iter().map(|note| format!("<li>{}</li>\n", escaped(note)));
    let title = format!("Not reproducible from {}", escaped(subject.publisher()));
    section(&title, &format!("<ul>\n{}</ul>\n", items.collect::<String>()))
}
