//! What a file is that is not what was to be read.

use crate::diagnostic::Diagnostic;
use crate::document::{Document, Section};

/// A file with more mistakes of syntax, and without the heading of a table, is something else.
const MISTAKES: usize = 5;

/// The files that are read: the table that only they have, what they are, and how they are given.
const KINDS: [(&str, &str, &str); 4] = [
    ("manipulator", "a spec", "a spec is the first argument of a command: `abbe check SPEC`"),
    ("study", "a study", "give a study by `--study FILE`, after its spec"),
    ("data", "a map", "give a map by `--map FILE`, after its spec"),
    ("plan", "a plan", "give a plan by `--sets FILE`, after its spec and map"),
];

/// One mistake in place of many of syntax, if the text is no TOML at all.
pub(crate) fn not_toml(text: &str, found: &[Diagnostic]) -> Option<Diagnostic> {
    let first = found.first()?;
    let lines = || text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    let start = lines().next()?;
    let separated = |line: &str| line.split([',', ';', '\t']).count() > 2 && !line.contains('=');
    let heading = |line: &str| line.starts_with('[') && line.ends_with(']') && !line.contains(',');
    let (what, help) = if start.starts_with('<') {
        ("XML", "write the joints of a URDF file as [[frame]] tables with `origin` and `axis`")
    } else if start.starts_with('{') {
        ("JSON", "in TOML, `\"key\": value` is `key = value`, and a group is a `[table]`")
    } else if lines().take(3).all(separated) {
        (
            "a table of data",
            "data are the argument after the spec, with a map: `abbe measure SPEC DATA --map MAP`",
        )
    } else if lines()
        .take(3)
        .all(|line| line.split_once(':').is_some_and(|(key, _)| !key.contains(['=', '"'])))
    {
        ("YAML", "in TOML, `key: value` is `key = value`, and a group is a `[table]`")
    } else if found.len() > MISTAKES && !lines().any(heading) {
        ("something else", "the files of abbe are TOML: `key = value`, `[table]`")
    } else {
        return None;
    };
    let message = format!("this file is not TOML; it seems to be {what}");
    let mistake = Diagnostic { message, ..first.clone() }.label("here it is not TOML").help(help);
    Some(mistake)
}

impl Document {
    /// Whether the file can be what is to be read, which has the table `own`. If it is another kind of file, that is
    /// its one mistake.
    pub fn is_kind(&mut self, root: &Section<'_>, own: &str) -> bool {
        let Some((_, expected, _)) = KINDS.iter().find(|(table, ..)| *table == own) else { return true };
        if root.get(own).is_some() {
            return true;
        }
        let other = KINDS.iter().find_map(|(table, what, help)| Some((root.get(table)?, what, help)));
        let Some((item, what, help)) = other else { return true };
        self.mistake(
            Diagnostic::new(item.key_span, format!("this file is {what}, not {expected}"))
                .label(format!("only {what} has this table"))
                .help(*help),
        );
        false
    }
}
