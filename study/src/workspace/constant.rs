//! Reads constants with units and converts them to the coherent units of the spec.

use abbe_spec::diagnostic::Diagnostic;
use abbe_spec::document::{Document, Item};
use abbe_spec::expr::{Allowed, Dimension, Entry, Scope};

/// Reads a constant of a dimension.
pub fn constant(item: &Item<'_>, document: &mut Document, dimension: Dimension, what: &str) -> Option<f64> {
    let scope = Scope::new(document.length);
    let entry = Entry { dimension: Some(dimension), what, names: Allowed::Nothing };
    document.constant(item, &scope, entry).map(|(value, _)| value)
}

/// Reads a length above zero.
pub fn positive_length(item: &Item<'_>, document: &mut Document) -> Option<f64> {
    positive(item, Dimension::LENGTH, document)
}

/// Reads a quantity above zero.
pub fn positive(item: &Item<'_>, dimension: Dimension, document: &mut Document) -> Option<f64> {
    let value = document.quantity(item, dimension)?;
    if value > 0.0 {
        return Some(value);
    }
    let mistake = Diagnostic::new(item.span(), format!("`{}` must be positive", item.key));
    document.fail(mistake.label("zero or negative").help("remove it if there is none"))
}

/// Reads a whole number from 1 to `largest`.
pub fn count(item: &Item<'_>, largest: usize, document: &mut Document) -> Option<usize> {
    whole(item, [1, largest], document)
}

/// Reads a whole number within limits.
pub fn whole(item: &Item<'_>, [least, largest]: [usize; 2], document: &mut Document) -> Option<usize> {
    let value = document.quantity(item, Dimension::NONE)?;
    if value.fract() == 0.0 && (least as f64..=largest as f64).contains(&value) {
        return Some(value as usize);
    }
    let message = format!("`{}` must be an integer from {least} to {largest}", item.key);
    let mistake = Diagnostic::new(item.span(), message).label("not such an integer");
    document.fail(mistake.help("write a number such as 100"))
}
