//! What a source does to a frame: errors as they are, the sag of a beam, a compliance; there or at another place
//! on the link.

use super::{Beam, Cause, Compliance, Component, Effect, Frame, keys};
use crate::diagnostic::{Diagnostic, suggestion};
use crate::document::{Document, Item, Section};
use crate::expr::{Allowed, Dimension, Entry, Expression, Motion, Scope, motion, parse_transform};

/// Reads the effect that a source, or one of its `[[source.effect]]` tables, describes.
pub(super) fn read_effect(
    section: &Section<'_>,
    frames: &[Frame],
    scope: &Scope,
    document: &mut Document,
) -> Option<Effect> {
    let causes: Vec<Item<'_>> = section.items().filter(|item| keys::CAUSE.contain(&item.key)).collect();
    let Some(first) = causes.first() else {
        document.mistake(
            Diagnostic::new(section.span.clone(), format!("{} causes no error", section.name))
                .label("no `e_…` here")
                .help("give its `frame` and at least one of e_x, e_y, e_z, e_s, e_r, e_p, or a `beam` or `compliance`; or the `error` of a `joint` or `parameter`"),
        );
        return None;
    };
    let elastic = |item: &&Item<'_>| !item.key.starts_with("e_");
    if let Some(one) = causes.iter().find(elastic)
        && causes.len() > 1
    {
        let other = if one.key == first.key { &causes[1] } else { first };
        document.mistake(
            Diagnostic::new(other.key_span.clone(), format!("`{}` stands beside `{}`", other.key, one.key))
                .label("one too many")
                .context(one.key_span.clone(), "the other one")
                .help("list them as [[source.effect]] tables of the source"),
        );
        return None;
    }
    let frame = section.required("frame", document).and_then(|item| find_frame(&item, frames, document));
    let at = match section.get("at") {
        Some(item) => read_place(&item, scope, document),
        None => Some(Vec::new()),
    };
    let cause = match first.key.as_str() {
        "beam" => read_beam(first, scope, document).map(Cause::Beam),
        "compliance" => read_compliance(first, scope, document).map(|read| Cause::Compliance(Box::new(read))),
        _ => read_errors(section, scope, document).map(Cause::Errors),
    };
    Some(Effect { frame: frame?, at: at?, cause: cause?, span: first.key_span.clone() })
}

