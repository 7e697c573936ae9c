//! Lengths given as options.

use abbe_spec::Spec;
use abbe_spec::document::Document;
use abbe_spec::expr::Dimension;
use abbe_spec::value::parse_value;

use crate::failure::Failure;

/// Parses a length that must not be negative, in the length unit of the spec.
pub(crate) fn length(option: &str, text: &str, spec: &Spec) -> Result<f64, Failure> {
    let mut document = Document::new(option, text);
    let value = parse_value(&mut document, 0..text.len(), spec.length, Dimension::LENGTH, "this");
    match document.finish(value)? {
        value if value >= 0.0 => Ok(value),
        _ => Err(Failure::new(option, "this must not be negative").help(format!("write `{option} 0.04mm`"))),
    }
}
