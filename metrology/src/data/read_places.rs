//! Readers of `[[station]]`, `[placement]` and `[[place]]`.

use abbe::Pose;
use abbe::identify::{FixtureGeometry, INTRINSICS};
use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostic;
use abbe_spec::document::{Document, Item, Section};
use abbe_spec::expr::Dimension;
use abbe_spec::value::find_name;

use super::choices::{PLACEMENTS, Placed};
use super::instrument::norm;
use super::keys;
use super::map::Layout;
use super::read_values::{column, constant};
use super::rotation;
use super::station::{Placement, StatedPlacement, StatedStation, Stations};
use super::target_frame::TargetFrame;

/// Reads the column of stations in `[data]`, and the `[[station]]` tables.
pub(super) fn stations(
    root: &Section<'_>,
    head: &Section<'_>,
    document: &mut Document,
    spec: &Spec,
) -> Option<Stations> {
    let column = match head.get("station") {
        Some(item) => Some(column(&item, document)?),
        None => None,
    };
    let mut stated: Vec<StatedStation> = Vec::new();
    let Some(list) = root.get("station") else { return Some(Stations { column, stated }) };
    for item in document.array(&list, "an array of tables [[station]]")? {
        let mut section = document.section(&item)?;
        section.span = item.span();
        section.name = "this [[station]]".to_owned();
        section.check_keys(&[&keys::STATION], document);
        let name = section.optional_text("name", document);
        let pose = place(&section, document, spec)?;
        covariance(&section, document, 6)?;
        if stated.iter().any(|station| station.name == name) {
            let message = format!("duplicate station `{}`", name.escape_debug());
            let help = "give each its own `name`";
            document.mistake(Diagnostic::new(item.span(), message).help(help));
            return None;
        }
        stated.push(StatedStation { name, pose });
    }
    if column.is_none() && stated.len() > 1 {
        let help = "name the column of the station in [data]: `station = \"…\"`";
        let message = "several stations, but no column with the station of each row";
        document.mistake(Diagnostic::new(list.key_span.clone(), message).help(help));
        return None;
    }
    Some(Stations { column, stated })
}

