//! Numbers that options give.

use abbe_spec::Spec;
use abbe_spec::document::Document;
use abbe_spec::expr::Dimension;
use abbe_spec::value::parse_value;

use crate::failure::Failure;

/// A length that an option gives; it is not negative.
pub(crate) fn length(option: &str, text: &str, spec: &Spec) -> Result<f64, Failure> {
    let mut document = Document::new(option, text);
    let value = parse_value(&mut document, 0..text.len(), spec.length, Dimension::LENGTH, "this");
    match document.finish(value)? {
        value if value >= 0.0 => Ok(value),
        _ => Err(Failure::of(option, "this may not be negative").help(format!("write `{option} 0.04mm`"))),
    }
}
