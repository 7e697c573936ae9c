//! Text in HTML and SVG.

use abbe_spec::visible::visible;

/// Escapes a text for HTML and SVG. Characters that alter the text around them, or that XML cannot
/// contain, are shown as `\uXXXX`.
pub(crate) fn escaped(text: &str) -> String {
    let text = visible(text).replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    text.replace('"', "&quot;")
}
