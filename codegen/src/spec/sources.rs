//! `[[source]]`: physical errors and the generalized errors they cause.

use super::effects::read_effect;
use super::keys;
use super::names::title_of;
use super::{Class, Distribution, Frame, Source};
use crate::diagnostic::Diagnostic;
use crate::document::{Document, Item, Section};
use crate::expr::Scope;
use crate::keys::Keys;

/// What a source may say: of itself, and of its one effect.
const KNOWN: [&Keys; 3] = [&keys::SOURCE, &keys::PLACE, &keys::CAUSE];

/// Reads every source of a spec.
pub(super) fn read_sources(
    root: &Section<'_>,
    frames: &[Frame],
    scope: &Scope,
    document: &mut Document,
) -> Vec<Source> {
    let mut sources: Vec<Source> = Vec::new();
    let Some(items) = root.get("source").and_then(|item| document.array(&item, "tables, each a [[source]]"))
    else {
        return sources;
    };
    let mut spans: Vec<(String, crate::diagnostic::Span)> = Vec::new();
    for item in items {
        let Some(mut section) = document.section(&item) else {
            continue;
        };
        section.span = item.span();
        section.name = "this [[source]]".to_owned();
        let name = section.required("name", document);
        if let Some(name_item) = name
            && let Some(name) = title_of(&name_item, document)
        {
            section.name = format!("the source \"{name}\"");
            section.span = name_item.span();
            if let Some((_, first)) = spans.iter().find(|(known, _)| *known == name) {
                document.mistake(
                    Diagnostic::new(name_item.span(), format!("two sources are called \"{name}\""))
                        .label("second use")
                        .context(first.clone(), "first use")
                        .help(
                            "rename one; a source that acts at several frames lists [[source.effect]] tables",
                        ),
                );
            }
            spans.push((name.clone(), name_item.span()));
            sources.extend(read_source(&section, name, frames, scope, document));
        } else {
            section.check_keys(&KNOWN, document);
        }
    }
    sources
}

fn read_source(
    section: &Section<'_>,
    name: String,
    frames: &[Frame],
    scope: &Scope,
    document: &mut Document,
) -> Option<Source> {
    section.check_keys(&KNOWN, document);
    let class = section.required("class", document);
    let class = class.and_then(|class| read_class(&class, section, document));
    let enabled = match section.get("enabled") {
        Some(item) => document.boolean(&item),
        None => Some(true),
    };
    let mut effects = Vec::new();
    let tables =
        section.get("effect").and_then(|item| document.array(&item, "tables, each a [[source.effect]]"));
    if tables.is_none() || section.items().any(|item| KNOWN[1..].iter().any(|keys| keys.contain(&item.key))) {
        effects.extend(read_effect(section, frames, scope, document));
    }
    for item in tables.unwrap_or_default() {
        if let Some(mut table) = document.section(&item) {
            table.span = item.span();
            table.name = format!("an effect of {}", section.name);
            table.check_keys(&KNOWN[1..], document);
            effects.extend(read_effect(&table, frames, scope, document));
        }
    }
    let description = section.optional_text("description", document);
    let reference = section.optional_text("reference", document);
    Some(Source { name, class: class?, enabled: enabled?, description, reference, effects })
}

fn read_class(item: &Item<'_>, section: &Section<'_>, document: &mut Document) -> Option<Class> {
    let random = document.choice(item, &[("repeatable", false), ("random", true)])?;
    let distribution = section.get("distribution");
    match (random, distribution) {
        (false, None) => Some(Class::Repeatable),
        (false, Some(distribution)) => {
            document.mistake(
                Diagnostic::new(distribution.key_span, "a repeatable error has no distribution")
                    .context(item.span(), "repeatable")
                    .help("leave `distribution` out, or write class = \"random\""),
            );
            None
        }
        (true, None) => {
            document.mistake(
                Diagnostic::new(item.span(), "a random error needs its distribution")
                    .label("distributed how?")
                    .help("add distribution = \"uniform\" (values are half-widths) or \"normal\" (values are σ)"),
            );
            None
        }
        (true, Some(distribution)) => {
            let choices = [("uniform", Distribution::Uniform), ("normal", Distribution::Normal)];
            document.choice(&distribution, &choices).map(Class::Random)
        }
    }
}
