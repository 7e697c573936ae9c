//! Heads of functions, and comments.

use crate::print::{LINE, Writer, width};

/// Macro of the sizes of arrays that must not overlap others.
pub(super) const RESTRICT: &str = "ABBE_RESTRICT";

/// Macro of the sizes of arrays that may overlap others.
pub(super) const SIZE: &str = "ABBE_SIZE";

/// Returns a head with its arguments, on several lines if it is long.
pub(super) fn broken(name: &str, arguments: &[String]) -> String {
    let line = format!("{name}({})", arguments.join(", "));
    if width(&line) < LINE { line } else { format!("{name}(\n    {})", arguments.join(",\n    ")) }
}

/// Prints a block comment.
pub(super) fn comment(writer: &mut Writer, text: &str) {
    writer.lines("/*");
    writer.documentation(text);
    writer.lines(" */");
}
