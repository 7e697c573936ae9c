//! `[fitted]`: the ranges of joints and inputs on which the errors of an identified machine were fitted.

use super::declarations::Declarations;
use super::{Spec, VariableKind};
use crate::document::{Document, Section};
use crate::expr::{Dimension, Symbol, find_name};

/// A joint variable or an input, and the range on which errors were fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fitted {
    /// Which variable or input.
    pub symbol: Symbol,
    /// Lower and upper end.
    pub range: [f64; 2],
}

impl Fitted {
    /// Whether its value is outside the range by more than the last digit to which that is written.
    pub fn is_outside(&self, q: &[f64], u: &[f64]) -> bool {
        let value = match self.symbol {
            Symbol::Variable(i) => q.get(i),
            Symbol::Input(i) => u.get(i),
            _ => None,
        };
        value.is_some_and(|value| !self.contains(*value))
    }

    /// Whether a value is within the range, or beyond it by no more than its last written digit.
    pub fn contains(&self, value: f64) -> bool {
        let [lower, upper] = self.range;
        let digit = 1e-6 * lower.abs().max(upper.abs());
        (lower - digit..=upper + digit).contains(&value)
    }

    /// The name of the variable or input.
    pub fn name<'s>(&self, spec: &'s Spec) -> &'s str {
        match self.symbol {
            Symbol::Variable(i) => &spec.variables[i].name,
            Symbol::Input(i) => &spec.inputs[i].name,
            _ => "",
        }
    }
}

/// Reads the table, if there is one.
pub(super) fn read_fitted(
    root: &Section<'_>,
    declarations: &Declarations,
    document: &mut Document,
) -> Vec<Fitted> {
    let section = root.get("fitted").and_then(|item| document.section(&item));
    let variables = declarations.variables.iter().map(|variable| match variable.kind {
        VariableKind::Revolute => (variable.name.as_str(), Dimension::NONE),
        VariableKind::Prismatic => (variable.name.as_str(), Dimension::LENGTH),
    });
    let inputs = declarations.inputs.iter().map(|input| (input.name.as_str(), input.dimension));
    let (names, dimensions): (Vec<&str>, Vec<Dimension>) = variables.chain(inputs).unzip();
    let mut fitted = Vec::new();
    for item in section.iter().flat_map(Section::items) {
        let place = item.key_span.clone();
        let Some(found) = find_name(document, place, &item.key, &names, "variable or input") else {
            continue;
        };
        let Some(range) = declarations.interval(&item, dimensions[found], document) else { continue };
        let symbol = match found.checked_sub(declarations.variables.len()) {
            None => Symbol::Variable(found),
            Some(input) => Symbol::Input(input),
        };
        fitted.push(Fitted { symbol, range });
    }
    fitted
}
