//! Reader of `[[instrument]]`, and of `[[target]]` beside it.
//!
//! The keys of an instrument are those of its [kind](InstrumentKind); each key has one reader here.

use abbe::analysis::sampling::norm;
use abbe::identify::{CAMERA, Fixture, FixtureGeometry, INSTRUMENTS, InstrumentKind, Observable};
use abbe_spec::document::{Document, Item, Section};
use abbe_spec::expr::Dimension;
use abbe_spec::value::read_name;

use super::column::Column;
use super::instrument::{Instrument, Instruments};
use super::keys;
use super::read_camera::camera;
use super::read_values::{column, columns, deviation, initial_deviation, is_unknown, unit};
use super::target_frame::TargetFrame;

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
    document: &mut Document,
) -> Option<Instruments> {
    let targets = root
        .get("target")
        .map_or(Some(vec![Named { name: String::new(), position: Some([0.0; 3]) }]), |item| {
            targets(&item, frame, document)
        })?;
    let items = root.get("instrument")?;
    let items = document.array(&items, "an array of tables [[instrument]]")?;
    let mut all = Instruments {
        targets: targets.iter().map(|t| t.position).collect(),
        setup,
        ..Instruments::default()
    };
    let mut complete = true;
    for item in &items {
        let mut section = document.section(item)?;
        section.name = "this [[instrument]]".to_owned();
        match instrument(&section, &targets, stated, &mut all, document) {
            Some(one) if all.list.iter().any(|other| other.name == one.name) => {
                let message = format!("duplicate instrument `{}`", one.name.escape_debug());
                return document.refuse(item.span(), message, "give each its own `name`");
            }
            Some(instrument) => all.list.push(instrument),
            None => complete = false,
        }
    }
    complete.then_some(all)
}

fn targets(item: &Item<'_>, frame: &TargetFrame, document: &mut Document) -> Option<Vec<Named>> {
    let items = document.array(item, "an array of tables [[target]]")?;
    let one = |item: &Item<'_>, document: &mut Document| {
        let mut section = document.section(item)?;
        section.name = "this [[target]]".to_owned();
        section.check_names(&["name", "position"], document);
        let name = section.required("name", document).and_then(|item| document.string(&item));
        let item = section.required("position", document)?;
        let position = target_position(&item, frame, document)?;
        Some(Named { name: name?, position })
    };
    items.iter().map(|item| one(item, document)).collect()
}

fn instrument(
    section: &Section<'_>,
    targets: &[Named],
    stated: Option<Option<f64>>,
    all: &mut Instruments,
    document: &mut Document,
) -> Option<Instrument> {
    let kind = section.required("kind", document)?;
    let kind = document.choice(&kind, &INSTRUMENTS.map(|kind| (kind.name, kind)))?;
    let known = keys::ANY_INSTRUMENT.names().chain(kind.keys.iter().copied());
    let known: Vec<&str> = known.chain(keys::EVERY_INSTRUMENT.names()).collect();
    section.check_names(&known, document);
    let name = section.required("name", document).and_then(|item| document.string(&item));
    if kind.name == CAMERA.name {
        let setup = setup(section, all, document)?;
        return camera(section, name?, setup, all, document);
    }
    if all.camera.is_some() {
        let help = "describe the other instruments in a map of their own";
        return document.refuse(
            section.span.clone(),
            "a camera must be the only instrument of its map",
            help,
        );
    }
    let dimension = if kind.is_angle { Dimension::NONE } else { Dimension::LENGTH };
    let columns = match kind.has("columns") {
        true => columns::<3>(section, "columns", document).map(Vec::from),
        false if kind.is_touched() => Some(Vec::new()),
        false => {
            section.required("column", document).and_then(|item| column(&item, document)).map(|c| vec![c])
        }
    };
    let factor = if kind.is_touched() { Some(1.0) } else { unit(section, document, dimension) };
    let uncertainty = match section.get("uncertainty") {
        Some(item) => deviation(&item, document, dimension),
        None if kind.is_angle || stated.is_none() => section.required("uncertainty", document).map(|_| None),
        None => stated,
    };
    let (zero, zero_known) = zero(section, kind, document)?;
    let targets = targets_of(section, kind, targets, document)?;
    if kind.finds_position && section.get("at").is_none() {
        all.unplaced.push(all.list.len());
    }
    let at = match all.unplaced.contains(&all.list.len()) {
        true => [0.0; 3],
        false => own_vector(section, kind, "at", document, Dimension::LENGTH)?,
    };
    let direction = own_direction(section, kind, "direction", document)?;
    let mirror = unit_vector(own_direction(section, kind, "mirror", document)?);
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
        uncertainty: uncertainty?.unwrap_or_else(|| initial_deviation(kind.is_angle, document.length)),
    };
    let setup = setup(section, all, document)?;
    let unit = section.get("unit").and_then(|item| document.string(&item));
    let range = match section.get("range") {
        Some(item) => {
            let [lower, upper] =
                document.quantities(&item, "the smallest and the largest reading", dimension)?;
            if lower >= upper {
                let help = "write the smallest reading first";
                return document.refuse(item.span(), "the ends of `range` are reversed", help);
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
        unit: unit.unwrap_or_else(|| document.length.symbol().to_owned()),
        setup,
        range,
        uncertainty: uncertainty?,
        observables: first..all.observables.len(),
    })
}

