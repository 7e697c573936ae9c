//! Reader of `[[instrument]]`, and of `[[target]]` beside it.
//!
//! The keys of an instrument are those of its [kind](InstrumentKind); each key has one reader here.

use abbe::analysis::sampling::vectors::{norm, unit as unit_vector};
use abbe::identify::{CAMERA, Fixture, FixtureGeometry, INSTRUMENTS, InstrumentKind, Observable};
use abbe_spec::document::{Item, Section};
use abbe_spec::expr::Dimension;
use abbe_spec::value::read_name;

use super::read_camera::camera;
use super::read_channels::{column, columns, deviation, initial_deviation, is_unknown, unit};
use super::{Column, Instrument, Instruments, TargetFrame, keys};

/// A target with a name.
struct Named {
    name: String,
    position: Option<[f64; 3]>,
}

/// Reads all instruments; `stated` is the uncertainty of `[data]`, the default for lengths, and has
/// none if that is to be estimated.
pub(super) fn instruments(
    root: &Section<'_>,
    stated: Option<Option<f64>>,
    setup: Option<Column>,
    frame: &TargetFrame,
) -> Option<Instruments> {
    let targets = root
        .get("target")
        .map_or(Some(vec![Named { name: String::new(), position: Some([0.0; 3]) }]), |item| {
            targets(&item, frame)
        })?;
    let items = root.get("instrument")?.array("an array of tables [[instrument]]")?;
    let mut all = Instruments {
        targets: targets.iter().map(|t| t.position).collect(),
        setup,
        ..Instruments::default()
    };
    let mut complete = true;
    for item in &items {
        let section = item.named("this [[instrument]]")?;
        match instrument(&section, &targets, stated, &mut all) {
            Some(one) if all.list.iter().any(|other| other.name == one.name) => {
                let message = format!("duplicate instrument `{}`", one.name.escape_debug());
                return item.refuse(message, "give each its own `name`");
            }
            Some(instrument) => all.list.push(instrument),
            None => complete = false,
        }
    }
    complete.then_some(all)
}

fn targets(item: &Item<'_>, frame: &TargetFrame) -> Option<Vec<Named>> {
    let items = item.array("an array of tables [[target]]")?;
    let one = |item: &Item<'_>| {
        let section = item.named("this [[target]]")?;
        section.check_names(&["name", "position"]);
        let name = section.required("name").and_then(|item| item.string());
        let position = target_position(&section.required("position")?, frame)?;
        Some(Named { name: name?, position })
    };
    items.iter().map(one).collect()
}

fn instrument(
    section: &Section<'_>,
    targets: &[Named],
    stated: Option<Option<f64>>,
    all: &mut Instruments,
) -> Option<Instrument> {
    let kind = section.required("kind")?;
    let kind = kind.choice(&INSTRUMENTS.map(|kind| (kind.name, kind)))?;
    let known = keys::ANY_INSTRUMENT.names().chain(kind.keys.iter().copied());
    let known: Vec<&str> = known.chain(keys::EVERY_INSTRUMENT.names()).collect();
    section.check_names(&known);
    let name = section.required("name").and_then(|item| item.string());
    if kind.name == CAMERA.name {
        return camera(section, name?, setup(section, all)?, all);
    }
    if all.camera.is_some() {
        let help = "describe the other instruments in a map of their own";
        return section.refuse("a camera must be the only instrument of its map", help);
    }
    let dimension = if kind.is_angle { Dimension::NONE } else { Dimension::LENGTH };
    let columns = match kind.has("columns") {
        true => columns::<3>(section, "columns").map(Vec::from),
        false if kind.is_touched() => Some(Vec::new()),
        false => section.required("column").and_then(|item| column(&item)).map(|c| vec![c]),
    };
    let factor = if kind.is_touched() { Some(1.0) } else { unit(section, dimension) };
    let uncertainty = match section.get("uncertainty") {
        Some(item) => deviation(&item, dimension),
        None if kind.is_angle || stated.is_none() => section.required("uncertainty").map(|_| None),
        None => stated,
    };
    let (zero, zero_known) = zero(section, kind)?;
    let targets = targets_of(section, kind, targets)?;
    if kind.finds_position && section.get("at").is_none() {
        all.unplaced.push(all.list.len());
    }
    let at = match all.unplaced.contains(&all.list.len()) {
        true => [0.0; 3],
        false => own_vector(section, kind, "at", Dimension::LENGTH)?,
    };
    let direction = own_direction(section, kind, "direction")?;
    let mirror = unit_vector(own_direction(section, kind, "mirror")?);
    let observable = Observable {
        name: name.clone().unwrap_or_default(),
        kind,
        instrument: all.list.len(),
        axis: 0,
        targets,
        fixture: None,
        at,
        mirror,
        corner: [0.0; 3],
        zero,
        zero_known,
        uncertainty: uncertainty?
            .unwrap_or_else(|| initial_deviation(kind.is_angle, section.document.length)),
    };
    let setup = setup(section, all)?;
    let unit = section.get("unit").and_then(|item| item.string());
    let range = match section.get("range") {
        Some(item) => {
            let [lower, upper] = item.quantities("the smallest and the largest reading", dimension)?;
            if lower >= upper {
                return item.refuse("the ends of `range` are reversed", "write the smallest reading first");
            }
            Some([lower, upper])
        }
        None => None,
    };
    let name = name?;
    let geometry = match kind.has("direction") {
        true => Some(FixtureGeometry::Direction(direction)),
        false => kind.has("at").then_some(FixtureGeometry::Point(at)),
    };
    let fixture = geometry.map(|geometry| {
        all.fixtures.push(Fixture { name: name.clone(), geometry });
        all.fixtures.len() - 1
    });
    let first = all.observables.len();
    let observable = Observable { fixture, ..observable };
    all.observables.extend((0..kind.numbers).map(|axis| Observable { axis, ..observable.clone() }));
    Some(Instrument {
        name,
        kind,
        columns: columns?,
        factor: factor?,
        unit: unit.unwrap_or_else(|| section.document.length.symbol().to_owned()),
        setup,
        range,
        uncertainty: uncertainty?,
        observables: first..all.observables.len(),
    })
}

