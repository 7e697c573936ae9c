//! Reader of `[[distance]]`: known distances between the fixtures of instruments.

use abbe::identify::{FixtureGeometry, KnownDistance};
use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostic;
use abbe_spec::document::{Document, Item, Section};
use abbe_spec::expr::Dimension;
use abbe_spec::value::find_name;

use super::instrument::Instruments;
use super::keys;
use super::map::Layout;
use super::read_values::{constant, positive};

/// Reads all known distances into the instruments.
pub(super) fn distances(
    root: &Section<'_>,
    layout: Option<Layout>,
    document: &mut Document,
    spec: &Spec,
) -> Option<Layout> {
    let Some(list) = root.get("distance") else { return layout };
    let Layout::Instruments(mut all) = layout? else {
        let message = "`[[distance]]` is between fixtures of instruments, and this map has no [[instrument]]";
        document.mistake(Diagnostic::new(list.key_span.clone(), message).help("remove it"));
        return None;
    };
    for item in document.array(&list, "an array of tables [[distance]]")? {
        let mut section = document.section(&item)?;
        section.span = item.span();
        section.name = "this [[distance]]".to_owned();
        section.check_keys(&[&keys::DISTANCE], document);
        let known = distance(&section, &all, document, spec)?;
        let [a, b] = known.fixtures;
        if all.known_distances.iter().any(|other| other.fixtures == [a, b] || other.fixtures == [b, a]) {
            let message = "another [[distance]] is between the same two instruments";
            document.mistake(Diagnostic::new(item.span(), message).help("give each pair one distance"));
            return None;
        }
        all.known_distances.push(known);
    }
    Some(Layout::Instruments(all))
}

fn distance(
    section: &Section<'_>,
    all: &Instruments,
    document: &mut Document,
    spec: &Spec,
) -> Option<KnownDistance> {
    let between = section.required("between", document);
    let value = section.required("value", document);
    let uncertainty = section.required("uncertainty", document);
    let between = between?;
    let both: [Item<'_>; 2] = document.entries(&between, "the names of two instruments")?;
    let [a, b] = both.map(|item| point(&item, all, document));
    let (a, b) = (a?, b?);
    if a == b {
        let message = "a distance is between two instruments, and these are one";
        document.mistake(Diagnostic::new(between.span(), message).help("name another one"));
        return None;
    }
    let value = value?;
    let length = constant(&value, document, spec, Dimension::LENGTH)?;
    if length <= 0.0 {
        let mistake = Diagnostic::new(value.span(), "a distance must be positive");
        document.mistake(mistake.help("write a length such as `500 mm`"));
        return None;
    }
    let uncertainty = positive(&uncertainty?, document, spec, Dimension::LENGTH)?;
    Some(KnownDistance { fixtures: [a, b], length, uncertainty })
}

/// Reads the name of an instrument that observes a point; returns the index of its fixture.
fn point(item: &Item<'_>, all: &Instruments, document: &mut Document) -> Option<usize> {
    let names: Vec<&str> = all.list.iter().map(|instrument| instrument.name.as_str()).collect();
    let name = document.string(item)?;
    let instrument = find_name(document, item.span(), &name, &names, "instrument")?;
    let fixture = all.fixture_of(instrument);
    match fixture.map(|fixture| all.fixtures[fixture].geometry) {
        Some(FixtureGeometry::Point(_)) => fixture,
        _ => {
            let message = format!("the instrument `{}` observes no point", name.escape_debug());
            let help =
                "a distance is between the points of instruments such as `contact`, `distance` and `sphere`";
            document.mistake(Diagnostic::new(item.span(), message).help(help));
            None
        }
    }
}
