//! Rewrites the text of a spec according to an interpretation, and keeps everything else in it.
//!
//! The other convention is the other key. An inverted placement is the product of its inverted
//! factors in reverse order. A coupled joint, and the zeros of a coupled machine, are inserted at
//! the variable: with column values c, `q3` becomes `(q3 + q2 + zero)`.

use std::{ops::Range, path::Path};

use abbe::VariableKind;
use abbe_spec::{Item, Spec, edit::Edits, edit::write::quoted};

use super::job::Report;
use crate::interpretations::{Change, words};
use abbe_study::{Result, number::digits};

/// Keys that place a frame or the tool.
const PLACEMENT_KEYS: [&str; 5] = ["transform", "matrix", "dh", "mdh", "origin"];

/// Significant digits of a fitted zero; data determine fewer.
const DIGITS: usize = 8;

impl Report {
    /// Returns the text of the spec according to the first interpretation. Returns `None` if that
    /// changes nothing in the spec, or cannot be expressed in its text. `path` is the file name of
    /// the result; paths of table files are resolved from there.
    pub fn corrected(&self, spec: &Spec, text: &str, path: &str) -> Result<Option<String>> {
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
            change => new = File::edited(&new, |file| file.change(change, spec))?,
        }
    }
    if !substitutions.is_empty() {
        new = File::edited(&new, |file| file.substitute(&substitutions, spec))?;
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

fn zero(offset: f64, joint: usize, spec: &Spec) -> String {
    let sign = if offset < 0.0 { '-' } else { '+' };
    let kind = spec.variables[joint].kind;
    let (value, unit) = kind.either((offset.to_degrees(), "deg"), (offset, spec.length.symbol()));
    format!(" {sign} {} {unit}", digits(value.abs(), DIGITS))
}

/// Returns the placement of a frame or the tool: its key and value.
fn placement<'t>(table: &Item<'t>) -> Option<Item<'t>> {
    table.as_table()?.items().find(|item| PLACEMENT_KEYS.contains(&item.key.as_str()))
}

/// Returns the location of a key and its value.
fn whole(placement: &Item<'_>) -> Range<usize> {
    placement.key_span.start..placement.span().end
}

struct File<'t, 'e, 'x> {
    text: &'t str,
    frames: Vec<Item<'t>>,
    tool: Option<Item<'t>>,
    edits: &'e mut Edits<'x>,
}

