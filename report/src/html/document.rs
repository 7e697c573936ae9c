//! Parts of every page.

use abbe_study::explore::Report;

use super::escaped;
use crate::{document::Card, explore::Panels};

const STYLE: &str = include_str!("style.css");

/// Formats an HTML document with its style sheet, and with the scripts of live panels whose
/// elements are in the body.
pub(super) fn document(title: &str, body: &str, panels: Option<&Panels>) -> String {
    let [policy, style, scripts] = match panels {
        None => [const { "" }; 3],
        Some(Panels { policy, style, scripts, .. }) => [policy, style, scripts].map(String::as_str),
    };
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n{policy}\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{}</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>{STYLE}</style>\n{style}\
         </head>\n<body>\n<main>\n{body}</main>\n{scripts}</body>\n</html>\n",
        escaped(title),
    )
}

/// Creates the live panel of a machine, if there are its data.
pub(super) fn panels(live: Option<&Report>) -> Option<Panels> {
    live.map(|live| Panels::new(std::slice::from_ref(live), &[STYLE]))
}

/// Formats the element of a live panel; empty without one.
pub(super) fn panel(title: &str, panels: Option<&Panels>) -> String {
    panels.map_or_else(String::new, |panels| {
        format!("<div class=\"abbe-explore\">\n<h2>{title}</h2>\n{}</div>\n", panels.elements)
    })
}

/// Formats the heading: the kind of report, the machine, and the study or the map.
pub(super) fn heading(kind: &str, title: &str, study: &str) -> String {
    format!(
        "<header>\n<p class=\"kind\">{kind}</p>\n<h1>{}</h1>\n<p class=\"study\">{}</p>\n</header>\n",
        escaped(title),
        escaped(study)
    )
}

/// Formats a verdict and the sentences about it.
pub(super) fn verdict(is_met: bool, line: &str, sentences: &[String]) -> String {
    let class = if is_met { "met" } else { "missed" };
    format!(
        "<section class=\"verdict\">\n<h2 class=\"{class}\">{}</h2>\n{}</section>\n",
        escaped(line),
        paragraphs(sentences)
    )
}

/// Formats important numbers.
pub(super) fn cards(cards: &[Card]) -> String {
    let cards = cards.iter().map(|Card { name, value, note }| {
        let note = escaped(note);
        format!("<div class=\"card\"><span>{name}</span><b>{value}</b><small>{note}</small></div>\n")
    });
    format!("<div class=\"cards\">\n{}</div>\n", cards.collect::<String>())
}

/// Formats sentences, each as a paragraph.
pub(super) fn paragraphs(sentences: &[String]) -> String {
    sentences.iter().map(|sentence| format!("<p>{}</p>\n", escaped(sentence))).collect()
}

/// Formats a section.
pub(super) fn section(title: &str, body: &str) -> String {
    format!("<section>\n<h2>{title}</h2>\n{body}</section>\n")
}

/// Formats a section that is closed on a screen, and open on paper.
pub(super) fn folded(title: &str, body: &str) -> String {
    format!("<section>\n<details>\n<summary><h2>{title}</h2></summary>\n{body}</details>\n</section>\n")
}
