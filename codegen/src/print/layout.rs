//! Lays out lines as rustfmt does: narrow lists on one line, wider ones with one entry per line.
//!
//! Documentation: a spec's free text, and sizes of arrays.
//!
//! Files of generated code.

use std::collections::BTreeMap;

use abbe_core::{Description, function::Array};
use abbe_spec::visible::alters_text;

/// Maximum length of a line.
pub(super) const LINE: usize = 100;

/// Maximum width of an expression, an array or the arguments of a call on one line.
pub(super) const NARROW: usize = 60;

/// Maximum width of entries without operators that may share a line.
const SHORT: usize = 10;

/// Indentation of a block.
const STEP: usize = 4;

/// Source text that grows line by line.
pub(super) struct Writer {
    text: String,
    depth: usize,
    /// Start of a documentation line.
    comment: &'static str,
    /// Types of arrays that the text has used, by name, where they need names.
    pub(super) arrays: BTreeMap<String, String>,
}

impl Writer {
    /// Creates an empty text whose documentation lines start with `comment`.
    pub(super) fn new(comment: &'static str) -> Self {
        Self { text: String::new(), depth: 0, comment, arrays: BTreeMap::new() }
    }

    pub(super) fn finish(self) -> String {
        self.text
    }

    /// Returns the current indentation.
    pub(super) fn indent(&self) -> usize {
        STEP * self.depth
    }

    /// Appends lines at the current indentation.
    pub(super) fn lines(&mut self, lines: &str) {
        for line in lines.lines() {
            self.text.extend(std::iter::repeat_n(' ', self.indent()));
            self.text.push_str(line);
            self.text.push('\n');
        }
    }

    /// Appends lines at the current indentation; empty lines stay empty.
    pub(super) fn paragraphs(&mut self, lines: &str) {
        for line in lines.trim().lines() {
            if line.is_empty() { self.blank() } else { self.lines(line) }
        }
    }

    pub(super) fn blank(&mut self) {
        self.text.push('\n');
    }

    /// Opens a block: `head {`.
    pub(super) fn open(&mut self, head: &str) {
        self.lines(&format!("{head} {{"));
        self.depth += 1;
    }

    /// Opens a block without brackets.
    pub(super) fn begin(&mut self, head: &str) {
        self.lines(head);
        self.depth += 1;
    }

    /// Closes a block without brackets.
    pub(super) fn end(&mut self) {
        self.depth -= 1;
    }

    /// Opens a block on a line of its own.
    pub(super) fn open_alone(&mut self) {
        self.lines("{");
        self.depth += 1;
    }

    /// Appends `before{ first, second, … }after`, with as many entries on a line as fit.
    pub(super) fn braces(&mut self, before: &str, entries: &[impl AsRef<str>], after: &str) {
        let inner = entries.iter().map(AsRef::as_ref).collect::<Vec<_>>().join(", ");
        if self.indent() + width(before) + width(&inner) + 6 <= LINE {
            return self.lines(&format!("{before}{{ {inner} }}{after}"));
        }
        let mut lines = format!("{before}{{\n");
        filled(&mut lines, self.indent(), entries);
        self.lines(&(lines + "}" + after));
    }

    pub(super) fn close(&mut self, end: &str) {
        self.depth -= 1;
        self.lines(end);
    }

    /// Appends a paragraph of documentation, wrapped to the line length.
    pub(super) fn documentation(&mut self, paragraph: &str) {
        for line in wrapped(paragraph, LINE - self.indent() - self.comment.len() - 1) {
            self.documentation_line(&line);
        }
    }

    /// Appends one line of documentation; an empty one separates paragraphs.
    pub(super) fn documentation_line(&mut self, line: &str) {
        let space = if self.comment.is_empty() { "" } else { " " };
        self.lines(format!("{}{space}{}", self.comment, harmless(line)).trim_end());
    }

    /// Appends a line comment, truncated to the line length.
    pub(super) fn comment(&mut self, text: &str) {
        let line: String = format!("// {}", harmless(text)).chars().take(LINE - self.indent()).collect();
        self.lines(line.trim_end());
    }

    /// Appends `use path::{first, second, …};`.
    pub(super) fn imports(&mut self, path: &str, names: &[&str]) {
        let line = format!("use {path}::{{{}}};", names.join(", "));
        if fits(self.indent(), width(&line)) {
            return self.lines(&line);
        }
        let mut lines = format!("use {path}::{{\n");
        filled(&mut lines, self.indent(), names);
        self.lines(&(lines + "};"));
    }

    /// Appends the head of a function, `name(first, second, …) result {`, where `name` includes
    /// everything before the arguments. An empty function is closed immediately.
    pub(super) fn function(&mut self, name: &str, arguments: &[String], result: &str, is_empty: bool) {
        let head = format!("{name}({}){result} {{", arguments.join(", "));
        if fits(self.indent(), width(&head)) {
            self.lines(if is_empty { format!("{head}}}") } else { head }.as_str());
        } else {
            let mut lines = format!("{name}(\n");
            one_below_the_other(&mut lines, arguments);
            self.lines(&(lines + ")" + result + " {"));
            if is_empty {
                self.lines("}");
            }
        }
        self.depth += usize::from(!is_empty);
    }

    /// Appends `before[name(first, …), name(second, …), …]after`.
    pub(super) fn array_of_calls(&mut self, before: &str, calls: &[(&str, Vec<String>)], after: &str) {
        let indent = self.indent();
        let entries: Vec<String> =
            calls.iter().map(|(name, arguments)| call(indent + STEP, name, arguments)).collect();
        match calls {
            [(name, arguments)] if on_one_line(indent, before, ["[", "]"], &entries, after).is_none() => {
                self.lines(&format!("{before}[{}]{after}", long_call(name, arguments)));
            }
            _ => self.lines(&array(indent, before, &entries, after)),
        }
    }

