//! Corrects the text of a spec by an interpretation, and leaves everything else in it as it is.
//!
//! Numbers of the other convention are under the other key; what is the other way round is its factors inverted, last first; a coupled joint
//! and zeros behind a coupling are written where the variable stands: with column values c, `q3` becomes `(q3 + q2 + zero)`.

use std::ops::Range;
use std::path::Path;

use abbe::VariableKind;
use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostics;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::report::Report;
use crate::interpretations::{Change, words};
use crate::number::digits;
use crate::toml_text::quoted;

/// The keys that place a frame or the tool.
const PLACES: [&str; 5] = ["transform", "matrix", "dh", "mdh", "origin"];

/// Digits of a fitted zero, which rows determine to fewer.
const DIGITS: usize = 8;

/// Where text is replaced, and by what.
type Edit = (Range<usize>, String);

impl Report {
    /// Returns the spec, whose text this is, by the first interpretation; none if that changes nothing of the spec, or something that its
    /// text cannot say. `path` is the name of its file: files of tables must be where they are looked for from there.
    pub fn corrected(&self, spec: &Spec, text: &str, path: &str) -> Result<Option<String>, Diagnostics> {
        let changes = self.found.first().map_or(&[][..], |found| &found.interpretation.changes);
        let Some(text) = changed(changes, spec, text) else { return Ok(None) };
        Spec::parse_in(Path::new(path).parent().unwrap_or(Path::new("")), path, &text)?;
        Ok(Some(text))
    }
}

fn changed(changes: &[Change], spec: &Spec, text: &str) -> Option<String> {
    let coupled = changes.iter().any(|change| matches!(change, Change::Coupled { .. }));
    let mut of_spec: Vec<&Change> = changes.iter().filter(|change| step(change, coupled).is_some()).collect();
    // As the search tries it: ends that are exchanged are then turned round.
    of_spec.sort_by_key(|change| step(change, coupled));
    let (mut new, mut said, mut meant) = (text.to_owned(), String::new(), Vec::new());
    for change in &of_spec {
        said += &format!("# - {}\n", words::change(change, spec));
        match change {
            Change::Coupled { joint, to, by } => {
                let sign = if *by > 0.0 { '+' } else { '-' };
                meant.push((*joint, format!(" {sign} {}", spec.variables[*to].name)));
            }
            Change::Zero { joint, offset } => meant.push((*joint, zero(*offset, *joint, spec))),
            change => new = edited(&new, |file| file.edits(change, spec))?,
        }
    }
    if !meant.is_empty() {
        new = edited(&new, |file| file.meant(&meant, spec))?;
    }
    (!of_spec.is_empty()).then(|| format!("# The spec as `abbe doctor` reads it:\n{said}{new}"))
}

/// The step in which a change is written, of those that concern the spec; the others concern columns, and are in the map.
fn step(change: &Change, coupled: bool) -> Option<u8> {
    match change {
        Change::Convention => Some(0),
        Change::EndsExchanged => Some(1),
        Change::ToolInverted | Change::BaseInverted => Some(2),
        Change::ToolLeftOut | Change::BaseLeftOut => Some(3),
        Change::Coupled { .. } => Some(4),
        Change::Zero { .. } if coupled => Some(5),
        _ => None,
    }
}

/// A text with places in it replaced.
fn edited(text: &str, edits: impl FnOnce(&File<'_>) -> Option<Vec<Edit>>) -> Option<String> {
    let table = DeTable::parse(text).ok()?;
    let mut edits = edits(&File { text, table: table.get_ref() })?;
    edits.sort_by_key(|(span, _)| span.start);
    let (mut new, mut end) = (String::new(), 0);
    for (span, with) in edits {
        new += text.get(end..span.start)?;
        new += &with;
        end = span.end;
    }
    Some(new + text.get(end..)?)
}

fn zero(offset: f64, joint: usize, spec: &Spec) -> String {
    let sign = if offset < 0.0 { '-' } else { '+' };
    match spec.variables[joint].kind {
        VariableKind::Revolute => format!(" {sign} {} deg", digits(offset.to_degrees().abs(), DIGITS)),
        VariableKind::Prismatic => {
            format!(" {sign} {} {}", digits(offset.abs(), DIGITS), spec.length.symbol())
        }
    }
}

/// What places a frame or the tool: its key and its value.
#[derive(Clone, Copy)]
struct Placement<'t> {
    key: &'t str,
    /// From the key on.
    start: usize,
    value: &'t Spanned<DeValue<'t>>,
}

impl Placement<'_> {
    fn span(&self) -> Range<usize> {
        self.start..self.value.span().end
    }
}

