//! Mutants of every site of generated code: operators, comparisons, numbers, indices, branches and
//! statements, in any language but Matlab.

use super::{Mutant, begun};

/// Syntax of a language, as far as mutants need it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Syntax {
    /// C and JavaScript.
    Braces,
    /// Python.
    Python,
    /// Structured Text.
    StructuredText,
}

/// Kind, text and replacement; the last ones are those of a language.
const OPERATORS: [(&str, &str, &str); 22] = [
    ("sum", " + ", " - "),
    ("difference", " - ", " + "),
    ("product", " * ", " + "),
    ("quotient", " / ", " * "),
    ("sum in place", " += ", " -= "),
    ("less", " < ", " > "),
    ("greater", " > ", " < "),
    ("equal or not", " <= ", " < "),
    ("equal or not", " >= ", " > "),
    ("equal or not", " < ", " <= "),
    ("equal or not", " > ", " >= "),
    ("logic", " && ", " || "),
    ("logic", " || ", " && "),
    ("logic", " and ", " or "),
    ("logic", " or ", " and "),
    ("logic", " AND ", " OR "),
    ("logic", " OR ", " AND "),
    ("negation", "= -", "= "),
    ("negation", "(-", "("),
    ("function", "abs(", "("),
    ("function", "sin(", "cos("),
    ("function", "cos(", "sin("),
];

/// Returns the mutants of every site of the functions that `is_mutated` selects.
pub fn every_mutant(text: &str, syntax: Syntax, is_mutated: impl Fn(&str) -> bool) -> Vec<Mutant> {
    let lines: Vec<&str> = text.lines().collect();
    let mut all = Vec::new();
    let (mut function, mut is_comment, mut is_small) = (None::<String>, false, false);
    for (index, line) in lines.iter().enumerate() {
        let trimmed = line.trim();
        // What is not compiled here is not found to be wrong.
        is_small = trimmed != "#else" && (is_small || trimmed == "#if defined(__OPTIMIZE_SIZE__)");
        if is_small {
            continue;
        }
        let ends = match syntax {
            Syntax::Braces => ["/*", "*/"],
            Syntax::Python => ["\"\"\"", "\"\"\""],
            Syntax::StructuredText => ["(*", "*)"],
        };
        let begun_here = trimmed.trim_start_matches('r').strip_prefix(ends[0]).filter(|_| !is_comment);
        if is_comment || begun_here.is_some() {
            is_comment = !begun_here.unwrap_or(trimmed).ends_with(ends[1]);
            continue;
        }
        let head = match syntax {
            Syntax::StructuredText => {
                let name = ["FUNCTION_BLOCK ", "FUNCTION "].iter().find_map(|word| line.strip_prefix(word));
                name.map(|name| name.split([' ', ':']).next().unwrap_or_default().to_owned())
            }
            _ => begun(line),
        };
        if let Some(name) = head {
            function = Some(name);
        } else if let Some(name) = function.as_ref().filter(|name| is_mutated(name)) {
            let is_statement = line.starts_with(' ')
                && !["//", "#", "raise", "throw"].iter().any(|word| trimmed.starts_with(word));
            for (kind, wrong) in is_statement.then(|| wrong_lines(line, syntax)).into_iter().flatten() {
                let text = [&lines[..index], &[&wrong[..]], &lines[index + 1..]].concat().join("\n") + "\n";
                all.push(Mutant {
                    function: name.clone(),
                    kind,
                    line: format!("{}: {} => {}", index + 1, trimmed, wrong.trim()),
                    text,
                });
            }
        }
    }
    all
}

