//! `[fitted]`: ranges of joints and inputs over which the errors of an identified machine were
//! fitted.

use abbe_core::VariableKind;

use super::declarations::Declarations;
use crate::document::Section;
use crate::expr::{Dimension, Symbol};
use crate::manipulator::Fitted;
use crate::value::find_name;

/// Reads the table, if there is one.
pub(super) fn read_fitted(root: &Section<'_>, declarations: &Declarations) -> Vec<Fitted> {
    let section = root.get("fitted").and_then(|item| item.section());
    let dimension = |kind: VariableKind| kind.either(Dimension::NONE, Dimension::LENGTH);
    let variables = declarations.variables.iter();
    let variables = variables.map(|variable| (variable.name.as_str(), dimension(variable.kind)));
    let inputs = declarations.inputs.iter().map(|input| (input.name.as_str(), input.dimension));
    let (names, dimensions): (Vec<&str>, Vec<Dimension>) = variables.chain(inputs).unzip();
    let mut fitted = Vec::new();
    for item in section.iter().flat_map(Section::items) {
        let place = item.key_span.clone();
        let Some(found) = find_name(root.document, place, &item.key, &names, "variable or input") else {
            continue;
        };
        let Some(range) = declarations.interval(&item, dimensions[found]) else { continue };
        let symbol = match found.checked_sub(declarations.variables.len()) {
            None => Symbol::Variable(found),
            Some(input) => Symbol::Input(input),
        };
        fitted.push(Fitted { symbol, range });
    }
    fitted
}