struct File<'t> {
    text: &'t str,
    table: &'t DeTable<'t>,
}

impl<'t> File<'t> {
    fn frames(&self) -> Vec<&'t DeTable<'t>> {
        let Some(DeValue::Array(frames)) = self.table.get("frame").map(Spanned::get_ref) else {
            return Vec::new();
        };
        frames.iter().filter_map(|frame| frame.get_ref().as_table()).collect()
    }

    fn place(table: &'t DeTable<'t>) -> Option<Placement<'t>> {
        table.iter().find_map(|(key, value)| {
            let name: &str = key.get_ref();
            PLACES.contains(&name).then(|| Placement { key: name, start: key.span().start, value })
        })
    }

    fn tool(&self) -> Option<Placement<'t>> {
        Self::place(self.table.get("tool")?.get_ref().as_table()?)
    }

    /// The one frame before all that moves.
    fn base(&self, spec: &Spec) -> Option<Placement<'t>> {
        let moving = spec.variables_of_transforms();
        let fixed = moving.iter().take_while(|variables| variables.is_empty()).count();
        (fixed == 1).then(|| Self::place(self.frames()[0]))?
    }

    /// What a change of ends or of the convention is in the text.
    fn edits(&self, change: &Change, spec: &Spec) -> Option<Vec<Edit>> {
        Some(match change {
            Change::Convention => self.other_convention(),
            Change::EndsExchanged => self.exchanged(self.base(spec)?, self.tool()?).to_vec(),
            Change::ToolInverted => vec![self.inverted(self.tool()?)?],
            Change::BaseInverted => vec![self.inverted(self.base(spec)?)?],
            Change::ToolLeftOut => vec![Self::left_out(self.tool()?)],
            Change::BaseLeftOut => vec![Self::left_out(self.base(spec)?)],
            _ => return None,
        })
    }

    fn other_convention(&self) -> Vec<Edit> {
        let places = self.frames().into_iter().filter_map(Self::place);
        let other = |key: &str| match key {
            "dh" => Some("mdh"),
            "mdh" => Some("dh"),
            _ => None,
        };
        places
            .filter_map(|place| {
                Some((place.start..place.start + place.key.len(), other(place.key)?.to_owned()))
            })
            .collect()
    }

    fn left_out(place: Placement<'_>) -> Edit {
        (place.span(), "origin = { xyz = [0, 0, 0] }".to_owned())
    }

    fn exchanged(&self, one: Placement<'_>, other: Placement<'_>) -> [Edit; 2] {
        let with =
            |place: Placement<'_>, other: Placement<'_>| (place.span(), self.text[other.span()].to_owned());
        [with(one, other), with(other, one)]
    }

    /// The factors of a place, last first, each the other way round.
    fn inverted(&self, place: Placement<'_>) -> Option<Edit> {
        let factors: Vec<(String, String)> = match (place.key, place.value.get_ref()) {
            ("transform", DeValue::String(product)) => factors(product)?,
            ("dh", DeValue::Table(four)) => self.four(four, ["theta", "d", "a", "alpha"])?,
            ("mdh", DeValue::Table(four)) => self.four(four, ["alpha", "a", "theta", "d"])?,
            ("origin", DeValue::Table(origin)) => self.origin(origin)?,
            _ => return None,
        };
        let inverse: Vec<String> =
            factors.iter().rev().map(|(name, amount)| format!("{name}({})", negative(amount))).collect();
        Some((place.span(), format!("transform = {}", quoted(&inverse.join(" ")))))
    }

    /// Four numbers as factors, in the order of the convention.
    fn four(&self, table: &DeTable<'_>, keys: [&str; 4]) -> Option<Vec<(String, String)>> {
        let factor = |key: &str| {
            let name = match key {
                "theta" => "Rz",
                "d" => "Tz",
                "a" => "Tx",
                _ => "Rx",
            };
            Some((name.to_owned(), self.amount(table.get(key)?)?))
        };
        keys.into_iter().map(factor).collect()
    }

    /// T(xyz) Rz(yaw) Ry(pitch) Rx(roll).
    fn origin(&self, table: &DeTable<'_>) -> Option<Vec<(String, String)>> {
        let three = |key: &str, names: [&str; 3]| -> Option<Vec<(String, String)>> {
            let Some(values) = table.get(key) else { return Some(Vec::new()) };
            let values = values.get_ref().as_array()?;
            names
                .iter()
                .zip(values)
                .map(|(name, value)| Some(((*name).to_owned(), self.amount(value)?)))
                .collect()
        };
        let mut turns = three("rpy", ["Rx", "Ry", "Rz"])?;
        turns.reverse();
        Some([three("xyz", ["Tx", "Ty", "Tz"])?, turns].concat())
    }

    /// What stands in a value: a number or an expression.
    fn amount(&self, value: &Spanned<DeValue<'_>>) -> Option<String> {
        match value.get_ref() {
            DeValue::String(text) => Some(text.to_string()),
            DeValue::Integer(_) | DeValue::Float(_) => Some(self.text.get(value.span())?.to_owned()),
            _ => None,
        }
    }

    /// Every variable as what is meant by it, in all that places a frame.
    fn meant(&self, added: &[(usize, String)], spec: &Spec) -> Option<Vec<Edit>> {
        let mut edits = Vec::new();
        let meant: Vec<(&str, String)> = (0..spec.variables.len())
            .filter_map(|i| {
                let parts: String =
                    added.iter().filter(|(joint, _)| *joint == i).map(|(_, part)| part.as_str()).collect();
                let name = spec.variables[i].name.as_str();
                (!parts.is_empty()).then(|| (name, format!("({name}{parts})")))
            })
            .collect();
        for (i, frame) in self.frames().into_iter().enumerate() {
            let place = Self::place(frame)?;
            let variable = spec.frames[i].variable.map(|variable| spec.variables[variable].name.as_str());
            // There the variable is moved about an axis, and stands in no expression.
            if place.key == "origin" && meant.iter().any(|(name, _)| variable == Some(name)) {
                return None;
            }
            self.each_text(place.value, &mut |span| {
                let old = &self.text[span.clone()];
                let new = with_names(old, &meant);
                if new != old {
                    edits.push((span, new));
                }
            });
        }
        Some(edits)
    }

    fn each_text(&self, value: &Spanned<DeValue<'_>>, found: &mut impl FnMut(Range<usize>)) {
        match value.get_ref() {
            DeValue::String(_) => found(value.span()),
            DeValue::Array(values) => values.iter().for_each(|value| self.each_text(value, found)),
            DeValue::Table(table) => table.values().for_each(|value| self.each_text(value, found)),
            _ => {}
        }
    }
}