/// Reads the indices of the targets of an instrument; the first target if it names none.
fn targets_of(section: &Section<'_>, kind: &InstrumentKind, targets: &[Named]) -> Option<[usize; 2]> {
    let find = |item: &Item<'_>| read_name(item, targets.iter().map(|target| target.name.as_str()), "target");
    if kind.has("targets") {
        let item = section.required("targets")?;
        let [first, second] = item.entries("the names of two targets")?.map(|item| find(&item));
        return Some([first?, second?]);
    }
    match section.get("target") {
        Some(item) => find(&item).map(|target| [target; 2]),
        None => Some([0; 2]),
    }
}

fn setup(section: &Section<'_>, all: &Instruments) -> Option<Option<f64>> {
    let Some(item) = section.get("setup") else { return Some(None) };
    if all.setup.is_none() {
        let help = "name it: `setup = \"COLUMN\"` in [data]";
        return item.refuse("the map does not name the column of the setup", help);
    }
    item.quantity(Dimension::NONE).map(Some)
}

/// Reads the zero of an instrument, and whether it is known: `zero`, or minus `radius`.
fn zero(section: &Section<'_>, kind: &InstrumentKind) -> Option<(f64, bool)> {
    let (item, sign) = match kind.has("radius") {
        true => (Some(section.required("radius")?), -1.0),
        false => (section.get("zero"), 1.0),
    };
    let nominal = section.get("nominal_radius");
    match (item, nominal) {
        (None, _) => Some((0.0, !kind.has_unknown_zero)),
        (Some(item), nominal) if is_unknown(&item) => {
            let about = nominal.map(|item| item.quantity(Dimension::LENGTH));
            Some((about.map_or(Some(0.0), |about| about.map(|about| sign * about))?, false))
        }
        (Some(_), Some(nominal)) => {
            let message = "`nominal_radius` is the approximate value of an unknown radius, but this radius \
                 is known";
            nominal.refuse_key(message, "remove it, or write `radius = \"unknown\"`")
        }
        (Some(item), None) => item.quantity(Dimension::LENGTH).map(|value| (sign * value, true)),
    }
}

/// Reads a vector; zero if instruments of this kind have no such key.
fn own_vector(
    section: &Section<'_>,
    kind: &InstrumentKind,
    key: &str,
    dimension: Dimension,
) -> Option<[f64; 3]> {
    if !kind.has(key) {
        return Some([0.0; 3]);
    }
    vector(&section.required(key)?, dimension)
}

/// Reads the position of a target in the frame of the tool; none if it is unknown.
pub(super) fn target_position(item: &Item<'_>, frame: &TargetFrame) -> Option<Option<[f64; 3]>> {
    if is_unknown(item) {
        return Some(None);
    }
    let position = item.quantities("three lengths in the frame of the tool", Dimension::LENGTH)?;
    Some(Some(frame.to_tool(position)))
}

fn vector(item: &Item<'_>, dimension: Dimension) -> Option<[f64; 3]> {
    let what =
        if dimension == Dimension::LENGTH { "three lengths: x, y, z" } else { "three numbers: x, y, z" };
    item.quantities(what, dimension)
}

/// Reads a direction, which must not be zero; zero if instruments of this kind have no such key.
fn own_direction(section: &Section<'_>, kind: &InstrumentKind, key: &str) -> Option<[f64; 3]> {
    let along = own_vector(section, kind, key, Dimension::NONE)?;
    match section.get(key) {
        Some(item) if kind.has(key) && norm(along) == 0.0 => item.refuse(
            format!("the direction `{key}` must not be zero"),
            "write a vector such as [0, 0, 1] for z",
        ),
        _ => Some(along),
    }
}
