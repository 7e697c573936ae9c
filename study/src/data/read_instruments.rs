//! Reads the instruments of a map: `[[instrument]]`, and `[[target]]` for where targets are on the tool.

use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostic;
use abbe_spec::document::{Document, Item, Section};
use abbe_spec::expr::Dimension;
use abbe_spec::keys::Keys;
use abbe_spec::value::find_name;

use super::column::Column;
use super::instrument::{Instrument, Instruments, Kind, Look, norm};
use super::read_values::{column, columns, constant, positive, unit};

const KINDS: [(&str, Kind); 9] = [
    ("point", Kind::Point),
    ("distance", Kind::Distance),
    ("contact", Kind::Contact),
    ("plane", Kind::Plane),
    ("sphere", Kind::Sphere),
    ("indicator", Kind::Indicator),
    ("between", Kind::Between),
    ("displacement", Kind::Displacement),
    ("angle", Kind::Angle),
];

/// A target that other tables name.
struct Named {
    name: String,
    position: [f64; 3],
}

/// `stated` is the uncertainty of `[data]`, for instruments that have none of their own.
pub(super) fn instruments(
    root: &Section<'_>,
    stated: Option<f64>,
    setup: Option<Column>,
    document: &mut Document,
    spec: &Spec,
) -> Option<Instruments> {
    let targets = match root.get("target") {
        Some(item) => targets(&item, document, spec)?,
        None => vec![Named { name: String::new(), position: [0.0; 3] }],
    };
    let items = root.get("instrument")?;
    let items = document.array(&items, "tables, each an [[instrument]]")?;
    let mut all = Instruments {
        targets: targets.iter().map(|t| t.position).collect(),
        setup,
        ..Instruments::default()
    };
    let mut complete = true;
    for item in &items {
        let mut section = document.section(item)?;
        section.span = item.span();
        section.name = "this [[instrument]]".to_owned();
        match instrument(&section, &targets, stated, &mut all, document, spec) {
            Some(one) if all.list.iter().any(|other| other.name == one.name) => {
                let message = format!("there are two instruments `{}`", one.name.escape_debug());
                let help = "give each a `name` of its own";
                document.mistake(Diagnostic::new(item.span(), message).help(help));
                return None;
            }
            Some(instrument) => all.list.push(instrument),
            None => complete = false,
        }
    }
    complete.then_some(all)
}

fn targets(item: &Item<'_>, document: &mut Document, spec: &Spec) -> Option<Vec<Named>> {
    let items = document.array(item, "tables, each a [[target]]")?;
    let one = |item: &Item<'_>, document: &mut Document| {
        let mut section = document.section(item)?;
        section.span = item.span();
        section.name = "this [[target]]".to_owned();
        section.check_keys(&[&Keys { tables: &["[[target]]"], keys: &["name", "position"] }], document);
        let name = section.required("name", document).and_then(|item| document.string(&item));
        let position = match section.get("position") {
            Some(item) if is_unknown(&item, document) => [0.0; 3],
            Some(item) => vector(&item, document, spec, Dimension::LENGTH)?,
            None => section.required("position", document).map(|_| [0.0; 3])?,
        };
        Some(Named { name: name?, position })
    };
    items.iter().map(|item| one(item, document)).collect()
}

