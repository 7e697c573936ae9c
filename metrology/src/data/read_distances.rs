//! Reader of `[[distance]]`: known distances between the fixtures of instruments.

use abbe::identify::{FixtureGeometry, KnownDistance};
use abbe_spec::document::{Item, Section};
use abbe_spec::expr::Dimension;
use abbe_spec::value::read_name;

use super::instrument::Instruments;
use super::keys;
use super::map::Layout;
use super::read_values::positive;

/// Reads all known distances into the instruments.
pub(super) fn distances(root: &Section<'_>, layout: Option<Layout>) -> Option<Layout> {
    let Some(list) = root.get("distance") else { return layout };
    let Layout::Instruments(mut all) = layout? else {
        let message = "`[[distance]]` is between fixtures of instruments, and this map has no [[instrument]]";
        return list.refuse_key(message, "remove it");
    };
    for item in list.array("an array of tables [[distance]]")? {
        let section = item.table("this [[distance]]", &[&keys::DISTANCE])?;
        let known = distance(&section, &all)?;
        let [a, b] = known.fixtures;
        if all.known_distances.iter().any(|other| other.fixtures == [a, b] || other.fixtures == [b, a]) {
            let message = "another [[distance]] is between the same two instruments";
            return item.refuse(message, "give each pair one distance");
        }
        all.known_distances.push(known);
    }
    Some(Layout::Instruments(all))
}

fn distance(section: &Section<'_>, all: &Instruments) -> Option<KnownDistance> {
    let between = section.required("between");
    let value = section.required("value");
    let uncertainty = section.required("uncertainty");
    let between = between?;
    let both: [Item<'_>; 2] = between.entries("the names of two instruments")?;
    let [a, b] = both.map(|item| point(&item, all));
    let (a, b) = (a?, b?);
    if a == b {
        let message = "a distance is between two instruments, and these are one";
        return between.refuse(message, "name another one");
    }
    let value = value?;
    let length = value.quantity(Dimension::LENGTH)?;
    if length <= 0.0 {
        let help = "write a length such as `500 mm`";
        return value.refuse("a distance must be positive", help);
    }
    let uncertainty = positive(&uncertainty?, Dimension::LENGTH)?;
    Some(KnownDistance { fixtures: [a, b], length, uncertainty })
}

/// Reads the name of an instrument that observes a point; returns the index of its fixture.
fn point(item: &Item<'_>, all: &Instruments) -> Option<usize> {
    let names = all.list.iter().map(|instrument| instrument.name.as_str());
    let instrument = read_name(item, names, "instrument")?;
    let fixture = all.fixture_of(instrument);
    match fixture.map(|fixture| all.fixtures[fixture].geometry) {
        Some(FixtureGeometry::Point(_)) => fixture,
        _ => {
            let message =
                format!("the instrument `{}` observes no point", all.list[instrument].name.escape_debug());
            let help =
                "a distance is between the points of instruments such as `contact`, `distance` and `sphere`";
            item.refuse(message, help)
        }
    }
}
