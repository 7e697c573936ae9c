//! Readers of `[[station]]`, `[placement]`, `[[place]]` and `[sight]`.
//!
//! Reader of `[[distance]]`: known distances between the fixtures of instruments.

use std::f64::consts::FRAC_PI_2;

use abbe::Pose;
use abbe::analysis::sampling::norm;
use abbe::analysis::sampling::vectors::dot;
use abbe::identify::{FixtureGeometry, INTRINSICS, KnownDistance};
use abbe_spec::document::{Item, Section};
use abbe_spec::expr::Dimension;
use abbe_spec::value::read_name;

use super::choices::{PLACEMENTS, Placed};
use super::read_channels::{column, positive};
use super::sight::{Cone, Sight};
use super::{
    Instruments, Layout, Placement, StatedPlacement, StatedStation, Stations, TargetFrame, keys, rotation,
};

/// Reads the column of stations in `[data]`, and the `[[station]]` tables.
pub(super) fn stations(root: &Section<'_>, head: &Section<'_>) -> Option<Stations> {
    let column = head.get("station").map_or(Some(None), |item| column(&item).map(Some))?;
    let mut stated: Vec<StatedStation> = Vec::new();
    let Some(list) = root.get("station") else { return Some(Stations { column, stated }) };
    for item in list.array("an array of tables [[station]]")? {
        let section = item.table("this [[station]]", &[&keys::STATION])?;
        let name = section.optional_text("name");
        let pose = place(&section)?;
        covariance(&section, 6)?;
        if stated.iter().any(|station| station.name == name) {
            let help = "give each its own `name`";
            return item.refuse(format!("duplicate station `{}`", name.escape_debug()), help);
        }
        stated.push(StatedStation { name, pose });
    }
    if column.is_none() && stated.len() > 1 {
        let help = "name the column of the station in [data]: `station = \"…\"`";
        return list.refuse_key("several stations, but no column with the station of each row", help);
    }
    Some(Stations { column, stated })
}

/// Reads `[placement]` or `[[placement]]`, and what `[data]` says of them.
pub(super) fn placement(
    root: &Section<'_>,
    head: &Section<'_>,
    frame: &TargetFrame,
    layout: Option<&Layout>,
) -> Option<Placement> {
    let placed = head.get("placement").map_or(Some(Placed::Near), |item| item.choice(&PLACEMENTS))?;
    let is_per_station = placed == Placed::PerStation;
    if let Some(item) = head.get("placement").filter(|_| is_per_station) {
        let (message, help) = match (layout, head.get("station")) {
            (Some(Layout::Instruments(_)), _) => (
                "instruments name their targets: `placement = \"per station\"` is not for them",
                "write a [[target]] for each place, and an [[instrument]] for each with its `target` and `setup`",
            ),
            (_, None) => (
                "a placement per station, but no column with the station of each row",
                "name it in [data]: `station = \"…\"`",
            ),
            _ => ("", ""),
        };
        if !message.is_empty() {
            return item.refuse(message, help);
        }
    }
    let is_exact = placed == Placed::Exactly && root.get("placement").is_none();
    if let Some(item) = head.get("placement").filter(|_| is_exact && layout.is_some_and(has_unknown_target)) {
        let message = "the placement is exact, but the position of a target is unknown";
        return item.refuse(message, "state its position, or remove `placement`");
    }
    let mut all = Placement { exact: placed == Placed::Exactly, is_per_station, stated: Vec::new() };
    let Some(item) = root.get("placement") else { return Some(all) };
    if item.is_table() == is_per_station {
        let (message, help) = match is_per_station {
            true => (
                "`placement = \"per station\"` in [data], but one placement for all stations",
                "write a table [[placement]] for each station, with its name as `station`",
            ),
            false => (
                "several placements, but [data] does not say that each station has its own",
                "write `placement = \"per station\"` in [data], or one table [placement]",
            ),
        };
        return item.refuse_key(message, help);
    }
    if !is_per_station {
        let section = item.table("[placement]", &[&keys::PLACEMENT])?;
        all.stated.push(stated_placement(&section, frame, layout)?);
        return Some(all);
    }
    for item in item.array("an array of tables [[placement]]")? {
        let section = item.table("this [[placement]]", &[&keys::PLACEMENT, &keys::PLACEMENT_OF_STATION])?;
        let station = section.required("station")?.string()?;
        let stated = stated_placement(&section, frame, layout)?;
        if all.stated.iter().any(|other| other.station == station) {
            let message = format!("duplicate placement at the station `{}`", station.escape_debug());
            return item.refuse(message, "give each station one placement");
        }
        all.stated.push(StatedPlacement { station, ..stated });
    }
    Some(all)
}

fn has_unknown_target(layout: &Layout) -> bool {
    match layout {
        Layout::Targets(targets) => targets.iter().any(|target| target.position.is_none()),
        Layout::Instruments(all) => all.targets.contains(&None),
        _ => false,
    }
}

/// Reads the positions of the targets, or the pose of the measured frame.
fn stated_placement(
    section: &Section<'_>,
    frame: &TargetFrame,
    layout: Option<&Layout>,
) -> Option<StatedPlacement> {
    if layout.is_some_and(Layout::is_pose) {
        let mounting = Some(place(section)?);
        covariance(section, 6)?;
        return Some(StatedPlacement { mounting, ..StatedPlacement::default() });
    }
    let count = match layout {
        Some(Layout::Targets(targets)) => targets.len(),
        Some(Layout::Instruments(all)) => all.targets.len(),
        _ => 1,
    };
    let list = section.required("targets")?;
    let mut targets = Vec::new();
    for item in list.array("positions, each three lengths in the frame of the tool")? {
        let position = item.quantities("three lengths in the frame of the tool", Dimension::LENGTH)?;
        targets.push(frame.to_tool(position));
    }
    if targets.len() != count {
        let message = format!("the map has {count} targets, but positions of {}", targets.len());
        return list.refuse(message, "give one position for each target, in their order");
    }
    covariance(section, 3 * count)?;
    Some(StatedPlacement { targets: Some(targets), ..StatedPlacement::default() })
}