/// The index of the frame that an item names.
pub(super) fn find_frame(item: &Item<'_>, frames: &[Frame], document: &mut Document) -> Option<usize> {
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

fn read_place(item: &Item<'_>, scope: &Scope, document: &mut Document) -> Option<Vec<super::Factor>> {
    let (text, place) = document.text(item)?;
    let factors = parse_transform(text, &place, scope, &mut document.found)?;
    Some(factors.into_iter().map(super::Factor::Elementary).collect())
}

fn read_errors(
    section: &Section<'_>,
    scope: &Scope,
    document: &mut Document,
) -> Option<Vec<(Component, Expression)>> {
    let mut errors = Vec::new();
    let mut complete = true;
    for component in Component::ALL {
        if let Some(item) = section.get(component.name()) {
            let (motion, axis) = motion(component);
            let (dimension, verb) = match motion {
                Motion::Translation => (Dimension::LENGTH, "translation along"),
                Motion::Rotation => (Dimension::NONE, "rotation about"),
            };
            let what = format!("`{}`, a {verb} {},", component.name(), ["x", "y", "z"][axis]);
            let entry = Entry { dimension: Some(dimension), what: &what, names: Allowed::Everything };
            match document.expression(&item, scope, entry) {
                Some(value) => errors.push((component, value)),
                None => complete = false,
            }
        }
    }
    complete.then_some(errors)
}

const STIFFNESS: Dimension = Dimension::FORCE_TIMES_AREA;

fn read_beam(item: &Item<'_>, scope: &Scope, document: &mut Document) -> Option<Beam> {
    let mut table = document.section(item)?;
    table.name = "`beam`".to_owned();
    table.check_keys(&[&keys::BEAM], document);
    let mut quantity = |key: &str, dimension: Dimension, required: bool| -> Option<Option<Expression>> {
        let item = if required { Some(table.required(key, document)?) } else { table.get(key) };
        let what = format!("`{key}`");
        let entry = Entry { dimension: Some(dimension), what: &what, names: Allowed::Everything };
        let Some(item) = item else {
            return Some(None);
        };
        let value = document.expression(&item, scope, entry)?;
        if value.constant().is_some_and(|value| value <= 0.0) {
            document.mistake(
                Diagnostic::new(item.span(), format!("`{key}` of a beam must be positive"))
                    .help("leave `GJ` or `EA` out where the beam is rigid"),
            );
            return None;
        }
        Some(Some(value))
    };
    let length = quantity("length", Dimension::LENGTH, true);
    let (y, z) = (quantity("EI_y", STIFFNESS, true), quantity("EI_z", STIFFNESS, true));
    let (torsion, extension) = (quantity("GJ", STIFFNESS, false), quantity("EA", Dimension::FORCE, false));
    let axis = match table.get("axis") {
        Some(item) => document.choice(&item, &[("x", 0), ("y", 1), ("z", 2)]),
        None => Some(0),
    };
    Some(Beam {
        axis: axis?,
        length: length??,
        bending: [y??, z??],
        torsion: torsion?,
        extension: extension?,
    })
}

fn read_compliance(item: &Item<'_>, scope: &Scope, document: &mut Document) -> Option<Compliance> {
    let mut table = document.section(item)?;
    table.name = "`compliance`".to_owned();
    table.check_keys(&[&keys::COMPLIANCE], document);
    let entry = |row: usize, column: usize, item: &Item<'_>, document: &mut Document| {
        let what = format!("{} per unit of {}", Component::ALL[row].name(), WRENCH[column]);
        let entry =
            Entry { dimension: Some(dimension(row, column)), what: &what, names: Allowed::Everything };
        document.expression(item, scope, entry)
    };
    let mut compliance = Compliance::default();
    match (table.get("diagonal"), table.get("matrix")) {
        (Some(diagonal), None) => {
            let entries: [Item<'_>; 6] = document.entries(&diagonal, "six numbers")?;
            for (i, item) in entries.iter().enumerate() {
                compliance[i][i] = Some(entry(i, i, item, document)?);
            }
        }
        (None, Some(matrix)) => {
            let rows: [Item<'_>; 6] = document.entries(&matrix, "six rows of six numbers")?;
            for (i, row) in rows.iter().enumerate() {
                let entries: [Item<'_>; 6] = document.entries(row, "six rows of six numbers")?;
                for (j, item) in entries.iter().enumerate() {
                    compliance[i][j] = Some(entry(i, j, item, document)?);
                }
            }
            check_symmetric(&compliance, document)?;
        }
        _ => {
            document.mistake(
                Diagnostic::new(item.key_span.clone(), "a compliance needs its numbers")
                    .label("`diagonal` or `matrix`?")
                    .help("write { diagonal = [six] } or { matrix = [[six], …] }, in the order of e_x e_y e_z e_s e_r e_p"),
            );
            return None;
        }
    }
    Some(compliance)
}

/// Forces and moments in the order of ε.
const WRENCH: [&str; 6] =
    ["force along x", "force along y", "force along z", "moment about y", "moment about z", "moment about x"];

fn dimension(row: usize, column: usize) -> Dimension {
    let error = if row < 3 { Dimension::LENGTH } else { Dimension::NONE };
    let wrench = if column < 3 { Dimension::FORCE } else { Dimension::MOMENT };
    // Both are small powers, whose quotient is one.
    error.over(wrench).unwrap_or(Dimension::NONE)
}

/// By reciprocity the work of two loads does not depend on their order.
fn check_symmetric(compliance: &Compliance, document: &mut Document) -> Option<()> {
    for (i, row) in compliance.iter().enumerate() {
        for (j, entry) in row.iter().enumerate().take(i) {
            let (Some(below), Some(above)) = (entry, &compliance[j][i]) else { continue };
            let (Some(a), Some(b)) = (below.constant(), above.constant()) else { continue };
            if (a - b).abs() > 1e-9 * a.abs().max(b.abs()) {
                document.mistake(
                    Diagnostic::new(below.span(), "a compliance matrix must be symmetric")
                        .label(format!("this is {a}"))
                        .context(above.span(), format!("this is {b}"))
                        .help("displacement k per unit of load l equals displacement l per unit of load k"),
                );
                return None;
            }
        }
    }
    Some(())
}
