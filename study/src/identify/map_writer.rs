//! The map of the identified machine: that of its data, with where it stands, what is mounted on its tool, and the inputs that
//! follow from the rows.

use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostics;
use abbe_spec::document::{Document, Section};

use super::derived::{Derived, with_inputs};
use super::found::FoundModel;
use super::placed::Placed;
use crate::data::{Map, quaternion};
use crate::toml_text::quoted;

impl FoundModel {
    /// The map that the data were read with, with what was found; `path` is the name of its file. What an earlier
    /// identification said of it is left out.
    ///
    /// What is written is a map of the found spec, or it is not written.
    pub fn identified_map(&self, map: &Map, spec: &Spec, path: &str) -> Result<String, Diagnostics> {
        let (whole, needed) = (with_inputs(spec, &self.derived), self.needed(spec));
        let text = with_from_rows(&without_places(map.text()), &whole, &needed);
        let places = self.placed.text(spec.length.symbol());
        let text = format!("{}\n\n{HEAD}# {}\n{places}", text.trim_end(), self.reference);
        let text = text.trim_end().to_owned() + "\n";
        Map::parse(path, &text, &whole)?;
        Ok(text)
    }
}

/// A map with inputs that follow from the rows.
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

impl Placed {
    /// As tables of a map; `unit` is that of lengths.
    fn text(&self, unit: &str) -> String {
        let mut text = String::new();
        let place = |pose: &[[f64; 4]; 4]| {
            let [x, y, z] = [0, 1, 2].map(|axis| pose[axis][3]);
            let columns = [0, 1, 2].map(|j| [0, 1, 2].map(|i| pose[i][j]));
            let [w, a, b, c] = quaternion(&columns).map(number);
            format!("position = {}\nquaternion = [{w}, {a}, {b}, {c}]\n", lengths([x, y, z], unit))
        };
        for station in &self.stations {
            let name = match &station.name[..] {
                "" => String::new(),
                name => format!("name = {}\n", quoted(name)),
            };
            let covariance = matrix(station.covariance.iter().map(|row| &row[..]));
            text += &format!("[[station]]\n{name}{}{covariance}\n", place(&station.pose));
        }
        if !self.exact {
            let covariance = matrix(self.covariance.iter().map(|row| &row[..]));
            let places = match &self.mounting {
                Some(pose) => place(pose),
                None => {
                    let targets =
                        self.targets.iter().map(|target| format!("  {},\n", lengths(*target, unit)));
                    format!("targets = [\n{}]\n", targets.collect::<String>())
                }
            };
            text += &format!("[placement]\n{places}{covariance}");
        }
        for place in &self.instruments {
            text += &format!("\n[[place]]\nname = {}\n", quoted(&place.name));
            if let Some(position) = place.position {
                text += &format!("position = {}\n", lengths(position, unit));
            }
            if let Some(direction) = place.direction {
                let [x, y, z] = direction.map(number);
                text += &format!("direction = [{x}, {y}, {z}]\n");
            }
            if let Some(zero) = place.zero {
                let unit = if place.is_angle { "rad" } else { unit };
                text += &format!("zero = \"{} {unit}\"\n", number(zero));
            }
            text += &matrix(place.covariance.iter().map(|row| &row[..]));
        }
        text
    }
}

const HEAD: &str =
    "# Where the machine stands and what is mounted on its tool, as found: no errors of the machine.\n";

/// A map without the tables that `[[station]]`, `[placement]` and `[[place]]` are, and without what is said above them.
fn without_places(text: &str) -> String {
    let mut inside = false;
    let kept = text.split_inclusive('\n').filter(|line| {
        if line.starts_with('[') {
            inside = ["[[station]]", "[placement]", "[[place]]"].iter().any(|table| line.starts_with(table));
        }
        inside |= *line == HEAD;
        !inside
    });
    kept.collect()
}

fn lengths(values: [f64; 3], unit: &str) -> String {
    let [x, y, z] = values.map(|value| format!("\"{} {unit}\"", number(value)));
    format!("[{x}, {y}, {z}]")
}

fn matrix<'r>(rows: impl Iterator<Item = &'r [f64]>) -> String {
    let row = |row: &[f64]| {
        let numbers: Vec<String> = row.iter().map(|value| format!("{:e}", rounded(*value, 4))).collect();
        format!("  [{}],\n", numbers.join(", "))
    };
    format!("covariance = [\n{}]\n", rows.map(row).collect::<String>())
}

/// Digits enough for a nanometre at ten metres.
fn number(value: f64) -> String {
    format!("{:e}", rounded(value, 11))
}

fn rounded(value: f64, digits: usize) -> f64 {
    format!("{value:.digits$e}").parse::<f64>().unwrap_or(value) + 0.0
}