fn instrument(
    section: &Section<'_>,
    targets: &[Named],
    stated: Option<f64>,
    all: &mut Instruments,
    document: &mut Document,
    spec: &Spec,
) -> Option<Instrument> {
    let kind = section.required("kind", document)?;
    let kind = document.choice(&kind, &KINDS)?;
    section.check_keys(&[&keys_of(kind)], document);
    let name = section.required("name", document).and_then(|item| document.string(&item));
    let angle = kind == Kind::Angle;
    let dimension = if angle { Dimension::NONE } else { Dimension::LENGTH };
    let columns = match kind.columns() {
        3 => columns::<3>(section, "columns", document).map(Vec::from),
        1 => section.required("column", document).and_then(|item| column(&item, document)).map(|c| vec![c]),
        _ => Some(Vec::new()),
    };
    let factor = if kind.is_touched() { Some(1.0) } else { unit(section, document, spec, dimension) };
    let uncertainty = match section.get("uncertainty") {
        Some(item) if is_unknown(&item, document) => Some(None),
        Some(item) => positive(&item, document, spec, dimension).map(Some),
        None if angle || stated.is_none() => section.required("uncertainty", document).map(|_| None),
        None => Some(stated),
    };
    // What stands for one that is unknown: 10 µm, or 10 µrad.
    let some = if angle { 1e-5 } else { 1e-5 / spec.length.in_metres() };
    let (zero, zero_known) = zero(section, kind, document, spec)?;
    let look = Look {
        targets: looked_at(section, kind, targets, document)?,
        at: optional(section, "at", needs_place(kind), document, spec, Dimension::LENGTH)?,
        direction: direction(
            section,
            "direction",
            matches!(kind, Kind::Plane | Kind::Indicator | Kind::Angle),
            document,
            spec,
        )?,
        mirror: unit_vector(direction(section, "mirror", angle, document, spec)?),
        zero,
        zero_known,
        uncertainty: uncertainty?.unwrap_or(some),
    };
    let setup = setup(section, all, document, spec)?;
    let unit = section.get("unit").and_then(|item| document.string(&item));
    let range = match section.get("range") {
        Some(item) => {
            let ends: [Item<'_>; 2] = document.entries(&item, "the least and the largest reading")?;
            let [lower, upper] = ends.map(|end| constant(&end, document, spec, dimension));
            let (lower, upper) = (lower?, upper?);
            if lower >= upper {
                let mistake = Diagnostic::new(item.span(), "`range` ends before it begins");
                document.mistake(mistake.help("write the least reading first"));
                return None;
            }
            Some([lower, upper])
        }
        None => None,
    };
    let name = name?;
    let readings = all.add(&name, kind, &look);
    Some(Instrument {
        name,
        kind,
        columns: columns?,
        factor: factor?,
        unit: unit.unwrap_or_else(|| spec.length.symbol().to_owned()),
        setup,
        range,
        uncertainty: uncertainty?,
        at: section.get("at").is_some().then_some(look.at),
        readings,
    })
}

/// The keys that an instrument of a kind has.
fn keys_of(kind: Kind) -> Keys {
    let keys: &'static [&'static str] = match kind {
        Kind::Point => &["name", "kind", "columns", "unit", "target", "setup", "uncertainty"],
        Kind::Distance => {
            &["name", "kind", "column", "unit", "target", "at", "zero", "range", "setup", "uncertainty"]
        }
        Kind::Contact => &["name", "kind", "target", "at", "setup", "uncertainty"],
        Kind::Plane => &["name", "kind", "target", "at", "direction", "setup", "uncertainty"],
        Kind::Sphere => &["name", "kind", "target", "at", "radius", "nominal_radius", "setup", "uncertainty"],
        Kind::Indicator => {
            &["name", "kind", "column", "unit", "target", "at", "direction", "range", "setup", "uncertainty"]
        }
        Kind::Between => &["name", "kind", "column", "unit", "targets", "zero", "setup", "uncertainty"],
        Kind::Displacement => &["name", "kind", "column", "unit", "target", "setup", "uncertainty"],
        Kind::Angle => &["name", "kind", "column", "unit", "direction", "mirror", "setup", "uncertainty"],
    };
    Keys { tables: &["[[instrument]]"], keys }
}

fn needs_place(kind: Kind) -> bool {
    !matches!(kind, Kind::Point | Kind::Between | Kind::Displacement | Kind::Angle)
}

/// Whether the data are to tell a number.
fn is_unknown(item: &Item<'_>, document: &mut Document) -> bool {
    item.is_text() && document.string(item).as_deref() == Some("unknown")
}

