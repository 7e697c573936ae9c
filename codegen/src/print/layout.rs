//! Lines, laid out as rustfmt does: what is narrow on one line, else one below the other.

use super::text::{harmless, wrapped};

/// How long a line may be.
const LINE: usize = 100;

/// How wide an expression, the entries of an array or the arguments of a call may be on one line.
pub(super) const NARROW: usize = 60;

/// How wide entries without operators may be for several of them to share a line.
const SHORT: usize = 10;

/// How far a block is indented.
const STEP: usize = 4;

/// Source text that grows line by line.
pub(super) struct Writer {
    text: String,
    depth: usize,
    /// How a line of documentation begins.
    comment: &'static str,
}

impl Writer {
    /// No lines yet; those of documentation begin with `comment`.
    pub(super) fn new(comment: &'static str) -> Self {
        Self { text: String::new(), depth: 0, comment }
    }

    pub(super) fn finish(self) -> String {
        self.text
    }

    /// How far lines are indented.
    pub(super) fn indent(&self) -> usize {
        STEP * self.depth
    }

    /// Lines, each indented as far as blocks are open.
    pub(super) fn lines(&mut self, lines: &str) {
        for line in lines.lines() {
            self.text.extend(std::iter::repeat_n(' ', self.indent()));
            self.text.push_str(line);
            self.text.push('\n');
        }
    }

    /// Lines with empty ones between them, which stay empty.
    pub(super) fn paragraphs(&mut self, lines: &str) {
        for line in lines.trim().lines() {
            if line.is_empty() { self.blank() } else { self.lines(line) }
        }
    }

    pub(super) fn blank(&mut self) {
        self.text.push('\n');
    }

    /// The head of a block, `head {`.
    pub(super) fn open(&mut self, head: &str) {
        self.lines(&format!("{head} {{"));
        self.depth += 1;
    }

    /// The head of a block that has no brackets.
    pub(super) fn begin(&mut self, head: &str) {
        self.lines(head);
        self.depth += 1;
    }

    /// The end of a block that has no brackets, and nothing to say so.
    pub(super) fn end(&mut self) {
        self.depth -= 1;
    }

    /// The beginning of a block on a line of its own.
    pub(super) fn open_alone(&mut self) {
        self.lines("{");
        self.depth += 1;
    }

    /// `before{ first, second, … }after`, as many as a line holds.
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

    /// A paragraph of documentation, in as many lines as it takes.
    pub(super) fn documentation(&mut self, paragraph: &str) {
        for line in wrapped(paragraph, LINE - self.indent() - self.comment.len() - 1) {
            self.documentation_line(&line);
        }
    }

    /// A line of documentation as it is; an empty one parts paragraphs.
    pub(super) fn documentation_line(&mut self, line: &str) {
        let space = if self.comment.is_empty() { "" } else { " " };
        self.lines(format!("{}{space}{}", self.comment, harmless(line)).trim_end());
    }

    /// A line beside the code, cut where it is too long.
    pub(super) fn comment(&mut self, text: &str) {
        let line: String = format!("// {}", harmless(text)).chars().take(LINE - self.indent()).collect();
        self.lines(line.trim_end());
    }

    /// `use path::{first, second, …};`.
    pub(super) fn imports(&mut self, path: &str, names: &[&str]) {
        let line = format!("use {path}::{{{}}};", names.join(", "));
        if fits(self.indent(), width(&line)) {
            return self.lines(&line);
        }
        let mut lines = format!("use {path}::{{\n");
        filled(&mut lines, self.indent(), names);
        self.lines(&(lines + "};"));
    }

    /// The head of a function, `name(first, second, …) result {`, with all that stands before its arguments as the name;
    /// an empty one is closed at once.
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

    /// `before[name(first, …), name(second, …), …]after`.
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

    /// `before[first, second, …]after`.
    pub(super) fn array(&mut self, before: &str, entries: &[String], after: &str) {
        let lines = array(self.indent(), before, entries, after);
        self.lines(&lines);
    }
}

/// `before[first, second, …]after` at an indentation: on one line if it is narrow, short entries filling lines,
/// others one below the other.
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

/// `before[first, second, …]after` where it is a pattern: narrow, or one entry below the other.
pub(super) fn pattern(indent: usize, before: &str, entries: &[String], after: &str) -> String {
    on_one_line(indent, before, ["[", "]"], entries, after).unwrap_or_else(|| {
        let mut lines = format!("{before}[\n");
        one_below_the_other(&mut lines, entries);
        lines + "]" + after
    })
}

/// `name(first, second, …)` at an indentation: narrow, or one argument below the other.
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

/// Entries one after the other, as many as a line holds.
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

/// How many columns a text takes.
pub(super) fn width(text: &str) -> usize {
    text.chars().count()
}

/// Whether a line of so many columns fits at an indentation.
pub(super) fn fits(indent: usize, columns: usize) -> bool {
    indent + columns <= LINE
}
