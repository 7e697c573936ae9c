//! Effects of a source on a frame: given errors, the deflection of a beam, or a compliance, at the
//! frame or at another place on its link.
//!
//! Frames that are named by a tree or a loop: `parent`, and the `frames` of a loop.

use abbe_core::Component;

use super::elastic::{read_beam, read_compliance};
use super::keys;
use crate::degrees::check_error_of_angle;
use crate::diagnostic::{Diagnostic, Span, suggestion};
use crate::document::{Item, Section};
use crate::expr::{Allowed, Dimension, Entry, Expression, Motion, Scope, motion, parse_transform};
use crate::manipulator::{Cause, Effect, Factor, Frame, Tree};
use crate::value::find_name;

/// Reads the effect of a source, or of one of its `[[source.effect]]` tables.
pub(super) fn read_effect(section: &Section<'_>, tree: Tree<'_>, scope: &Scope) -> Option<Effect> {
    let causes: Vec<Item<'_>> = section.items().filter(|item| keys::CAUSE.contain(&item.key)).collect();
    let Some(first) = causes.first() else {
        return section.document.fail(Diagnostic::new(section.span.clone(), format!("{} causes no error", section.name))
                .label("no `e_…` here")
                .help("give its `frame` and at least one of e_x, e_y, e_z, e_s, e_r, e_p, or a `beam` or `compliance`; or the `error` of a `joint` or `parameter`"));
    };
    let elastic = |item: &&Item<'_>| !item.key.starts_with("e_");
    if let Some(one) = causes.iter().find(elastic)
        && causes.len() > 1
    {
        let other = if one.key == first.key { &causes[1] } else { first };
        let message = format!("`{}` and `{}` cannot be combined", other.key, one.key);
        let help = "list them as [[source.effect]] tables of the source";
        let mistake = Diagnostic::new(other.key_span.clone(), message).label("one too many");
        return section.document.fail(mistake.context(one.key_span.clone(), "the other one").help(help));
    }
    let (frame, base) = place(&section.required("frame")?, tree)?;
    let at = section.get("at").map_or(Some(Vec::new()), |item| read_place(&item, scope));
    let cause = match first.key.as_str() {
        "beam" => read_beam(first, scope).map(Cause::Beam),
        "compliance" => read_compliance(first, scope).map(|read| Cause::Compliance(Box::new(read))),
        _ => read_errors(section, scope).map(Cause::Errors),
    };
    let is_of_base = base.is_some();
    let at = base.into_iter().flatten().chain(at?).collect();
    Some(Effect { frame, is_of_base, at, cause: cause?, span: first.key_span.clone() })
}

/// Returns the index of the frame that an item names; with the inverse of its transform if that is
/// `F_0`, whose errors are those of the first frame at another place.
fn place(item: &Item<'_>, tree: Tree<'_>) -> Option<(usize, Option<Vec<Factor>>)> {
    let is_base = item.string()? == BASE && tree.frames.iter().all(|frame| frame.name != BASE);
    if !is_base {
        return find_frame(item, tree.frames).map(|frame| (frame, None));
    }
    if !tree.loops.is_empty() || tree.frames.iter().skip(1).any(|frame| frame.parent.is_none()) {
        let help = "add a first [[frame]] with `transform = \"Tx(0)\"`, on which the others hang, and give it the errors";
        return item.refuse("several frames hang on the base, or loops end there", help);
    }
    Some((0, Some(Factor::inverse(&tree.frames.first()?.factors))))
}

/// Returns the index of the frame that an item names.
pub(super) fn find_frame(item: &Item<'_>, frames: &[Frame]) -> Option<usize> {
    let name = item.string()?;
    let found = frames.iter().position(|frame| frame.name == name);
    if found.is_none() {
        let names: Vec<&str> = frames.iter().map(|frame| frame.name.as_str()).collect();
        let help = suggestion(item.document.mistakes(), &name, &names, "frames");
        let mistake = Diagnostic::new(item.span(), format!("unknown frame `{}`", name.escape_debug()));
        item.document.mistake(mistake.label("not a frame of this spec").help(help));
    }
    found
}

fn read_place(item: &Item<'_>, scope: &Scope) -> Option<Vec<Factor>> {
    let factors = parse_transform(&item.located_text()?, scope, &mut item.document.found.borrow_mut())?;
    Some(factors.into_iter().map(Factor::Elementary).collect())
}

fn read_errors(section: &Section<'_>, scope: &Scope) -> Option<Vec<(Component, Expression)>> {
    let read = |component: Component| {
        let item = section.get(component.name())?;
        let (motion, axis) = motion(component);
        let (dimension, verb) = match motion {
            Motion::Translation => (Dimension::LENGTH, "translation along"),
            Motion::Rotation => (Dimension::NONE, "rotation about"),
        };
        let what = format!("`{}`, a {verb} {},", component.name(), ["x", "y", "z"][axis]);
        let value = item.expression(scope, Entry::new(dimension, &what, Allowed::Everything));
        if dimension == Dimension::NONE && section.get("magnitude").is_none() {
            value.iter().for_each(|value| check_error_of_angle(value, section.document));
        }
        Some(value.map(|value| (component, value)))
    };
    let errors: Vec<Option<_>> = Component::ALL.into_iter().filter_map(read).collect();
    errors.into_iter().collect()
}

/// Name of `F_0` where a frame is named.
pub(super) const BASE: &str = "base";

/// Name of a frame and its location.
pub(super) type Named<'a> = (&'a str, Span);

/// Returns the index of the frame that frame `own` hangs on by its `parent`; `None` for the base,
/// and after a mistake.
pub(super) fn read_parent(item: &Item<'_>, own: usize, frames: &[Named<'_>]) -> Option<usize> {
    let parent = frame_or_base(item, frames).flatten()?;
    if parent < own {
        return Some(parent);
    }
    let (name, declared) = &frames[parent];
    item.document.fail(if parent == own {
        Diagnostic::new(item.span(), format!("the frame \"{name}\" cannot hang on itself"))
            .label("its own name")
            .help("name an earlier frame, or \"base\" for F_0")
    } else {
        Diagnostic::new(item.span(), format!("the frame \"{name}\" is declared later"))
            .label("a frame hangs on an earlier one")
            .context(declared.clone(), "declared here")
            .help(format!("move the [[frame]] \"{name}\" before this one; close loops by a [[loop]]"))
    })
}

/// Returns the index of the frame with the name that an item holds; `Some(None)` for the base.
pub(super) fn frame_or_base(item: &Item<'_>, frames: &[Named<'_>]) -> Option<Option<usize>> {
    let name = item.string()?;
    let found = frames.iter().position(|(frame, _)| *frame == name);
    match found {
        Some(frame) if name == BASE => item.document.fail(
            Diagnostic::new(item.span(), "\"base\" is F_0, and also the name of a frame")
                .label("either of them")
                .context(frames[frame].1.clone(), "the frame")
                .help("rename the frame"),
        ),
        Some(_) => Some(found),
        None if name == BASE => Some(None),
        None => {
            let known: Vec<&str> = frames.iter().map(|(name, _)| *name).chain([BASE]).collect();
            find_name(item.document, item.span(), &name, &known, "frame")?;
            None
        }
    }
}
