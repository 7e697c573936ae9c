//! Writes the map of the identified machine: the map of the data with the identified placement and
//! the inputs derived from rows.

use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostics;
use abbe_spec::document::{Document, Section};
use abbe_spec::literal::quoted;

use super::derived::{Derived, with_inputs};
use super::found_model::FoundModel;
use super::found_placement::{FoundPlacement, PlacementAtStation};
use super::instruments::InstrumentFit;
use crate::data::{Map, TargetFrame, UNKNOWN, quaternion};
use abbe_study::number::digits;

impl FoundModel {
    /// Returns the map of the data with the identified placement and the uncertainties estimated
    /// from the data. `path` is the name of its file. Results of an earlier identification are
    /// replaced.
    ///
    /// The text is parsed again; the function fails if it is not a map of the identified spec.
    pub fn identified_map(&self, map: &Map, spec: &Spec, path: &str) -> Result<String, Diagnostics> {
        let (whole, needed) = (with_inputs(spec, &self.derived), self.needed(spec));
        let text = with_uncertainties(&without_placement(map.text()), map, &self.estimated);
        let text = with_from_rows(&text, &whole, &needed);
        let placement = self.placed.text(spec.length.symbol(), map);
        let text = format!("{}\n\n{HEAD}# {}\n{placement}", text.trim_end(), self.reference);
        let text = text.trim_end().to_owned() + "\n";
        Map::parse(path, &text, &whole)?;
        Ok(text)
    }
}

/// Replaces each `"unknown"` uncertainty of a map by its estimate.
fn with_uncertainties(text: &str, map: &Map, estimated: &[InstrumentFit]) -> String {
    let mut document = Document::new("", text);
    let Some(tables) = document.tables(text) else { return text.to_owned() };
    let root = Section::root(&tables);
    let estimate = |name: &str| estimated.iter().find(|one| one.name == name);
    let mut changes = Vec::new();
    let mut change = |section: &Section<'_>, key: &str, one: Option<&InstrumentFit>| {
        let value =
            section.get(key).filter(|item| text[item.span()].trim_matches(['"', '\'']) == UNKNOWN[0].0);
        if let (Some(item), Some(one)) = (value, one) {
            changes.push((item.span(), format!("\"{} {}\"", digits(one.uncertainty, 3), one.unit)));
        }
    };
    if let Some(head) = root.get("data").and_then(|item| document.section(&item)) {
        change(&head, "uncertainty", estimate("positions"));
        change(&head, "angle_uncertainty", estimate("rotations"));
    }
    if let (Some(all), Some(item)) = (map.instruments(), root.get("instrument")) {
        let items = document.array(&item, "").unwrap_or_default();
        for (item, instrument) in items.iter().zip(&all.list) {
            if let Some(section) = document.section(item) {
                change(&section, "uncertainty", estimate(&instrument.name));
            }
        }
    }
    changes.sort_by_key(|(span, _)| std::cmp::Reverse(span.start));
    let mut text = text.to_owned();
    changes.into_iter().for_each(|(span, value)| text.replace_range(span, &value));
    text
}

/// Adds inputs derived from rows to a map.
fn with_from_rows(text: &str, spec: &Spec, needed: &[&Derived]) -> String {
    let lines = needed.iter().filter_map(|one| Some((&one.name, one.from_rows()?.lines(spec))));
    let mut document = Document::new("", text);
    let tables = document.tables(text);
    let inline = tables.as_ref().and_then(|tables| Section::root(tables).get("inputs"));
    match inline.map(|item| item.span()).filter(|span| text[span.clone()].starts_with('{')) {
        Some(span) => {
            let entry = |(name, lines): (&String, String)| {
                format!(", {name} = {{ {} }}", lines.trim_end().replace('\n', ", "))
            };
            let (before, behind) = text.split_at(span.end - 1);
            let entries = lines.map(entry).collect::<String>();
            let first = before.trim_end().ends_with('{');
            format!("{before}{}{behind}", if first { entries.trim_start_matches(',') } else { &entries })
        }
        None => {
            let tables = lines.map(|(name, lines)| format!("\n[inputs.{name}]\n{lines}"));
            format!("{}\n{}", text.trim_end(), tables.collect::<String>())
        }
    }
}

