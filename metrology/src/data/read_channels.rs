//! Reader of `[joints]` and `[inputs]`.

use abbe::VariableKind;
use abbe_spec::diagnostic::Diagnostic;
use abbe_spec::document::{Document, Item, Section};
use abbe_spec::expr::Dimension;
use abbe_spec::value::find_name;
use abbe_spec::{Input, Spec};

use super::column::{Channel, Scale};
use super::from_rows::FromRows;
use super::keys;
use super::read_values::{column, constant, unit};

pub(super) fn joints(root: &Section<'_>, document: &mut Document, spec: &Spec) -> Option<Vec<Channel>> {
    let section = root.required("joints", document).and_then(|item| document.section(&item))?;
    let names: Vec<&str> = spec.variables.iter().map(|variable| variable.name.as_str()).collect();
    for item in section.items() {
        find_name(document, item.key_span.clone(), &item.key, &names, "variable");
    }
    let channels = spec.variables.iter().map(|variable| {
        let dimension = match variable.kind {
            VariableKind::Revolute => Dimension::NONE,
            VariableKind::Prismatic => Dimension::LENGTH,
        };
        let Some(item) = section.get(&variable.name) else {
            let name = &variable.name;
            let message = format!("`{name}` has no column");
            let help = format!(
                "add `{name} = {{ column = \"…\", unit = \"…\" }}`, or `{name} = {{ value = 0 }}` \
                 if it is constant"
            );
            document.mistake(Diagnostic::new(section.span.clone(), message).help(help));
            return None;
        };
        channel(&item, document, spec, dimension)
    });
    let channels: Vec<Option<Channel>> = channels.collect();
    channels.into_iter().collect()
}

pub(super) fn inputs(root: &Section<'_>, document: &mut Document, spec: &Spec) -> Option<Vec<Channel>> {
    let section = match root.get("inputs") {
        Some(item) => Some(document.section(&item)?),
        None => None,
    };
    let names: Vec<&str> = spec.inputs.iter().map(|input| input.name.as_str()).collect();
    for item in section.iter().flat_map(Section::items) {
        find_name(document, item.key_span.clone(), &item.key, &names, "input");
    }
    let channels =
        spec.inputs.iter().map(|input| match section.as_ref().and_then(|section| section.get(&input.name)) {
            Some(item) => match from_rows(&item, document) {
                Some(section) => read_from_rows(&section, document, spec, input).map(Channel::FromRows),
                None => channel(&item, document, spec, input.dimension),
            },
            None => Some(Channel::Fixed(input.value)),
        });
    let channels: Vec<Option<Channel>> = channels.collect();
    channels.into_iter().collect()
}

/// Returns the table of an input that is computed from the rows, if it is one.
fn from_rows<'d>(item: &Item<'d>, document: &mut Document) -> Option<Section<'d>> {
    let section = item.is_table().then(|| document.section(item)).flatten()?;
    keys::FROM_ROWS.names().any(|key| section.get(key).is_some()).then_some(section)
}

/// Reads `{ approach = "q1" }` or `{ gravity_moment = "q2", frame = "wrist 1" }`.
fn read_from_rows(
    section: &Section<'_>,
    document: &mut Document,
    spec: &Spec,
    input: &Input,
) -> Option<FromRows> {
    let mut section = section.clone();
    section.name = format!("`{}`", input.name);
    section.check_keys(&[&keys::FROM_ROWS], document);
    let variable = |item: &Item<'_>, document: &mut Document| {
        let names: Vec<&str> = spec.variables.iter().map(|variable| variable.name.as_str()).collect();
        let name = document.string(item)?;
        find_name(document, item.span(), &name, &names, "variable")
    };
    let (approach, moment, frame) =
        (section.get("approach"), section.get("gravity_moment"), section.get("frame"));
    let is_number = input.dimension == Dimension::NONE;
    match (approach, moment, frame) {
        (Some(_), None, None) | (None, Some(_), _) if !is_number => {
            let message = format!("`{}` is {}; it must be -1, 0 or 1", input.name, input.dimension);
            let help = "this needs an input that is a pure number: give it a `column` or a `value`";
            document.mistake(Diagnostic::new(section.span.clone(), message).help(help));
            None
        }
        (Some(item), None, None) => variable(&item, document).map(FromRows::Approach),
        (None, Some(item), frame) => {
            let joint = variable(&item, document)?;
            if spec.variables[joint].kind != VariableKind::Revolute {
                let message =
                    format!("`{}` is not revolute, so no moment acts about it", spec.variables[joint].name);
                document.mistake(Diagnostic::new(item.span(), message).help("name a revolute joint"));
                return None;
            }
            let Some(frame) = frame else {
                return Some(FromRows::GravityMoment { variable: joint, at: spec.frames.len() });
            };
            let names: Vec<&str> = spec.frames.iter().map(|frame| frame.name.as_str()).collect();
            let name = document.string(&frame)?;
            let at = find_name(document, frame.span(), &name, &names, "frame")?;
            if at < spec.variables[joint].frame {
                let message = format!("`{}` does not move the frame `{name}`", spec.variables[joint].name);
                let help = "name the frame of the joint or a later one, or omit `frame` for the \
                    tool point";
                document.mistake(Diagnostic::new(frame.span(), message).help(help));
                return None;
            }
            Some(FromRows::GravityMoment { variable: joint, at })
        }
        _ => {
            let help =
                "write `{ approach = \"JOINT\" }` or `{ gravity_moment = \"JOINT\", frame = \"FRAME\" }`";
            let message = format!("`{}` is not defined by a valid rule", input.name);
            document.mistake(Diagnostic::new(section.span.clone(), message).help(help));
            None
        }
    }
}

/// Reads `{ column = "…", unit = "…", sign = -1, zero = "…" }` or `{ value = … }`.
fn channel(item: &Item<'_>, document: &mut Document, spec: &Spec, dimension: Dimension) -> Option<Channel> {
    let mut section = document.section(item)?;
    section.name = format!("`{}`", item.key);
    section.check_keys(&[&keys::CHANNEL], document);
    if let Some(value) = section.get("value") {
        return constant(&value, document, spec, dimension).map(Channel::Fixed);
    }
    let column = section.required("column", document).and_then(|item| column(&item, document));
    let factor = unit(&section, document, spec, dimension);
    let sign = match section.get("sign") {
        Some(item) => match constant(&item, document, spec, Dimension::NONE)? {
            sign if sign.abs() == 1.0 => sign,
            _ => {
                document.mistake(
                    Diagnostic::new(item.span(), "a sign must be 1 or -1")
                        .help("include any other factor in `unit`"),
                );
                return None;
            }
        },
        None => 1.0,
    };
    let zero = match section.get("zero") {
        Some(item) => constant(&item, document, spec, dimension)?,
        None => 0.0,
    };
    Some(Channel::Column(column?, Scale { one: factor? * sign, zero }))
}
