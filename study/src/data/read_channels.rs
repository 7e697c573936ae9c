//! Reads where the values of joints and inputs come from.

use abbe_codegen::diagnostic::Diagnostic;
use abbe_codegen::document::{Document, Item, Section};
use abbe_codegen::expr::{Dimension, find_name};
use abbe_codegen::spec::{Spec, VariableKind};

use super::column::Channel;
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
                "add `{name} = {{ column = \"…\", unit = \"…\" }}`, or `{name} = {{ value = 0 }}` if it stays"
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
            Some(item) => channel(&item, document, spec, input.dimension),
            None => Some(Channel::Fixed(input.value)),
        });
    let channels: Vec<Option<Channel>> = channels.collect();
    channels.into_iter().collect()
}

/// `{ column = "…", unit = "…", sign = -1 }` or `{ value = … }`.
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
                    Diagnostic::new(item.span(), "a sign is 1 or -1").help("a factor belongs into `unit`"),
                );
                return None;
            }
        },
        None => 1.0,
    };
    Some(Channel::Column(column?, factor? * sign))
}