impl File<'_, '_, '_> {
    /// Edits a text; `None` if it cannot express the edits.
    fn edited(text: &str, edit: impl FnOnce(&mut File<'_, '_, '_>) -> Option<()>) -> Option<String> {
        Edits::apply(text, |root, edits| {
            let frames = root.get("frame").map(|item| item.list()).unwrap_or_default();
            edit(&mut File { text, frames, tool: root.get("tool"), edits })
        })
    }

    fn tool(&self) -> Option<Item<'_>> {
        placement(self.tool.as_ref()?)
    }

    /// Returns the placement of the base, if exactly one frame precedes the first joint.
    fn base(&self, spec: &Spec) -> Option<Item<'_>> {
        let moving = spec.variables_of_transforms();
        let fixed = moving.iter().take_while(|variables| variables.is_empty()).count();
        (fixed == 1).then(|| placement(&self.frames[0]))?
    }

    /// Changes base, tool or convention; `None` if the text cannot express it.
    fn change(&mut self, change: &Change, spec: &Spec) -> Option<()> {
        let of = match change {
            Change::Convention => {
                self.other_convention();
                return Some(());
            }
            Change::EndsExchanged => {
                let ends = [self.base(spec)?, self.tool()?].map(|end| whole(&end));
                let [base, tool] = ends.clone().map(|span| &self.text[span]);
                ends.into_iter().zip([tool, base]).for_each(|(span, text)| self.edits.replace(span, text));
                return Some(());
            }
            Change::ToolInverted | Change::ToolLeftOut => self.tool()?,
            Change::BaseInverted | Change::BaseLeftOut => self.base(spec)?,
            _ => return None,
        };
        let new = match change {
            Change::ToolInverted | Change::BaseInverted => self.inverse(&of)?,
            _ => "origin = { xyz = [0, 0, 0] }".to_owned(),
        };
        self.edits.replace(whole(&of), new);
        Some(())
    }

    fn other_convention(&mut self) {
        for placement in self.frames.iter().filter_map(placement) {
            match placement.key.as_str() {
                "dh" => self.edits.replace(placement.key_span, "mdh"),
                "mdh" => self.edits.replace(placement.key_span, "dh"),
                _ => {}
            }
        }
    }

    /// Returns the inverse of a placement: the inverted factors in reverse order.
    fn inverse(&self, placement: &Item<'_>) -> Option<String> {
        let factors: Vec<(String, String)> = match placement.key.as_str() {
            "transform" => factors(placement.text()?)?,
            "dh" => self.dh_factors(placement, ["theta", "d", "a", "alpha"])?,
            "mdh" => self.dh_factors(placement, ["alpha", "a", "theta", "d"])?,
            "origin" => self.origin(placement)?,
            _ => return None,
        };
        let inverse: Vec<_> = factors.into_iter().rev().map(|(name, one)| (name, negative(&one))).collect();
        Some(format!("transform = {}", quoted(&product(&inverse))))
    }

    /// Returns Denavit-Hartenberg parameters as factors, in the order of the convention.
    fn dh_factors(&self, item: &Item<'_>, keys: [&str; 4]) -> Option<Vec<(String, String)>> {
        let factor = |key: &str| {
            let name = match key {
                "theta" => "Rz",
                "d" => "Tz",
                "a" => "Tx",
                _ => "Rx",
            };
            Some((name.to_owned(), self.amount(&item.as_table()?.get(key)?)))
        };
        keys.into_iter().map(factor).collect()
    }

    /// Returns a URDF origin as factors: T(xyz) Rz(yaw) Ry(pitch) Rx(roll).
    fn origin(&self, item: &Item<'_>) -> Option<Vec<(String, String)>> {
        let table = item.as_table()?;
        let three = |key: &str, names: [&str; 3]| -> Vec<(String, String)> {
            let values = table.get(key).map(|values| values.list()).unwrap_or_default();
            names
                .into_iter()
                .zip(&values)
                .map(|(name, value)| (name.to_owned(), self.amount(value)))
                .collect()
        };
        let mut turns = three("rpy", ["Rx", "Ry", "Rz"]);
        turns.reverse();
        Some([three("xyz", ["Tx", "Ty", "Tz"]), turns].concat())
    }

    /// Returns the motion of a joint by an amount in parentheses, as factors: along or about
    /// `axis`, which is x if none is given.
    ///
    /// With `u = Rz(α) Ry(β) e_x`, the motion about u is `Rz(α) Ry(β) Rx(q) Ry(−β) Rz(−α)`.
    fn motion(
        &self,
        kind: VariableKind,
        axis: Option<&Item<'_>>,
        amount: &str,
    ) -> Option<Vec<(String, String)>> {
        let letter = if kind == VariableKind::Revolute { "R" } else { "T" };
        let axis = match axis {
            None => vec![1.0, 0.0, 0.0],
            Some(axis) => {
                axis.list().iter().map(|value| self.amount(value).parse().ok()).collect::<Option<_>>()?
            }
        };
        let [x, y, z]: [f64; 3] = axis.try_into().ok()?;
        let factor = |letter: &str, axis: &str, amount: String| (format!("{letter}{axis}"), amount);
        let along = |axis: &str, value: f64| {
            factor(letter, axis, if value < 0.0 { format!("-{amount}") } else { amount.to_owned() })
        };
        let turn = |axis: &str, angle: f64| factor("R", axis, format!("{} deg", angle.to_degrees()));
        let (alpha, beta) = (y.atan2(x), -z.atan2(x.hypot(y)));
        Some(match [x == 0.0, y == 0.0, z == 0.0] {
            [false, true, true] => vec![along("x", x)],
            [true, false, true] => vec![along("y", y)],
            [true, true, false] => vec![along("z", z)],
            _ => {
                let there = [turn("z", alpha), turn("y", beta), along("x", 1.0)];
                [&there[..], &[turn("y", -beta), turn("z", -alpha)]].concat()
            }
        })
    }

    /// Returns the text of a number or expression.
    fn amount(&self, value: &Item<'_>) -> String {
        value.text().unwrap_or(&self.text[value.span()]).to_owned()
    }

    /// Replaces each variable by its corrected expression, in the placements of all frames.
    fn substitute(&mut self, added: &[(usize, String)], spec: &Spec) -> Option<()> {
        let substitutions: Vec<(&str, String)> = (0..spec.variables.len())
            .filter_map(|i| {
                let parts: String =
                    added.iter().filter(|(joint, _)| *joint == i).map(|(_, part)| part.as_str()).collect();
                let name = spec.variables[i].name.as_str();
                (!parts.is_empty()).then(|| (name, format!("({name}{parts})")))
            })
            .collect();
        for (i, frame) in self.frames.iter().enumerate() {
            let placement = placement(frame)?;
            let own = spec.frames[i].variable.map(|variable| &spec.variables[variable]);
            let substitution = own.and_then(|own| substitutions.iter().find(|(name, _)| *name == own.name));
            // With `origin` the motion follows from `axis`: an expression needs a product.
            if let (Some(own), Some((_, amount)), "origin") = (own, substitution, placement.key.as_str()) {
                let axis = frame.as_table()?.get("axis");
                let mut factors = self.origin(&placement)?;
                factors.retain(|(_, amount)| amount.parse() != Ok(0.0));
                factors.extend(self.motion(own.kind, axis.as_ref(), amount)?);
                self.edits.replace(whole(&placement), format!("transform = {}", quoted(&product(&factors))));
                if let Some(axis) = axis {
                    let span = whole(&axis);
                    let above = self.text[..span.start].trim_end();
                    let start = above.strip_suffix(',').unwrap_or(above).len();
                    self.edits.replace(start..span.end, "");
                }
                continue;
            }
            for span in strings(&placement) {
                self.edits.replace(span.clone(), replace_names(&self.text[span], &substitutions));
            }
        }
        Some(())
    }
}

/// Returns the locations of all strings in a value.
fn strings(item: &Item<'_>) -> Vec<Range<usize>> {
    let entries = item.as_table().into_iter().flat_map(|table| table.items()).chain(item.list());
    let own = item.is_text().then(|| item.span());
    own.into_iter().chain(entries.flat_map(|entry| strings(&entry))).collect()
}

/// Writes factors as a product.
fn product(factors: &[(String, String)]) -> String {
    factors.iter().map(|(name, amount)| format!("{name}({amount})")).collect::<Vec<_>>().join(" ")
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
mod tests;
