//! `[[load]]` and `gravity`: what weighs on beams and compliances.

use super::effects::find_frame;
use super::{Cause, Frame, Load, Source, keys};
use crate::diagnostic::Diagnostic;
use crate::document::{Document, Item, Section};
use crate::expr::{Allowed, Dimension, Entry, Expression, Scope};

/// Reads every load of a spec.
pub(super) fn read_loads(
    root: &Section<'_>,
    frames: &[Frame],
    scope: &Scope,
    document: &mut Document,
) -> Vec<Load> {
    let items = root.get("load").and_then(|item| document.array(&item, "tables, each a [[load]]"));
    let mut loads = Vec::new();
    for item in items.unwrap_or_default() {
        if let Some(mut section) = document.section(&item) {
            section.span = item.span();
            section.name = "this [[load]]".to_owned();
            section.check_keys(&[&keys::LOAD], document);
            loads.extend(read_load(&section, frames, scope, document));
        }
    }
    loads
}

fn read_load(
    section: &Section<'_>,
    frames: &[Frame],
    scope: &Scope,
    document: &mut Document,
) -> Option<Load> {
    let mass = section.required("mass", document).and_then(|item| {
        let entry = Entry {
            dimension: Some(Dimension::MASS),
            what: "the mass of a load",
            names: Allowed::Everything,
        };
        document.expression(&item, scope, entry)
    });
    let frame = section.required("frame", document).and_then(|item| find_frame(&item, frames, document));
    let point = match section.get("point") {
        Some(item) => vector(&item, Dimension::LENGTH, "a coordinate of a load", scope, document),
        None => Some([0, 1, 2].map(|_| Expression::number(0.0, Dimension::LENGTH, section.span.clone()))),
    };
    Some(Load { mass: mass?, frame: frame?, point: point? })
}

/// Reads `gravity`, which stands in [manipulator] or at the top of the file.
pub(super) fn read_gravity(
    item: &Item<'_>,
    scope: &Scope,
    document: &mut Document,
) -> Option<[Expression; 3]> {
    vector(item, Dimension::ACCELERATION, "a component of gravity", scope, document)
}

fn vector(
    item: &Item<'_>,
    dimension: Dimension,
    what: &str,
    scope: &Scope,
    document: &mut Document,
) -> Option<[Expression; 3]> {
    let entries: [Item<'_>; 3] = document.entries(item, "three numbers")?;
    let entry = Entry { dimension: Some(dimension), what, names: Allowed::Everything };
    let read = entries.map(|item| document.expression(&item, scope, entry));
    let [x, y, z] = read;
    Some([x?, y?, z?])
}

/// Beams and compliances move only under loads, and loads weigh only under gravity.
pub(super) fn check_loaded(
    root: &Section<'_>,
    sources: &[Source],
    loads: &[Load],
    gravity: bool,
    document: &mut Document,
) {
    for source in sources {
        for effect in source.effects.iter().filter(|effect| !matches!(effect.cause, Cause::Errors(_))) {
            if !loads.iter().any(|load| load.frame >= effect.frame) {
                document.mistake(
                    Diagnostic::new(
                        effect.span.clone(),
                        format!("nothing weighs on the source \"{}\"", source.name),
                    )
                    .label("it would cause no error")
                    .help("add a [[load]] at its frame or at one behind it"),
                );
            }
        }
    }
    if let Some(item) = root.get("load").filter(|_| !loads.is_empty() && !gravity) {
        document.mistake(
            Diagnostic::new(item.key_span, "there are loads but no gravity")
                .label("they weigh nothing")
                .help("add `gravity = [0, 0, \"-9.80665 m/s^2\"]` to [manipulator], in the axes of F_0"),
        );
    }
}
