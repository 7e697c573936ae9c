//! Reads constants with units and converts them to the coherent units of the spec.

use abbe_spec::diagnostic::Diagnostic;
use abbe_spec::document::Item;
use abbe_spec::expr::{Dimension, Scope};

/// Reads a constant of a dimension.
pub fn constant(item: &Item<'_>, dimension: Dimension, what: &str) -> Option<f64> {
    item.amount(&Scope::new(item.document.length), dimension, what)
}

/// Reads a length above zero.
pub fn positive_length(item: &Item<'_>) -> Option<f64> {
    positive(item, Dimension::LENGTH)
}

/// Reads a quantity above zero.
pub fn positive(item: &Item<'_>, dimension: Dimension) -> Option<f64> {
    let value = item.quantity(dimension)?;
    if value > 0.0 {
        return Some(value);
    }
    let mistake = Diagnostic::new(item.span(), format!("`{}` must be positive", item.key));
    item.document.fail(mistake.label("zero or negative").help("remove it if there is none"))
}

/// Reads a whole number from 1 to `largest`.
pub fn count(item: &Item<'_>, largest: usize) -> Option<usize> {
    whole(item, [1, largest])
}

/// Reads a whole number within limits.
pub fn whole(item: &Item<'_>, [least, largest]: [usize; 2]) -> Option<usize> {
    let value = item.quantity(Dimension::NONE)?;
    if value.fract() == 0.0 && (least as f64..=largest as f64).contains(&value) {
        return Some(value as usize);
    }
    let message = format!("`{}` must be an integer from {least} to {largest}", item.key);
    let mistake = Diagnostic::new(item.span(), message).label("not such an integer");
    item.document.fail(mistake.help("write a number such as 100"))
}