/// `Tx(30 mm) Rz(q1)`: names and amounts.
fn factors(product: &str) -> Option<Vec<(String, String)>> {
    let mut rest = product.trim_start();
    let mut found = Vec::new();
    while !rest.is_empty() {
        let (name, inner) = rest.split_once('(')?;
        let mut depth = 1;
        let end = inner.find(|c: char| {
            depth += i32::from(c == '(') - i32::from(c == ')');
            depth == 0
        })?;
        found.push((name.trim_end().to_owned(), inner[..end].trim().to_owned()));
        rest = inner[end + 1..].trim_start();
        rest = rest.strip_prefix('*').unwrap_or(rest).trim_start();
    }
    Some(found)
}

/// The other sign: of a number as a number, so that its unit is still that of its place.
fn negative(amount: &str) -> String {
    match amount.parse::<f64>() {
        Ok(0.0) => "0".to_owned(),
        Ok(_) => amount
            .strip_prefix('-')
            .map_or_else(|| format!("-{}", amount.trim_start_matches('+')), str::to_owned),
        Err(_) => format!("-({amount})"),
    }
}

/// A text with some names replaced, where they stand as whole words.
fn with_names(text: &str, meant: &[(&str, String)]) -> String {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let mut new = String::new();
    let mut rest = text;
    while let Some(begin) = rest.find(is_word) {
        let end = rest[begin..].find(|c| !is_word(c)).map_or(rest.len(), |end| begin + end);
        let word = &rest[begin..end];
        new += &rest[..begin];
        new += meant.iter().find(|(name, _)| *name == word).map_or(word, |(_, meant)| meant);
        rest = &rest[end..];
    }
    new + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_are_the_other_way_round() {
        let inverse = |product| {
            factors(product).map(|all| {
                let turned: Vec<String> =
                    all.iter().rev().map(|(name, amount)| format!("{name}({})", negative(amount))).collect();
                turned.join(" ")
            })
        };
        assert_eq!(
            inverse("Tx(-30) Rz(2*(q1 + 1))  Ty( a )").as_deref(),
            Some("Ty(-(a)) Rz(-(2*(q1 + 1))) Tx(30)")
        );
        assert_eq!(inverse("Tx(30"), None);
    }

    #[test]
    fn names_are_whole_words() {
        let meant = [("q3", "(q3 + q2)".to_owned())];
        assert_eq!(with_names("\"q3 - q31*q2 + 2*q3\"", &meant), "\"(q3 + q2) - q31*q2 + 2*(q3 + q2)\"");
    }
}
