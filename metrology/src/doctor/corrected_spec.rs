//! Rewrites the text of a spec according to an interpretation, and keeps everything else in it.
//!
//! The other convention is the other key. An inverted placement is the product of its inverted
//! factors in reverse order. A coupled joint, and the zeros of a coupled machine, are inserted at
//! the variable: with column values c, `q3` becomes `(q3 + q2 + zero)`.

use std::ops::Range;
use std::path::Path;

use abbe::VariableKind;
use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostics;
use abbe_spec::literal::quoted;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::report::Report;
use crate::interpretations::{Change, words};
use abbe_study::number::digits;

/// Keys that place a frame or the tool.
const PLACEMENT_KEYS: [&str; 5] = ["transform", "matrix", "dh", "mdh", "origin"];

/// Significant digits of a fitted zero; data determine fewer.
const DIGITS: usize = 8;

/// Range of text to replace, with its replacement.
type Edit = (Range<usize>, String);

impl Report {
    /// Returns the text of the spec according to the first interpretation. Returns `None` if that
    /// changes nothing in the spec, or cannot be expressed in its text. `path` is the file name of
    /// the result; paths of table files are resolved from there.
    pub fn corrected(&self, spec: &Spec, text: &str, path: &str) -> Result<Option<String>, Diagnostics> {
        let changes = self.found.first().map_or(&[][..], |found| &found.interpretation.changes);
        let Some(text) = rewritten(changes, spec, text) else { return Ok(None) };
        Spec::parse_in(Path::new(path).parent().unwrap_or(Path::new("")), path, &text)?;
        Ok(Some(text))
    }
}

fn rewritten(changes: &[Change], spec: &Spec, text: &str) -> Option<String> {
    let coupled = changes.iter().any(|change| matches!(change, Change::Coupled { .. }));
    let mut spec_changes: Vec<&Change> =
        changes.iter().filter(|change| step(change, coupled).is_some()).collect();
    // In the order of the search: ends are exchanged before they are inverted.
    spec_changes.sort_by_key(|change| step(change, coupled));
    let (mut new, mut description, mut substitutions) = (text.to_owned(), String::new(), Vec::new());
    for change in &spec_changes {
        description += &format!("# - {}\n", words::change(change, spec));
        match change {
            Change::Coupled { joint, to, by } => {
                let sign = if *by > 0.0 { '+' } else { '-' };
                substitutions.push((*joint, format!(" {sign} {}", spec.variables[*to].name)));
            }
            Change::Zero { joint, offset } => substitutions.push((*joint, zero(*offset, *joint, spec))),
            change => new = apply_edits(&new, |file| file.edits(change, spec))?,
        }
    }
    if !substitutions.is_empty() {
        new = apply_edits(&new, |file| file.substitute(&substitutions, spec))?;
    }
    (!spec_changes.is_empty()).then(|| format!("# The spec as `abbe doctor` reads it:\n{description}{new}"))
}

/// Returns the order in which a change is applied; `None` for changes of the columns, which the map
/// holds.
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

