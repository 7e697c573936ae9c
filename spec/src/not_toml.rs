//! Recognizes files that are not TOML.

use crate::diagnostic::Diagnostic;
use crate::option::{GENERATE, IMPORT_URDF, MEASURE};

/// Number of syntax errors before the first table header beyond which a file is not TOML.
const MISTAKES: usize = 5;

/// Replaces many syntax errors by one diagnostic if the text is not TOML at all.
pub(crate) fn not_toml(text: &str, found: &[Diagnostic]) -> Option<Diagnostic> {
    let first = found.first()?;
    let lines = || text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    let start = lines().next()?;
    let separated = |line: &str| line.split([',', ';', '\t']).count() > 2 && !line.contains('=');
    // A text about TOML may contain examples further down.
    let before = |mistake: &Diagnostic| {
        let end = mistake.span.as_ref().map_or(text.len(), |span| span.start);
        text.get(..end).unwrap_or(text)
    };
    let heading = |line: &str| line.starts_with('[') && line.ends_with(']') && !line.contains(',');
    let (what, help) = if start.starts_with('<') {
        ("XML", format!("convert a URDF file to a spec: `{IMPORT_URDF}`"))
    } else if start.starts_with('{') {
        ("JSON", "in TOML, `\"key\": value` is `key = value`, and a group is a `[table]`".to_owned())
    } else if lines().take(3).all(separated) {
        ("a table of data", format!("pass data after the spec, with a map: `{MEASURE}`"))
    } else if ["//", "/*", "use ", "import ", "from ", "%"].iter().any(|begin| start.starts_with(begin)) {
        ("source code", format!("specs are TOML files; `{GENERATE}` generates code from them"))
    } else if lines()
        .take(3)
        .all(|line| line.split_once(':').is_some_and(|(key, _)| !key.contains(['=', '"'])))
    {
        ("YAML", "in TOML, `key: value` is `key = value`, and a group is a `[table]`".to_owned())
    } else if found.len() > MISTAKES && !before(&found[MISTAKES]).lines().any(|line| heading(line.trim())) {
        ("something else", "expected TOML: `key = value`, `[table]`".to_owned())
    } else {
        return None;
    };
    let message = format!("this file is not TOML; it seems to be {what}");
    Some(Diagnostic { message, ..first.clone() }.label("not TOML").help(help))
}