/// The targets that an instrument looks at, by index: the first if it names none.
fn looked_at(
    section: &Section<'_>,
    kind: Kind,
    targets: &[Named],
    document: &mut Document,
) -> Option<Vec<usize>> {
    let names: Vec<&str> = targets.iter().map(|target| target.name.as_str()).collect();
    let find = |item: &Item<'_>, document: &mut Document| {
        let name = document.string(item)?;
        find_name(document, item.span(), &name, &names, "target")
    };
    if kind == Kind::Between {
        let item = section.required("targets", document)?;
        let both: [Item<'_>; 2] = document.entries(&item, "two names of targets")?;
        let [first, second] = both.map(|item| find(&item, document));
        return Some(vec![first?, second?]);
    }
    match section.get("target") {
        Some(item) => find(&item, document).map(|target| vec![target]),
        None => Some(vec![0]),
    }
}

fn setup(
    section: &Section<'_>,
    all: &Instruments,
    document: &mut Document,
    spec: &Spec,
) -> Option<Option<f64>> {
    let Some(item) = section.get("setup") else { return Some(None) };
    if all.setup.is_none() {
        let mistake = Diagnostic::new(item.span(), "the map does not say which column has the setup");
        document.mistake(mistake.help("name it: `setup = \"COLUMN\"` in [data]"));
        return None;
    }
    constant(&item, document, spec, Dimension::NONE).map(Some)
}

/// What the instrument adds to a distance, and whether that is known: its zero, of a sphere minus the radius.
fn zero(section: &Section<'_>, kind: Kind, document: &mut Document, spec: &Spec) -> Option<(f64, bool)> {
    let (key, sign) = match kind {
        Kind::Sphere => ("radius", -1.0),
        _ => ("zero", 1.0),
    };
    let item = match kind {
        Kind::Sphere => Some(section.required(key, document)?),
        _ => section.get(key),
    };
    let nominal = section.get("nominal_radius");
    match (item, nominal) {
        (None, _) => Some((0.0, true)),
        (Some(item), nominal) if is_unknown(&item, document) => {
            let about = nominal.map(|item| constant(&item, document, spec, Dimension::LENGTH));
            Some((about.map_or(Some(0.0), |about| about.map(|about| sign * about))?, false))
        }
        (Some(_), Some(nominal)) => {
            let message =
                "`nominal_radius` is about how large a radius is that is unknown; this one is known";
            let help = "leave it out, or write `radius = \"unknown\"`";
            document.mistake(Diagnostic::new(nominal.key_span.clone(), message).help(help));
            None
        }
        (Some(item), None) => {
            constant(&item, document, spec, Dimension::LENGTH).map(|value| (sign * value, true))
        }
    }
}

fn optional(
    section: &Section<'_>,
    key: &str,
    needed: bool,
    document: &mut Document,
    spec: &Spec,
    dimension: Dimension,
) -> Option<[f64; 3]> {
    match section.get(key) {
        Some(item) => vector(&item, document, spec, dimension),
        None if needed => section.required(key, document).map(|_| [0.0; 3]),
        None => Some([0.0; 3]),
    }
}

fn vector(item: &Item<'_>, document: &mut Document, spec: &Spec, dimension: Dimension) -> Option<[f64; 3]> {
    let what =
        if dimension == Dimension::LENGTH { "three lengths: x, y, z" } else { "three numbers: x, y, z" };
    let three: [Item<'_>; 3] = document.entries(item, what)?;
    let [x, y, z] = three.map(|item| constant(&item, document, spec, dimension));
    Some([x?, y?, z?])
}

fn direction(
    section: &Section<'_>,
    key: &str,
    needed: bool,
    document: &mut Document,
    spec: &Spec,
) -> Option<[f64; 3]> {
    let along = optional(section, key, needed, document, spec, Dimension::NONE)?;
    match section.get(key) {
        Some(item) if norm(along) == 0.0 => {
            let mistake = Diagnostic::new(item.span(), format!("`{key}` has no direction"));
            document.mistake(mistake.help("write where it points: [0, 0, 1] is z"));
            None
        }
        _ => Some(along),
    }
}

fn unit_vector(v: [f64; 3]) -> [f64; 3] {
    let length = norm(v);
    if length > 0.0 { v.map(|x| x / length) } else { v }
}