/// Reads `[placement]` or `[[placement]]`, and what `[data]` says of them.
pub(super) fn placement(
    root: &Section<'_>,
    head: &Section<'_>,
    frame: &TargetFrame,
    document: &mut Document,
    spec: &Spec,
    layout: Option<&Layout>,
) -> Option<Placement> {
    let placed = match head.get("placement") {
        Some(item) => document.choice(&item, &PLACEMENTS)?,
        None => Placed::Near,
    };
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
            document.mistake(Diagnostic::new(item.span(), message).help(help));
            return None;
        }
    }
    let is_exact = placed == Placed::Exactly && root.get("placement").is_none();
    if let Some(item) = head.get("placement").filter(|_| is_exact && layout.is_some_and(has_unknown_target)) {
        let message = "the placement is exact, but the position of a target is unknown";
        let help = "state its position, or remove `placement`";
        document.mistake(Diagnostic::new(item.span(), message).help(help));
        return None;
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
        document.mistake(Diagnostic::new(item.key_span.clone(), message).help(help));
        return None;
    }
    if !is_per_station {
        let mut section = document.section(&item)?;
        section.name = "[placement]".to_owned();
        section.check_keys(&[&keys::PLACEMENT], document);
        all.stated.push(stated_placement(&section, frame, document, spec, layout)?);
        return Some(all);
    }
    for item in document.array(&item, "an array of tables [[placement]]")? {
        let mut section = document.section(&item)?;
        section.span = item.span();
        section.name = "this [[placement]]".to_owned();
        section.check_keys(&[&keys::PLACEMENT, &keys::PLACEMENT_OF_STATION], document);
        let station = section.required("station", document)?;
        let station = document.string(&station)?;
        let stated = stated_placement(&section, frame, document, spec, layout)?;
        if all.stated.iter().any(|other| other.station == station) {
            let message = format!("duplicate placement at the station `{}`", station.escape_debug());
            let help = "give each station one placement";
            document.mistake(Diagnostic::new(item.span(), message).help(help));
            return None;
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
    document: &mut Document,
    spec: &Spec,
    layout: Option<&Layout>,
) -> Option<StatedPlacement> {
    if layout.is_some_and(Layout::is_pose) {
        let mounting = Some(place(section, document, spec)?);
        covariance(section, document, 6)?;
        return Some(StatedPlacement { mounting, ..StatedPlacement::default() });
    }
    let count = match layout {
        Some(Layout::Targets(targets)) => targets.len(),
        Some(Layout::Instruments(all)) => all.targets.len(),
        _ => 1,
    };
    let list = section.required("targets", document)?;
    let mut targets = Vec::new();
    for item in document.array(&list, "positions, each three lengths in the frame of the tool")? {
        let three: [Item<'_>; 3] = document.entries(&item, "three lengths in the frame of the tool")?;
        let [x, y, z] = three.map(|item| constant(&item, document, spec, Dimension::LENGTH));
        targets.push(frame.to_tool([x?, y?, z?]));
    }
    if targets.len() != count {
        let message = format!("the map has {count} targets, but positions of {}", targets.len());
        let help = "give one position for each target, in their order";
        document.mistake(Diagnostic::new(list.span(), message).help(help));
        return None;
    }
    covariance(section, document, 3 * count)?;
    Some(StatedPlacement { targets: Some(targets), ..StatedPlacement::default() })
}

/// Reads `[[place]]`: identified geometry and zero of the fixtures of instruments.
pub(super) fn found_places(
    root: &Section<'_>,
    layout: Option<Layout>,
    document: &mut Document,
    spec: &Spec,
) -> Option<Layout> {
    let Some(list) = root.get("place") else { return layout };
    let Layout::Instruments(mut all) = layout? else {
        let message = "`[[place]]` is for fixtures of instruments, and this map has no [[instrument]]";
        document.mistake(Diagnostic::new(list.key_span.clone(), message).help("remove it"));
        return None;
    };
    for item in document.array(&list, "an array of tables [[place]]")? {
        let mut section = document.section(&item)?;
        section.span = item.span();
        section.name = "this [[place]]".to_owned();
        section.check_keys(&[&keys::PLACE], document);
        let names: Vec<&str> = all.list.iter().map(|instrument| instrument.name.as_str()).collect();
        let name = section.required("name", document)?;
        let text = document.string(&name)?;
        let instrument = find_name(document, name.span(), &text, &names, "instrument")?;
        let (fixture, first) = (all.fixture_of(instrument), all.list[instrument].observables.start);
        let (kind, zero_known) = (all.observables[first].kind, all.observables[first].zero_known);
        if let Some(fixture) = fixture {
            let (key, dimension) = match all.fixtures[fixture].geometry {
                FixtureGeometry::Point(_) => ("position", Dimension::LENGTH),
                FixtureGeometry::Direction(_) => ("direction", Dimension::NONE),
            };
            let three = section.required(key, document)?;
            let three: [Item<'_>; 3] = document.entries(&three, "three numbers: x, y, z")?;
            let [x, y, z] = three.map(|item| constant(&item, document, spec, dimension));
            let found = [x?, y?, z?];
            all.fixtures[fixture].geometry = match all.fixtures[fixture].geometry {
                FixtureGeometry::Point(_) => FixtureGeometry::Point(found),
                FixtureGeometry::Direction(_) if norm(found) > 0.0 => FixtureGeometry::Direction(found),
                FixtureGeometry::Direction(_) => {
                    let mistake = Diagnostic::new(item.span(), "`direction` must not be zero");
                    document.mistake(mistake.help("write a vector such as [0, 0, 1] for z"));
                    return None;
                }
            };
        }
        if !zero_known {
            let zero = section.required("zero", document)?;
            let dimension = if kind.is_angle { Dimension::NONE } else { Dimension::LENGTH };
            all.observables[first].zero = constant(&zero, document, spec, dimension)?;
        }
        if let Some(camera) = &mut all.camera {
            let item = section.required("intrinsics", document)?;
            let nine: [Item<'_>; INTRINSICS] =
                document.entries(&item, "nine numbers: fx fy cx cy k1 k2 p1 p2 k3")?;
            for (value, item) in camera.intrinsics.iter_mut().zip(nine) {
                *value = constant(&item, document, spec, Dimension::NONE)?;
            }
            covariance(&section, document, INTRINSICS)?;
            all.found.push(instrument);
            continue;
        }
        let place = fixture.map_or(0, |fixture| all.fixtures[fixture].geometry.unknowns());
        covariance(&section, document, place + usize::from(!zero_known))?;
        all.found.push(instrument);
    }
    Some(Layout::Instruments(all))
}

/// Reads a position and a quaternion w x y z.
fn place(section: &Section<'_>, document: &mut Document, spec: &Spec) -> Option<Pose> {
    let position = section.required("position", document)?;
    let position: [Item<'_>; 3] = document.entries(&position, "three lengths")?;
    let [x, y, z] = position.map(|item| constant(&item, document, spec, Dimension::LENGTH));
    let item = section.required("quaternion", document)?;
    let numbers: [Item<'_>; 4] = document.entries(&item, "four numbers: w x y z")?;
    let numbers = numbers.map(|item| constant(&item, document, spec, Dimension::NONE));
    let numbers: Vec<f64> = numbers.into_iter().collect::<Option<_>>()?;
    match rotation::from_quaternion(&numbers) {
        Ok([a, b, c]) => Some(Pose([a, b, c, [x?, y?, z?]])),
        Err(reason) => {
            document
                .mistake(Diagnostic::new(item.span(), reason).help("write `[1, 0, 0, 0]` for no rotation"));
            None
        }
    }
}

/// Checks the size of a covariance, which is not used otherwise.
fn covariance(section: &Section<'_>, document: &mut Document, size: usize) -> Option<()> {
    let Some(item) = section.get("covariance") else { return Some(()) };
    let rows = document.array(&item, "rows of numbers")?;
    let mut right = rows.len() == size;
    for row in &rows {
        right &= document.array(row, "numbers")?.len() == size;
    }
    if right {
        return Some(());
    }
    let message = format!("this covariance must have {size} rows of {size} numbers");
    document.mistake(Diagnostic::new(item.span(), message).help("or remove it: no result depends on it"));
    None
}
