//! Facts beside their names, and aligned columns.

use super::wrapped;

/// Column at which the text of a fact begins.
const INDENT: usize = 10;

/// Returns the last line of an answer: what to do next.
pub fn next(text: &str) -> String {
    fact("Next", text)
}

/// Returns a name and, beside it, a wrapped text.
pub(crate) fn fact(name: &str, text: &str) -> String {
    format!("{name:<INDENT$}{}\n", wrapped(text, INDENT))
}

/// Aligns cells in columns, two spaces from the margin and three apart. The columns `right` are
/// flush right; empty columns are left out.
pub(crate) fn aligned(rows: &[Vec<String>], right: &[bool]) -> String {
    let length = |cell: &String| cell.chars().count();
    let widest = |j| rows.iter().filter_map(|row| row.get(j)).map(length).max().unwrap_or_default();
    let width: Vec<usize> = (0..right.len()).map(widest).collect();
    let line = |row: &Vec<String>| {
        let mut line = String::new();
        for (j, cell) in row.iter().enumerate().filter(|(j, _)| width[*j] > 0) {
            let fill = " ".repeat(width[j] - length(cell));
            let gap = if line.is_empty() { "  " } else { "   " };
            line += &if right[j] { format!("{gap}{fill}{cell}") } else { format!("{gap}{cell}{fill}") };
        }
        line.trim_end().to_owned() + "\n"
    };
    rows.iter().map(line).collect()
}