/// Applies edits to a text.
fn apply_edits(text: &str, edits: impl FnOnce(&File<'_>) -> Option<Vec<Edit>>) -> Option<String> {
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

/// Placement of a frame or the tool: key and value.
#[derive(Clone, Copy)]
struct Placement<'t> {
    key: &'t str,
    /// Start of the key in the text.
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

    fn placement(table: &'t DeTable<'t>) -> Option<Placement<'t>> {
        table.iter().find_map(|(key, value)| {
            let name: &str = key.get_ref();
            PLACEMENT_KEYS.contains(&name).then(|| Placement { key: name, start: key.span().start, value })
        })
    }

    fn tool(&self) -> Option<Placement<'t>> {
        Self::placement(self.table.get("tool")?.get_ref().as_table()?)
    }

    /// Returns the placement of the base, if exactly one frame precedes the first joint.
    fn base(&self, spec: &Spec) -> Option<Placement<'t>> {
        let moving = spec.variables_of_transforms();
        let fixed = moving.iter().take_while(|variables| variables.is_empty()).count();
        (fixed == 1).then(|| Self::placement(self.frames()[0]))?
    }

    /// Returns the edits for a change of base, tool or convention; `None` if the text cannot
    /// express it.
    fn edits(&self, change: &Change, spec: &Spec) -> Option<Vec<Edit>> {
        Some(match change {
            Change::Convention => self.other_convention(),
            Change::EndsExchanged => self.exchange(self.base(spec)?, self.tool()?).to_vec(),
            Change::ToolInverted => vec![self.invert(self.tool()?)?],
            Change::BaseInverted => vec![self.invert(self.base(spec)?)?],
            Change::ToolLeftOut => vec![Self::identity(self.tool()?)],
            Change::BaseLeftOut => vec![Self::identity(self.base(spec)?)],
            _ => return None,
        })
    }

    fn other_convention(&self) -> Vec<Edit> {
        let placements = self.frames().into_iter().filter_map(Self::placement);
        let other = |key: &str| match key {
            "dh" => Some("mdh"),
            "mdh" => Some("dh"),
            _ => None,
        };
        placements
            .filter_map(|placement| {
                Some((
                    placement.start..placement.start + placement.key.len(),
                    other(placement.key)?.to_owned(),
                ))
            })
            .collect()
    }

    fn identity(placement: Placement<'_>) -> Edit {
        (placement.span(), "origin = { xyz = [0, 0, 0] }".to_owned())
    }

    fn exchange(&self, one: Placement<'_>, other: Placement<'_>) -> [Edit; 2] {
        let with = |placement: Placement<'_>, other: Placement<'_>| {
            (placement.span(), self.text[other.span()].to_owned())
        };
        [with(one, other), with(other, one)]
    }

    /// Replaces a placement by its inverse: the inverted factors in reverse order.
    fn invert(&self, placement: Placement<'_>) -> Option<Edit> {
        let factors: Vec<(String, String)> = match (placement.key, placement.value.get_ref()) {
            ("transform", DeValue::String(product)) => factors(product)?,
            ("dh", DeValue::Table(four)) => self.dh_factors(four, ["theta", "d", "a", "alpha"])?,
            ("mdh", DeValue::Table(four)) => self.dh_factors(four, ["alpha", "a", "theta", "d"])?,
            ("origin", DeValue::Table(origin)) => self.origin(origin)?,
            _ => return None,
        };
        let inverse: Vec<String> =
            factors.iter().rev().map(|(name, amount)| format!("{name}({})", negative(amount))).collect();
        Some((placement.span(), format!("transform = {}", quoted(&inverse.join(" ")))))
    }

    /// Returns Denavit-Hartenberg parameters as factors, in the order of the convention.
    fn dh_factors(&self, table: &DeTable<'_>, keys: [&str; 4]) -> Option<Vec<(String, String)>> {
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

    /// Returns a URDF origin as factors: T(xyz) Rz(yaw) Ry(pitch) Rx(roll).
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

    /// Returns the text of a number or expression.
    fn amount(&self, value: &Spanned<DeValue<'_>>) -> Option<String> {
        match value.get_ref() {
            DeValue::String(text) => Some(text.to_string()),
            DeValue::Integer(_) | DeValue::Float(_) => Some(self.text.get(value.span())?.to_owned()),
            _ => None,
        }
    }

    /// Replaces each variable by its corrected expression, in the placements of all frames.
    fn substitute(&self, added: &[(usize, String)], spec: &Spec) -> Option<Vec<Edit>> {
        let mut edits = Vec::new();
        let substitutions: Vec<(&str, String)> = (0..spec.variables.len())
            .filter_map(|i| {
                let parts: String =
                    added.iter().filter(|(joint, _)| *joint == i).map(|(_, part)| part.as_str()).collect();
                let name = spec.variables[i].name.as_str();
                (!parts.is_empty()).then(|| (name, format!("({name}{parts})")))
            })
            .collect();
        for (i, frame) in self.frames().into_iter().enumerate() {
            let placement = Self::placement(frame)?;
            let variable = spec.frames[i].variable.map(|variable| spec.variables[variable].name.as_str());
            // With `origin` the joint axis moves implicitly, so that there is no expression to
            // edit.
            if placement.key == "origin" && substitutions.iter().any(|(name, _)| variable == Some(name)) {
                return None;
            }
            self.each_text(placement.value, &mut |span| {
                let old = &self.text[span.clone()];
                let new = replace_names(old, &substitutions);
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

/// Splits a product such as `Tx(30 mm) Rz(q1)` into names and amounts.
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

/// Negates an amount. A number stays a number, so that it keeps its implied unit.
fn negative(amount: &str) -> String {
    match amount.parse::<f64>() {
        Ok(0.0) => "0".to_owned(),
        Ok(_) => amount
            .strip_prefix('-')
            .map_or_else(|| format!("-{}", amount.trim_start_matches('+')), str::to_owned),
        Err(_) => format!("-({amount})"),
    }
}

/// Replaces names that occur as whole words.
fn replace_names(text: &str, substitutions: &[(&str, String)]) -> String {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let mut new = String::new();
    let mut rest = text;
    while let Some(begin) = rest.find(is_word) {
        let end = rest[begin..].find(|c| !is_word(c)).map_or(rest.len(), |end| begin + end);
        let word = &rest[begin..end];
        new += &rest[..begin];
        new += substitutions
            .iter()
            .find(|(name, _)| *name == word)
            .map_or(word, |(_, substitutions)| substitutions);
        rest = &rest[end..];
    }
    new + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_are_inverted() {
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
        let substitutions = [("q3", "(q3 + q2)".to_owned())];
        assert_eq!(
            replace_names("\"q3 - q31*q2 + 2*q3\"", &substitutions),
            "\"(q3 + q2) - q31*q2 + 2*(q3 + q2)\""
        );
    }
}