/// Reads the indices of the targets of an instrument; the first target if it names none.
fn targets_of(
    section: &Section<'_>,
    kind: &InstrumentKind,
    targets: &[Named],
    document: &mut Document,
) -> Option<[usize; 2]> {
    let find = |item: &Item<'_>, document: &mut Document| {
        read_name(document, item, targets.iter().map(|target| target.name.as_str()), "target")
    };
    if kind.has("targets") {
        let item = section.required("targets", document)?;
        let both: [Item<'_>; 2] = document.entries(&item, "the names of two targets")?;
        let [first, second] = both.map(|item| find(&item, document));
        return Some([first?, second?]);
    }
    match section.get("target") {
        Some(item) => find(&item, document).map(|target| [target; 2]),
        None => Some([0; 2]),
    }
}

fn setup(section: &Section<'_>, all: &Instruments, document: &mut Document) -> Option<Option<f64>> {
    let Some(item) = section.get("setup") else { return Some(None) };
    if all.setup.is_none() {
        let help = "name it: `setup = \"COLUMN\"` in [data]";
        return document.refuse(item.span(), "the map does not name the column of the setup", help);
    }
    document.quantity(&item, Dimension::NONE).map(Some)
}

/// Reads the zero of an instrument, and whether it is known: `zero`, or minus `radius`.
fn zero(section: &Section<'_>, kind: &InstrumentKind, document: &mut Document) -> Option<(f64, bool)> {
    let (item, sign) = match kind.has("radius") {
        true => (Some(section.required("radius", document)?), -1.0),
        false => (section.get("zero"), 1.0),
    };
    let nominal = section.get("nominal_radius");
    match (item, nominal) {
        (None, _) => Some((0.0, !kind.has_unknown_zero)),
        (Some(item), nominal) if is_unknown(&item, document) => {
            let about = nominal.map(|item| document.quantity(&item, Dimension::LENGTH));
            Some((about.map_or(Some(0.0), |about| about.map(|about| sign * about))?, false))
        }
        (Some(_), Some(nominal)) => {
            let message = "`nominal_radius` is the approximate value of an unknown radius, but this radius \
                 is known";
            document.refuse(nominal.key_span.clone(), message, "remove it, or write `radius = \"unknown\"`")
        }
        (Some(item), None) => document.quantity(&item, Dimension::LENGTH).map(|value| (sign * value, true)),
    }
}

/// Reads a vector; zero if instruments of this kind have no such key.
fn own_vector(
    section: &Section<'_>,
    kind: &InstrumentKind,
    key: &str,
    document: &mut Document,
    dimension: Dimension,
) -> Option<[f64; 3]> {
    if !kind.has(key) {
        return Some([0.0; 3]);
    }
    let item = section.required(key, document)?;
    vector(&item, document, dimension)
}

/// Reads the position of a target in the frame of the tool; none if it is unknown.
pub(super) fn target_position(
    item: &Item<'_>,
    frame: &TargetFrame,
    document: &mut Document,
) -> Option<Option<[f64; 3]>> {
    if is_unknown(item, document) {
        return Some(None);
    }
    let position = document.quantities(item, "three lengths in the frame of the tool", Dimension::LENGTH)?;
    Some(Some(frame.to_tool(position)))
}

fn vector(item: &Item<'_>, document: &mut Document, dimension: Dimension) -> Option<[f64; 3]> {
    let what =
        if dimension == Dimension::LENGTH { "three lengths: x, y, z" } else { "three numbers: x, y, z" };
    document.quantities(item, what, dimension)
}

/// Reads a direction, which must not be zero; zero if instruments of this kind have no such key.
fn own_direction(
    section: &Section<'_>,
    kind: &InstrumentKind,
    key: &str,
    document: &mut Document,
) -> Option<[f64; 3]> {
    let along = own_vector(section, kind, key, document, Dimension::NONE)?;
    match section.get(key) {
        Some(item) if kind.has(key) && norm(along) == 0.0 => document.refuse(
            item.span(),
            format!("the direction `{key}` must not be zero"),
            "write a vector such as [0, 0, 1] for z",
        ),
        _ => Some(along),
    }
}

fn unit_vector(v: [f64; 3]) -> [f64; 3] {
    let length = norm(v);
    if length > 0.0 { v.map(|x| x / length) } else { v }
}
