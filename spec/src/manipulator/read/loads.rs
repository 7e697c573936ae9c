//! `[[load]]` and `gravity`: loads on beams and compliances.

use super::{LOAD_AXES, TOOL, find_frame, keys};
use crate::diagnostic::Diagnostic;
use crate::document::{Item, Section};
use crate::expr::{Allowed, Dimension, Entry, Expression, Scope};
use crate::manipulator::{Axes, Cause, ChainNumber, Effect, Load, Point, Source, Tree, Variable};

/// Reads all loads of a spec.
pub(super) fn read_loads(root: &Section<'_>, tree: Tree<'_>, scope: &Scope) -> Vec<Load> {
    let items = root.get("load").and_then(|item| item.array_of_tables("load"));
    let mut loads = Vec::new();
    for item in items.unwrap_or_default() {
        if let Some(section) = item.table("this [[load]]", &[&keys::LOAD]) {
            for text in ["name", "description", "reference"] {
                section.optional_text(text);
            }
            loads.extend(read_load(&section, tree, scope));
        }
    }
    loads
}

fn read_load(section: &Section<'_>, tree: Tree<'_>, scope: &Scope) -> Option<Load> {
    let acts = ["mass", "force", "moment"].map(|key| section.get(key));
    if acts.iter().all(Option::is_none) {
        section.document.mistake(
            Diagnostic::new(section.span.clone(), "this [[load]] is empty")
                .label("no `mass`, `force` or `moment` here")
                .help("add a `mass`, whose weight acts under gravity, or a `force` or `moment` of three components"),
        );
    }
    let [mass, force, moment] = acts;
    if let (None, None, Some(axes)) = (&force, &moment, section.get("axes")) {
        let help = "remove `axes`: the weight of a mass acts along `gravity`";
        let mistake = Diagnostic::new(axes.key_span, "`axes` without `force` or `moment`");
        section.document.mistake(mistake.label("the axes of `force` and `moment`").help(help));
    }
    let mass = optional(mass, |item| {
        let what = "the mass of a load";
        item.expression(scope, Entry { dimension: Some(Dimension::MASS), what, names: Allowed::Everything })
    });
    let force =
        optional(force, |item| vector(item, Dimension::FORCE, "a component of a load's force", scope));
    let moment =
        optional(moment, |item| vector(item, Dimension::MOMENT, "a component of a load's moment", scope));
    let axes = section.get("axes").map_or(Some(Axes::Frame), |item| item.choice(&LOAD_AXES));
    let frame = section.required("frame").and_then(|item| find_frame(&item, tree.frames));
    let point = match section.get("point") {
        Some(item) if item.is_text() => read_tool_point(&item, frame, tree),
        Some(item) => vector(&item, Dimension::LENGTH, "a coordinate of a load", scope).map(Point::Here),
        None => {
            let zero = || Expression::number(0.0, Dimension::LENGTH, section.span.clone());
            Some(Point::Here([zero(), zero(), zero()]))
        }
    };
    Some(Load { mass: mass?, force: force?, moment: moment?, axes: axes?, frame: frame?, point: point? })
}

/// Reads an item if there is one.
fn optional<'d, T>(item: Option<Item<'d>>, read: impl FnOnce(&Item<'d>) -> Option<T>) -> Option<Option<T>> {
    item.map_or(Some(None), |item| read(&item).map(Some))
}

/// Reads `point = "tool"`, for a load on the frame that carries the tool.
fn read_tool_point(item: &Item<'_>, frame: Option<usize>, tree: Tree<'_>) -> Option<Point> {
    item.choice(&TOOL)?;
    if let Some(carrier) = tree.frames.get(tree.tool_frame)
        && frame.is_some_and(|frame| frame != tree.tool_frame)
    {
        let name = &carrier.name;
        let help = format!("write frame = \"{name}\", or the three coordinates of the point");
        let mistake = Diagnostic::new(item.span(), "the tool point is not fixed to this frame");
        return item.document.fail(mistake.label(format!("it is fixed to \"{name}\"")).help(help));
    }
    Some(Point::Tool)
}

/// Reads `gravity`, in `[manipulator]` or at the top of the file.
pub(super) fn read_gravity(root: &Section<'_>, scope: &Scope) -> Option<Option<[Expression; 3]>> {
    let item = root.get("gravity").or_else(|| root.get("manipulator")?.key_of_table("gravity"));
    optional(item, |item| vector(item, Dimension::ACCELERATION, "a component of gravity", scope))
}

fn vector(item: &Item<'_>, dimension: Dimension, what: &str, scope: &Scope) -> Option<[Expression; 3]> {
    let entries: [Item<'_>; 3] = item.entries("three numbers")?;
    let entry = Entry { dimension: Some(dimension), what, names: Allowed::Everything };
    let [x, y, z] = entries.map(|item| item.expression(scope, entry));
    Some([x?, y?, z?])
}

/// Checks that elastic elements have loads and masses have gravity.
pub(super) fn check_loaded(
    root: &Section<'_>,
    tree: Tree<'_>,
    sources: &[Source],
    loads: &[Load],
    joints: &[Variable],
    gravity: bool,
) {
    let effects = || sources.iter().flat_map(|source| &source.effects);
    let weight = |effect: &Effect| match &effect.cause {
        Cause::Beam(beam) => beam.mass_per_length.clone(),
        _ => None,
    };
    for source in sources {
        let elements = source.effects.iter().filter(|effect| effect.cause.is_elastic());
        let elements = elements.map(|effect| (effect.frame, &effect.span));
        let elastic = source.deviations.iter().filter(|deviation| deviation.is_elastic());
        let elastic = elastic.filter_map(|deviation| match deviation.number {
            ChainNumber::Joint(joint) => Some((joints.get(joint)?.frame, &deviation.span)),
            _ => None,
        });
        for (frame, span) in elements.chain(elastic) {
            let load = loads.iter().any(|load| tree.is_loaded(frame, load.frame));
            if !load && !effects().any(|other| tree.is_loaded(frame, other.frame) && weight(other).is_some())
            {
                let carried = if tree.is_serial() { "a later one" } else { "one that hangs on it" };
                root.document.mistake(
                    Diagnostic::new(span.clone(), format!("no load acts on the source \"{}\"", source.name))
                        .label("without a load it causes no error")
                        .help(format!(
                            "add a [[load]] at its frame or {carried}, or `mass_per_length` to a beam"
                        )),
                );
            }
        }
    }
    if gravity {
        return;
    }
    if let Some(item) = root.get("load").filter(|_| loads.iter().any(|load| load.mass.is_some())) {
        let help = "add `gravity = [0, 0, \"-9.80665 m/s^2\"]` to [manipulator], in the axes of F_0";
        let mistake = Diagnostic::new(item.key_span, "masses have no weight without `gravity`");
        root.document.mistake(mistake.label("a load with a mass").help(help));
    } else if let Some(mass) = effects().find_map(weight) {
        let message = "`mass_per_length` has no effect without `gravity`";
        let help = "add `gravity = [0, 0, \"-9.80665 m/s^2\"]` to [manipulator], in the axes of F_0";
        root.document.mistake(Diagnostic::new(mass.span(), message).label("it weighs nothing").help(help));
    }
}
