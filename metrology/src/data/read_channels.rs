//! Reader of `[joints]` and `[inputs]`.
//!
//! Readers of constants, columns and units.

use abbe::{LengthUnit, VariableKind};
use abbe_spec::expr::{Dimension, LARGEST};
use abbe_spec::value::{find_name, parse_value, read_name};
use abbe_spec::{Diagnostic, Document, Input, Item, Section, Spec};

use super::{Channel, Column, FromRows, Scale, UNKNOWN, keys};

pub(super) fn joints(root: &Section<'_>, spec: &Spec) -> Option<Vec<Channel>> {
    let section = root.required("joints").and_then(|item| item.section())?;
    let names: Vec<&str> = spec.variables.iter().map(|variable| variable.name.as_str()).collect();
    for item in section.items() {
        find_name(root.document, item.key_span.clone(), &item.key, &names, "variable");
    }
    let channels = spec.variables.iter().map(|variable| {
        let dimension = variable.kind.either(Dimension::NONE, Dimension::LENGTH);
        let Some(item) = section.get(&variable.name) else {
            let name = &variable.name;
            let message = format!("`{name}` has no column");
            let help = format!(
                "add `{name} = {{ column = \"…\", unit = \"…\" }}`, or `{name} = {{ value = 0 }}` \
                 if it is constant"
            );
            return root.document.refuse(section.span.clone(), message, help);
        };
        channel(&item, dimension)
    });
    let channels: Vec<Option<Channel>> = channels.collect();
    channels.into_iter().collect()
}

pub(super) fn inputs(root: &Section<'_>, spec: &Spec) -> Option<Vec<Channel>> {
    let section = root.get("inputs").map_or(Some(None), |item| item.section().map(Some))?;
    let names: Vec<&str> = spec.inputs.iter().map(|input| input.name.as_str()).collect();
    for item in section.iter().flat_map(Section::items) {
        find_name(root.document, item.key_span.clone(), &item.key, &names, "input");
    }
    let channels =
        spec.inputs.iter().map(|input| match section.as_ref().and_then(|section| section.get(&input.name)) {
            Some(item) => match from_rows(&item) {
                Some(section) => read_from_rows(&section, spec, input).map(Channel::FromRows),
                None => channel(&item, input.dimension),
            },
            None => Some(Channel::Fixed(input.value)),
        });
    let channels: Vec<Option<Channel>> = channels.collect();
    channels.into_iter().collect()
}

/// Returns the table of an input that is computed from the rows, if it is one.
fn from_rows<'d>(item: &Item<'d>) -> Option<Section<'d>> {
    let section = item.is_table().then(|| item.section()).flatten()?;
    keys::FROM_ROWS.names().any(|key| section.get(key).is_some()).then_some(section)
}

/// Reads `{ approach = "q1" }` or `{ gravity_moment = "q2", frame = "wrist 1" }`.
fn read_from_rows(section: &Section<'_>, spec: &Spec, input: &Input) -> Option<FromRows> {
    let mut section = section.clone();
    section.name = format!("`{}`", input.name);
    section.check_keys(&[&keys::FROM_ROWS]);
    let variable = |item: &Item<'_>| {
        let names = spec.variables.iter().map(|variable| variable.name.as_str());
        read_name(item, names, "variable")
    };
    let (approach, moment, frame) =
        (section.get("approach"), section.get("gravity_moment"), section.get("frame"));
    let is_number = input.dimension == Dimension::NONE;
    match (approach, moment, frame) {
        (Some(_), None, None) | (None, Some(_), _) if !is_number => {
            let message = format!("`{}` is {}; it must be -1, 0 or 1", input.name, input.dimension);
            let help = "this needs an input that is a pure number: give it a `column` or a `value`";
            section.refuse(message, help)
        }
        (Some(item), None, None) => variable(&item).map(FromRows::Approach),
        (None, Some(item), frame) => {
            let joint = variable(&item)?;
            if spec.variables[joint].kind != VariableKind::Revolute {
                let message =
                    format!("`{}` is not revolute, so no moment acts about it", spec.variables[joint].name);
                return item.refuse(message, "name a revolute joint");
            }
            let Some(frame) = frame else {
                return Some(FromRows::GravityMoment { variable: joint, at: spec.frames.len() });
            };
            let names = spec.frames.iter().map(|frame| frame.name.as_str());
            let at = read_name(&frame, names, "frame")?;
            if at < spec.variables[joint].frame {
                let message = format!(
                    "`{}` does not move the frame `{}`",
                    spec.variables[joint].name, spec.frames[at].name
                );
                let help = "name the frame of the joint or a later one, or omit `frame` for the \
                    tool point";
                return frame.refuse(message, help);
            }
            Some(FromRows::GravityMoment { variable: joint, at })
        }
        _ => {
            let help =
                "write `{ approach = \"JOINT\" }` or `{ gravity_moment = \"JOINT\", frame = \"FRAME\" }`";
            section.refuse(format!("`{}` is not defined by a valid rule", input.name), help)
        }
    }
}