/// Returns every wrong form of a line, with its kind.
fn wrong_lines(line: &str, syntax: Syntax) -> Vec<(&'static str, String)> {
    let mut wrong = Vec::new();
    let put = |from: usize, to: usize, text: &str| [&line[..from], text, &line[to..]].concat();
    for (kind, from, to) in OPERATORS {
        for (at, _) in line.match_indices(from) {
            let is_part = from.ends_with("n(") || from.ends_with("s(");
            let before = line[..at].chars().next_back().unwrap_or(' ');
            if !(is_part && from != "abs(" && (before.is_alphanumeric() || before == '_')) {
                wrong.push((kind, put(at, at + from.len(), to)));
            }
        }
    }
    for (begin, end) in numbers(line) {
        let text = &line[begin..end];
        let value: f64 = text.parse().unwrap_or(1.0);
        wrong.push((
            "number",
            put(begin, end, &format!("{:?}", if value == 0.0 { 0.5 } else { 1.5 * value })),
        ));
    }
    for (at, _) in line.match_indices('[') {
        let inner = &line[at + 1..];
        let Some(len) = inner.find([']', '[']).filter(|len| inner[*len..].starts_with(']')) else { continue };
        let index = &inner[..len];
        // Lists, slices and axes are no indices.
        let follows_name = line[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == ']');
        if follows_name && !index.is_empty() && !index.contains([',', ':', '.', ' ']) || index.contains(" + ")
        {
            wrong.push(("index", put(at + 1 + len, at + 1 + len, " + 1")));
        }
    }
    let trimmed = line.trim();
    let indent = &line[..line.len() - line.trim_start().len()];
    let is_declared =
        ["const ", "let ", "int ", "double ", "static "].iter().any(|word| trimmed.starts_with(word));
    match syntax {
        Syntax::Braces => {
            let sets = trimmed.ends_with(';') && [" = ", " += "].iter().any(|sign| trimmed.contains(sign));
            if sets && !is_declared || matches!(trimmed, "break;" | "continue;") {
                wrong.push(("deleted", indent.to_owned()));
            }
            if trimmed.starts_with("if (") && trimmed.ends_with(") {") {
                wrong.extend(["0", "1"].map(|value| ("branch", format!("{indent}if ({value}) {{"))));
            }
        }
        Syntax::Python => {
            let begins = trimmed.starts_with(|c: char| c.is_ascii_lowercase() || c == '_');
            let sets = [" = ", " += "].iter().any(|sign| trimmed.contains(sign))
                && !trimmed.ends_with(['(', '[', ',']);
            if sets
                && begins
                && !["if ", "for ", "return ", "while "].iter().any(|word| trimmed.starts_with(word))
                || matches!(trimmed, "break" | "continue")
            {
                wrong.push(("deleted", format!("{indent}pass")));
            }
            if trimmed.starts_with("if ") && trimmed.ends_with(':') {
                wrong.extend(["False", "True"].map(|value| ("branch", format!("{indent}if {value}:"))));
            }
        }
        Syntax::StructuredText => {
            let sets = trimmed.contains(" := ") && trimmed.ends_with(';') && !trimmed.contains(" : ");
            if sets || trimmed == "EXIT;" {
                wrong.push(("deleted", indent.to_owned()));
            }
            if trimmed.starts_with("IF ") && trimmed.ends_with(" THEN") {
                wrong.extend(["FALSE", "TRUE"].map(|value| ("branch", format!("{indent}IF {value} THEN"))));
            }
        }
    }
    wrong
}

/// Returns the ends of the numbers with a decimal point, which are no counts.
fn numbers(line: &str) -> Vec<(usize, usize)> {
    let bytes = line.as_bytes();
    let (mut found, mut at) = (Vec::new(), 0);
    while at < bytes.len() {
        let is_word = |at: usize| bytes[at].is_ascii_alphanumeric() || b"_.".contains(&bytes[at]);
        if !is_word(at) {
            at += 1;
            continue;
        }
        let begin = at;
        while at < bytes.len()
            && (is_word(at)
                || b"+-".contains(&bytes[at])
                    && bytes[begin].is_ascii_digit()
                    && matches!(bytes[at - 1], b'e' | b'E'))
        {
            at += 1;
        }
        if bytes[begin].is_ascii_digit() && line[begin..at].contains(['.', 'e']) {
            found.push((begin, at));
        }
    }
    found
}