impl FoundPlacement {
    /// Formats the placement as tables of the map of the data. `unit` is the length unit.
    fn text(&self, unit: &str, map: &Map) -> String {
        let mut text = String::new();
        for station in &self.stations {
            let name = match &station.name[..] {
                "" => String::new(),
                name => format!("name = {}\n", quoted(name)),
            };
            let covariance = format_covariance(station.covariance.iter().map(|row| &row[..]));
            text += &format!("[[station]]\n{name}{}{covariance}\n", format_pose(&station.pose, unit));
        }
        let stated = if self.exact { Vec::new() } else { self.placements() };
        let is_single = stated.len() == 1;
        for placement in stated {
            let header = match (map.placement.is_per_station, &self.stations[..]) {
                (false, _) => "[placement]\n".to_owned(),
                (true, [station]) if is_single => placement_header(&station.name),
                (true, _) => placement_header(&placement.station),
            };
            text += &format!("{header}{}", placement.text(unit, &map.target_frame));
        }
        for place in &self.instruments {
            text += &format!("\n[[place]]\nname = {}\n", quoted(&place.name));
            if let Some(position) = place.position {
                text += &format!("position = {}\n", format_lengths(position, unit));
            }
            if let Some(direction) = place.direction {
                let [x, y, z] = direction.map(format_number);
                text += &format!("direction = [{x}, {y}, {z}]\n");
            }
            if let Some(zero) = place.zero {
                let unit = if place.is_angle { "rad" } else { unit };
                text += &format!("zero = \"{} {unit}\"\n", format_number(zero));
            }
            if let Some(intrinsics) = place.intrinsics {
                let numbers = intrinsics.map(format_number).join(", ");
                text += &format!("intrinsics = [{numbers}]\n");
            }
            text += &format_covariance(place.covariance.iter().map(|row| &row[..]));
        }
        text
    }
}

impl PlacementAtStation {
    /// Formats the keys of its table. `unit` is the length unit, `frame` that of the positions of
    /// targets.
    fn text(&self, unit: &str, frame: &TargetFrame) -> String {
        let (placement, covariance) = match &self.mounting {
            Some(pose) => (format_pose(pose, unit), self.covariance.clone()),
            None => {
                let targets = self.targets.iter().map(|target| frame.placed_in_frame(*target));
                let targets = targets.map(|target| format!("  {},\n", format_lengths(target, unit)));
                let targets = format!("targets = [\n{}]\n", targets.collect::<String>());
                (targets, frame.covariance_from_tool(&self.covariance))
            }
        };
        format!("{placement}{}", format_covariance(covariance.iter().map(|row| &row[..])))
    }
}

fn placement_header(station: &str) -> String {
    format!("\n[[placement]]\nstation = {}\n", quoted(station))
}

fn format_pose(pose: &[[f64; 4]; 4], unit: &str) -> String {
    let [x, y, z] = [0, 1, 2].map(|axis| pose[axis][3]);
    let columns = [0, 1, 2].map(|j| [0, 1, 2].map(|i| pose[i][j]));
    let [w, a, b, c] = quaternion(&columns).map(format_number);
    format!("position = {}\nquaternion = [{w}, {a}, {b}, {c}]\n", format_lengths([x, y, z], unit))
}

const HEAD: &str =
    "# Identified placement of the machine and of its tool; these are no errors of the machine.\n";

/// Removes the tables `[[station]]`, `[placement]` or `[[placement]]`, and `[[place]]` with the
/// comment above them from a map.
fn without_placement(text: &str) -> String {
    let mut inside = false;
    let kept = text.split_inclusive('\n').filter(|line| {
        if line.starts_with('[') {
            let tables = ["[[station]]", "[placement]", "[[placement]]", "[[place]]"];
            inside = tables.iter().any(|table| line.starts_with(table));
        }
        inside |= *line == HEAD;
        !inside
    });
    kept.collect()
}

fn format_lengths(values: [f64; 3], unit: &str) -> String {
    let [x, y, z] = values.map(|value| format!("\"{} {unit}\"", format_number(value)));
    format!("[{x}, {y}, {z}]")
}

fn format_covariance<'r>(rows: impl Iterator<Item = &'r [f64]>) -> String {
    let row = |row: &[f64]| {
        let numbers: Vec<String> = row.iter().map(|value| format!("{:e}", rounded(*value, 4))).collect();
        format!("  [{}],\n", numbers.join(", "))
    };
    format!("covariance = [\n{}]\n", rows.map(row).collect::<String>())
}

/// Formats a number with 12 digits, enough for a nanometre at ten metres.
fn format_number(value: f64) -> String {
    format!("{:e}", rounded(value, 11))
}

fn rounded(value: f64, digits: usize) -> f64 {
    format!("{value:.digits$e}").parse::<f64>().unwrap_or(value) + 0.0
}