/// Reads `{ column = "…", unit = "…", sign = -1, zero = "…" }` or `{ value = … }`.
fn channel(item: &Item<'_>, dimension: Dimension) -> Option<Channel> {
    let section = item.table(format!("`{}`", item.key), &[&keys::CHANNEL])?;
    if let Some(value) = section.get("value") {
        return value.quantity(dimension).map(Channel::Fixed);
    }
    let column = section.required("column").and_then(|item| column(&item));
    let factor = unit(&section, dimension);
    let sign = match section.get("sign") {
        Some(item) => match item.quantity(Dimension::NONE)? {
            sign if sign.abs() == 1.0 => sign,
            _ => {
                return item.refuse("a sign must be 1 or -1", "include any other factor in `unit`");
            }
        },
        None => 1.0,
    };
    let zero = section.get("zero").map_or(Some(0.0), |item| item.quantity(dimension))?;
    Some(Channel::Column(column?, Scale { one: factor? * sign, zero }))
}

/// Reads a positive number whose square and reciprocal are finite.
pub(super) fn positive(item: &Item<'_>, dimension: Dimension) -> Option<f64> {
    let value = item.quantity(dimension)?;
    if value >= 1.0 / LARGEST {
        return Some(value);
    }
    let what = if value > 0.0 { "is too small to compute with" } else { "must be positive" };
    let help = "write one standard deviation, from the data sheet of the instrument";
    item.refuse(format!("`{}` {what}", item.key), help)
}

/// Returns whether a number is to be estimated from the data.
pub(super) fn is_unknown(item: &Item<'_>) -> bool {
    item.is_text() && item.string().as_deref() == Some(UNKNOWN[0].0)
}

/// Reads a standard deviation; `Some(None)` if it is to be estimated from the data.
pub(super) fn deviation(item: &Item<'_>, dimension: Dimension) -> Option<Option<f64>> {
    if is_unknown(item) { Some(None) } else { positive(item, dimension).map(Some) }
}

/// Returns the initial value of a standard deviation that is estimated: 10 µm or 10 µrad.
pub(super) fn initial_deviation(is_angle: bool, length: LengthUnit) -> f64 {
    if is_angle { 1e-5 } else { 1e-5 / length.in_metres() }
}

pub(super) fn column(item: &Item<'_>) -> Option<Column> {
    item.string().map(|name| Column { name: name.trim().to_owned(), span: Some(item.span()) })
}

pub(super) fn columns<const N: usize>(section: &Section<'_>, key: &str) -> Option<[Column; N]> {
    let item = section.required(key)?;
    let items: [Item<'_>; N] = item.entries(&format!("{N} names of columns"))?;
    let columns: Vec<Column> = items.iter().filter_map(|item| column(item)).collect();
    columns.try_into().ok()
}

/// Words for one step of an encoder or a motor, whose size only the user knows.
const COUNTS: [&str; 8] = ["count", "cnt", "inc", "increment", "pulse", "step", "tick", "digit"];

/// Reads `unit`, a text such as "deg" or "360 deg/4096", as a factor to coherent units.
pub(super) fn unit(section: &Section<'_>, dimension: Dimension) -> Option<f64> {
    let item = section.required("unit")?;
    let name = item.string()?;
    if name.trim().is_empty() {
        let help = match dimension {
            Dimension::NONE => "write `rad` or `deg`, or `1` for a pure number",
            _ => "write the unit of the numbers in the file: `mm`, `m`, `kg` …",
        };
        return item.refuse("this unit is empty", help);
    }
    if name.trim() == "1" && dimension == Dimension::NONE {
        return Some(1.0);
    }
    let is_size = name.trim_start().starts_with(|c: char| c.is_ascii_digit() || c == '.');
    let text = if is_size { name.clone() } else { format!("1 {name}") };
    let size = match dimension {
        Dimension::LENGTH => "write the size of one: `unit = \"5 mm/2000\"`",
        _ => "write the size of one: `unit = \"360 deg/4096\"`",
    };
    if COUNTS.contains(&name.trim().to_lowercase().trim_end_matches('s')) {
        return item.refuse(format!("the size of `{}` is unknown", name.trim().escape_debug()), size);
    }
    let line = Document::new("", text.as_str());
    let what = format!("the unit `{}`", name.escape_debug());
    let factor = parse_value(&line, 0..text.trim_end().len(), section.document.length, dimension, &what);
    if let (None, Some(found)) = (factor, line.found.into_inner().into_iter().next()) {
        let help = found.help.unwrap_or_else(|| "write `mm`, `deg`, `kg` …".to_owned());
        section.document.mistake(Diagnostic::new(item.span(), found.message).help(help));
    }
    if factor.is_some_and(|factor| factor <= 0.0) {
        return item.refuse("the size of a unit must be positive", size);
    }
    factor
}