    /// Appends `before[first, second, …]after`.
    pub(super) fn array(&mut self, before: &str, entries: &[String], after: &str) {
        self.lines(&array(self.indent(), before, entries, after));
    }
}

/// Returns `before[first, second, …]after` at an indentation: on one line if it is narrow;
/// otherwise short entries fill lines and longer ones get a line each.
pub(super) fn array(indent: usize, before: &str, entries: &[String], after: &str) -> String {
    if let Some(line) = on_one_line(indent, before, ["[", "]"], entries, after) {
        return line;
    }
    if before.ends_with("= ")
        && let Some(line) = on_one_line(indent + STEP, "", ["[", "]"], entries, after)
    {
        return format!("{}\n    {line}", before.trim_end());
    }
    if let [entry] = entries {
        return format!("{before}[{entry}]{after}");
    }
    let mut lines = format!("{before}[\n");
    if entries.iter().all(|entry| width(entry) <= SHORT && !entry.contains([' ', '('])) {
        filled(&mut lines, indent, entries);
    } else {
        one_below_the_other(&mut lines, entries);
    }
    lines + "]" + after
}

/// Returns `before[first, second, …]after` as a pattern: on one line if it is narrow, otherwise one
/// entry per line.
pub(super) fn pattern(indent: usize, before: &str, entries: &[String], after: &str) -> String {
    on_one_line(indent, before, ["[", "]"], entries, after).unwrap_or_else(|| {
        let mut lines = format!("{before}[\n");
        one_below_the_other(&mut lines, entries);
        lines + "]" + after
    })
}

/// Returns `name(first, second, …)` at an indentation: on one line if it is narrow, otherwise one
/// argument per line.
pub(super) fn call(indent: usize, name: &str, arguments: &[String]) -> String {
    on_one_line(indent, name, ["(", ")"], arguments, ",")
        .map_or_else(|| long_call(name, arguments), |line| line.trim_end_matches(',').to_owned())
}

fn long_call(name: &str, arguments: &[String]) -> String {
    let mut lines = format!("{name}(\n");
    one_below_the_other(&mut lines, arguments);
    lines + ")"
}

fn on_one_line(
    indent: usize,
    before: &str,
    [open, close]: [&str; 2],
    entries: &[String],
    after: &str,
) -> Option<String> {
    let inner = entries.join(", ");
    let line = format!("{before}{open}{inner}{close}{after}");
    let fits = width(&inner) <= NARROW && indent + width(&line) <= LINE && !inner.contains('\n');
    (entries.is_empty() || fits).then_some(line)
}

/// Appends entries one after the other, as many as fit on a line.
fn filled(lines: &mut String, indent: usize, entries: &[impl AsRef<str>]) {
    let mut column = 0;
    for entry in entries {
        let needed = width(entry.as_ref()) + ",".len();
        // rustfmt leaves the last column free.
        if column > 0 && column + 1 + needed >= LINE {
            lines.push('\n');
            column = 0;
        }
        if column == 0 {
            lines.push_str("    ");
            column = indent + STEP;
        } else {
            lines.push(' ');
            column += 1;
        }
        lines.push_str(entry.as_ref());
        lines.push(',');
        column += needed;
    }
    lines.push('\n');
}

fn one_below_the_other(lines: &mut String, entries: &[String]) {
    for entry in entries {
        for line in entry.lines() {
            lines.push_str("    ");
            lines.push_str(line);
            lines.push('\n');
        }
        lines.truncate(lines.trim_end().len());
        lines.push_str(",\n");
    }
}

/// Returns the width of a text in columns.
pub(super) fn width(text: &str) -> usize {
    text.chars().count()
}

/// Returns `true` if a text of this width fits on a line at an indentation.
pub(super) fn fits(indent: usize, columns: usize) -> bool {
    indent + columns <= LINE
}

/// Meaning of the status of loops that do not close.
pub(super) const NOT_CLOSED: &str =
    "A loop does not close on the path from home, or a passive joint exceeds a limit.";

/// Error of loops that do not close.
pub(super) const OPEN: &str = "a loop does not close, or a passive joint exceeds a limit";

/// Returns the sizes of an array of a function, the outermost first.
pub(super) fn sizes(array: &Array, description: &Description) -> Vec<String> {
    array.shape.iter().map(|count| count.value(description).to_string()).collect()
}

/// Describes a value with its unit.
pub(super) fn described(description: &str, unit: &str) -> String {
    let unit = if unit.is_empty() { "rad or a pure number" } else { unit };
    let description = escaped(description);
    match description.trim_end_matches('.') {
        "" => format!("Unit: {unit}."),
        description => format!("{description}; {unit}."),
    }
}

/// Escapes links, tags and code blocks.
pub(super) fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for character in text.chars() {
        if matches!(character, '[' | ']' | '<' | '>' | '|' | '`' | '~' | '\\') {
            escaped.push('\\');
        }
        escaped.push(character);
    }
    escaped
}

/// Makes a text safe for a comment of any language: on one line, in one writing direction, without
/// the end of a comment and the trigraphs of C.
pub(super) fn harmless(text: &str) -> String {
    text.replace(alters_text, " ")
        .replace("*/", "* /")
        .replace("/*", "/ *")
        .replace("??", "? ?")
        // Of `???` the first pass leaves two.
        .replace("??", "? ?")
        .replace(r#"""""#, "'''")
}

/// Wraps a text to lines of bounded width.
pub(super) fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// A file of generated code.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceFile {
    /// File name: the manipulator's name and an extension; in an archive including the folder.
    pub name: String,
    /// Contents of the file.
    pub text: String,
}
