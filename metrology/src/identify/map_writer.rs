//! Writes the map of the identified machine: the map of the data with the identified placement and
//! the inputs derived from rows.

use abbe_spec::edit::write::{lines, list, number, quantity, quoted};
use abbe_spec::edit::{Edits, TableText};
use abbe_spec::{Item, Section, Spec};

use super::{FoundModel, FoundPlacement, InstrumentFit, PlacementAtStation, derived::with_inputs};
use crate::data::{Map, TargetFrame, UNKNOWN, quaternion};
use abbe_study::{Result, number::digits};

impl FoundModel {
    /// Returns the map of the data with the identified placement and the uncertainties estimated
    /// from the data. `path` is the name of its file. Results of an earlier identification are
    /// replaced.
    ///
    /// The text is parsed again; the function fails if it is not a map of the identified spec.
    pub fn identified_map(&self, map: &Map, spec: &Spec, path: &str) -> Result<String> {
        let (whole, needed) = (with_inputs(spec, &self.derived), self.needed(spec));
        let from_rows = needed.iter().filter_map(|one| Some((&one.name, one.from_rows()?)));
        let mut added = String::new();
        let kept = Edits::apply(map.text(), |root, edits| {
            edits.remove_tables(root, &["station", "placement", "place"]);
            set_uncertainties(root, edits, map, &self.estimated);
            let inputs = root.get("inputs").filter(|item| edits.is_inline(item));
            for (name, rule) in from_rows {
                match &inputs {
                    Some(inputs) => edits.set(inputs, name, rule.keys(&whole).inline()),
                    None => added += &format!("\n[inputs.{name}]\n{}", rule.keys(&whole)),
                }
            }
            Some(())
        });
        let kept = format!("{}\n{added}", kept.as_deref().unwrap_or(map.text()).trim_end());
        let placement = self.placed.text(spec.length.symbol(), map);
        let text = format!("{}\n\n{HEAD}# {}\n{}", kept.trim_end(), self.reference, placement.trim());
        let text = text.trim_end().to_owned() + "\n";
        Map::parse(path, &text, &whole)?;
        Ok(text)
    }
}

/// Replaces each `"unknown"` uncertainty of a map by its estimate.
fn set_uncertainties(root: &Section<'_>, edits: &mut Edits<'_>, map: &Map, estimated: &[InstrumentFit]) {
    let mut set = |item: &Item<'_>, key: &str, name: &str| {
        let value = item.as_table().and_then(|table| table.get(key));
        let value = value.filter(|value| value.text() == Some(UNKNOWN[0].0));
        if let (Some(value), Some(one)) = (value, estimated.iter().find(|one| one.name == name)) {
            let number = digits(one.uncertainty, 3);
            // Pixels have no unit in a map.
            edits.replace(value.span(), if one.unit == "px" { number } else { quantity(number, one.unit) });
        }
    };
    if let Some(head) = root.get("data") {
        set(&head, "uncertainty", "positions");
        set(&head, "angle_uncertainty", "rotations");
    }
    if let (Some(all), Some(items)) = (map.instruments(), root.get("instrument")) {
        items.list().iter().zip(&all.list).for_each(|(item, one)| set(item, "uncertainty", &one.name));
    }
}

impl FoundPlacement {
    /// Formats the placement as tables of the map of the data. `unit` is the length unit.
    fn text(&self, unit: &str, map: &Map) -> String {
        let mut text = String::new();
        for station in &self.stations {
            let name = Some(&station.name).filter(|name| !name.is_empty());
            let keys = TableText::with_header("[[station]]").optional("name", name.map(|name| quoted(name)));
            text += &format!("{}\n", covariance(pose(keys, &station.pose, unit), &station.covariance));
        }
        let stated = if self.exact { Vec::new() } else { self.placements() };
        let is_single = stated.len() == 1;
        for placement in stated {
            let station = match &self.stations[..] {
                [station] if is_single => &station.name,
                _ => &placement.station,
            };
            let head = match map.placement.is_per_station {
                false => TableText::with_header("[placement]"),
                true => TableText::with_header("\n[[placement]]").text("station", station),
            };
            text += &placement.keys(head, unit, &map.target_frame).to_string();
        }
        for place in &self.instruments {
            let angle = if place.is_angle { "rad" } else { unit };
            let keys = TableText::with_header("\n[[place]]")
                .text("name", &place.name)
                .optional("position", place.position.map(|position| lengths(position, unit)))
                .optional("direction", place.direction.map(numbers))
                .optional("zero", place.zero.map(|zero| quantity(number(zero, DIGITS), angle)))
                .optional("intrinsics", place.intrinsics.map(numbers));
            text += &covariance(keys, &place.covariance).to_string();
        }
        text
    }
}

impl PlacementAtStation {
    /// Adds the keys of its table. `unit` is the length unit, `frame` that of the positions of
    /// targets.
    fn keys(&self, table: TableText, unit: &str, frame: &TargetFrame) -> TableText {
        match &self.mounting {
            Some(mounting) => covariance(pose(table, mounting, unit), &self.covariance),
            None => {
                let targets = self.targets.iter().map(|target| frame.placed_in_frame(*target));
                let targets = lines(targets.map(|target| lengths(target, unit)));
                covariance(table.key("targets", targets), &frame.covariance_from_tool(&self.covariance))
            }
        }
    }
}

/// Digits of a written number, enough for a nanometre at ten metres.
const DIGITS: usize = 12;

const HEAD: &str =
    "# Identified placement of the machine and of its tool; these are no errors of the machine.\n";

fn pose(table: TableText, pose: &[[f64; 4]; 4], unit: &str) -> TableText {
    let columns = [0, 1, 2].map(|j| [0, 1, 2].map(|i| pose[i][j]));
    let position = lengths([0, 1, 2].map(|axis| pose[axis][3]), unit);
    table.key("position", position).key("quaternion", numbers(quaternion(&columns)))
}

fn numbers<const N: usize>(values: [f64; N]) -> String {
    list(values.map(|value| number(value, DIGITS)))
}

fn lengths(values: [f64; 3], unit: &str) -> String {
    list(values.map(|value| quantity(number(value, DIGITS), unit)))
}

fn covariance<R: AsRef<[f64]>>(table: TableText, rows: &[R]) -> TableText {
    let row = |row: &R| list(row.as_ref().iter().map(|value| number(*value, 5)));
    table.key("covariance", lines(rows.iter().map(row)))
}
