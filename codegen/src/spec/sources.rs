//! `[[source]]`: physical errors and the generalized errors they cause.

use super::names::title_of;
use super::{Class, Component, Distribution, Effect, Frame, Source};
use crate::diagnostic::{Diagnostic, suggestion};
use crate::document::{Document, Item, Section};
use crate::expr::{Allowed, Dimension, Entry, Motion, Scope};

const KEYS: [&str; 14] = [
    "name",
    "class",
    "distribution",
    "enabled",
    "description",
    "reference",
    "frame",
    "effect",
    "e_x",
    "e_y",
    "e_z",
    "e_s",
    "e_r",
    "e_p",
];

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
            section.check_keys(&KEYS, document);
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
    section.check_keys(&KEYS, document);
    let class = section.required("class", document);
    let class = class.and_then(|class| read_class(&class, section, document));
    let enabled = match section.get("enabled") {
        Some(item) => document.boolean(&item),
        None => Some(true),
    };
    let mut effects = read_effects(section, frames, scope, document);
    if let Some(items) =
        section.get("effect").and_then(|item| document.array(&item, "tables, each a [[source.effect]]"))
    {
        for item in items {
            if let Some(mut table) = document.section(&item) {
                table.span = item.span();
                table.name = format!("an effect of {}", section.name);
                table.check_keys(
                    &KEYS[6..].iter().copied().filter(|key| *key != "effect").collect::<Vec<_>>(),
                    document,
                );
                let read = read_effects(&table, frames, scope, document);
                if table.items().all(|item| item.key == "frame") {
                    no_effect(&table, document);
                }
                effects.extend(read);
            }
        }
    }
    if effects.is_empty() && !section.items().any(|item| item.key.starts_with("e_") || item.key == "effect") {
        no_effect(section, document);
    }
    let description = section.optional_text("description", document);
    let reference = section.optional_text("reference", document);
    Some(Source { name, class: class?, enabled: enabled?, description, reference, effects })
}

fn no_effect(section: &Section<'_>, document: &mut Document) {
    document.mistake(
        Diagnostic::new(section.span.clone(), format!("{} causes no error", section.name))
            .label("no `e_…` here")
            .help("give its `frame` and at least one of e_x, e_y, e_z, e_s, e_r, e_p"),
    );
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

/// The `e_…` of a source or of one of its effects, all at the `frame` beside them.
fn read_effects(
    section: &Section<'_>,
    frames: &[Frame],
    scope: &Scope,
    document: &mut Document,
) -> Vec<Effect> {
    let present: Vec<(Component, Item<'_>)> =
        Component::ALL.into_iter().filter_map(|c| section.get(c.name()).map(|item| (c, item))).collect();
    if present.is_empty() {
        if let Some(frame) = section.get("frame") {
            find_frame(&frame, frames, document);
        }
        return Vec::new();
    }
    let frame = section.required("frame", document).and_then(|item| find_frame(&item, frames, document));
    let mut effects = Vec::new();
    for (component, item) in present {
        let (dimension, motion) = match component.motion() {
            (Motion::Translation, axis) => (
                Dimension::LENGTH,
                ["translation along x", "translation along y", "translation along z"][axis],
            ),
            (Motion::Rotation, axis) => {
                (Dimension::NONE, ["rotation about x", "rotation about y", "rotation about z"][axis])
            }
        };
        let what = format!("`{}`, a {motion},", component.name());
        let entry = Entry { dimension: Some(dimension), what: &what, names: Allowed::Everything };
        let value = document.expression(&item, scope, entry);
        if let (Some(frame), Some(value)) = (frame, value) {
            effects.push(Effect { frame, component, value });
        }
    }
    effects
}

fn find_frame(item: &Item<'_>, frames: &[Frame], document: &mut Document) -> Option<usize> {
    let name = document.string(item)?;
    let found = frames.iter().position(|frame| frame.name == name);
    if found.is_none() {
        let names: Vec<&str> = frames.iter().map(|frame| frame.name.as_str()).collect();
        document.mistake(
            Diagnostic::new(item.span(), format!("there is no frame `{}`", name.escape_debug()))
                .label("not a frame of this spec")
                .help(suggestion(&name, &names, "frames")),
        );
    }
    found
}