/// Reads `[sight]`; returns no sight without that table.
pub(super) fn sight(root: &Section<'_>) -> Option<Option<Sight>> {
    let Some(item) = root.get("sight") else { return Some(None) };
    let section = item.table("[sight]", &[&keys::SIGHT])?;
    let from = section.required("from");
    let from = from.and_then(|item| item.quantities("three lengths in F_0", Dimension::LENGTH));
    let cone = |axis: &str, angle: &str| -> Option<Option<Cone>> {
        let half = section.get(angle).map_or(Some(FRAC_PI_2), |item| item.quantity(Dimension::NONE));
        let Some(item) = section.get(axis) else { return half.map(|_| None) };
        let axis = item.quantities("three numbers, a direction", Dimension::NONE)?;
        if dot(axis, axis) == 0.0 {
            return item.refuse("a direction has a length", "write a vector such as `[0, 0, 1]`");
        }
        Some(Some((axis, half?.cos())))
    };
    let (instrument, targets) = (cone("looks", "field"), cone("faces", "within"));
    Some(Some(Sight { from: from?, instrument: instrument?, targets: targets? }))
}

/// Reads `[[place]]`: identified geometry and zero of the fixtures of instruments.
pub(super) fn found_places(root: &Section<'_>, layout: Option<Layout>) -> Option<Layout> {
    let Some(list) = root.get("place") else { return layout };
    let Layout::Instruments(mut all) = layout? else {
        let message = "`[[place]]` is for fixtures of instruments, and this map has no [[instrument]]";
        return list.refuse_key(message, "remove it");
    };
    for item in list.array("an array of tables [[place]]")? {
        let section = item.table("this [[place]]", &[&keys::PLACE])?;
        let name = section.required("name")?;
        let names = all.list.iter().map(|instrument| instrument.name.as_str());
        let instrument = read_name(&name, names, "instrument")?;
        let (fixture, first) = (all.fixture_of(instrument), all.list[instrument].observables.start);
        let (kind, zero_known) = (all.observables[first].kind, all.observables[first].zero_known);
        if let Some(fixture) = fixture {
            let (key, dimension) = match all.fixtures[fixture].geometry {
                FixtureGeometry::Point(_) => ("position", Dimension::LENGTH),
                FixtureGeometry::Direction(_) => ("direction", Dimension::NONE),
            };
            let three = section.required(key)?;
            let found = three.quantities("three numbers: x, y, z", dimension)?;
            all.fixtures[fixture].geometry = match all.fixtures[fixture].geometry {
                FixtureGeometry::Point(_) => FixtureGeometry::Point(found),
                FixtureGeometry::Direction(_) if norm(found) > 0.0 => FixtureGeometry::Direction(found),
                FixtureGeometry::Direction(_) => {
                    let help = "write a vector such as [0, 0, 1] for z";
                    return item.refuse("`direction` must not be zero", help);
                }
            };
        }
        if !zero_known {
            let zero = section.required("zero")?;
            let dimension = if kind.is_angle { Dimension::NONE } else { Dimension::LENGTH };
            all.observables[first].zero = zero.quantity(dimension)?;
        }
        if let Some(camera) = &mut all.camera {
            let item = section.required("intrinsics")?;
            let what = "nine numbers: fx fy cx cy k1 k2 p1 p2 k3";
            camera.intrinsics = item.quantities(what, Dimension::NONE)?;
            covariance(&section, INTRINSICS)?;
            all.found.push(instrument);
            continue;
        }
        let place = fixture.map_or(0, |fixture| all.fixtures[fixture].geometry.unknowns());
        covariance(&section, place + usize::from(!zero_known))?;
        all.found.push(instrument);
    }
    Some(Layout::Instruments(all))
}

/// Reads a position and a quaternion w x y z.
fn place(section: &Section<'_>) -> Option<Pose> {
    let position = section.required("position")?.quantities("three lengths", Dimension::LENGTH);
    let item = section.required("quaternion")?;
    let numbers: [f64; 4] = item.quantities("four numbers: w x y z", Dimension::NONE)?;
    match rotation::from_quaternion(&numbers) {
        Ok([a, b, c]) => Some(Pose([a, b, c, position?])),
        Err(reason) => item.refuse(reason, "write `[1, 0, 0, 0]` for no rotation"),
    }
}

/// Checks the size of a covariance, which is not used otherwise.
fn covariance(section: &Section<'_>, size: usize) -> Option<()> {
    let Some(item) = section.get("covariance") else { return Some(()) };
    let rows = item.array("rows of numbers")?;
    let lengths = rows.iter().map(|row| Some(row.array("numbers")?.len())).collect::<Option<Vec<_>>>()?;
    if lengths == vec![size; size] {
        return Some(());
    }
    let message = format!("this covariance must have {size} rows of {size} numbers");
    item.refuse(message, "or remove it: no result depends on it")
}

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
    let [a, b] = between.entries("the names of two instruments")?.map(|item| point(&item, all));
    let (a, b) = (a?, b?);
    if a == b {
        let message = "a distance is between two instruments, and these are one";
        return between.refuse(message, "name another one");
    }
    let value = value?;
    let length = value.quantity(Dimension::LENGTH)?;
    if length <= 0.0 {
        return value.refuse("a distance must be positive", "write a length such as `500 mm`");
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
