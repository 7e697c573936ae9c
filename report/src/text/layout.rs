//! Facts beside their names, and aligned columns.

use super::{table::columns, wrapped};

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
/// flush right; empty columns are left out. What has no room stands below, from the second column
/// on.
pub(crate) fn aligned(rows: &[Vec<String>], right: &[bool]) -> String {
    let length = |cell: &String| cell.chars().count();
    let widest = |j| rows.iter().filter_map(|row| row.get(j)).map(length).max().unwrap_or_default();
    let width: Vec<usize> = (0..right.len()).map(widest).collect();
    let below = format!("\n{:1$}", "", 5 + width.first().copied().unwrap_or_default());
    let line = |row: &Vec<String>| {
        let (mut line, mut end) = (String::new(), 0);
        for (j, cell) in row.iter().enumerate().filter(|(j, _)| width[*j] > 0) {
            let gap = if end == 0 { 2 } else { 3 };
            end += gap + width[j];
            if end > columns() && !line.is_empty() {
                end = below.len() - 1 + width[j];
                line += &below;
            } else {
                line += &" ".repeat(gap);
            }
            let fill = " ".repeat(width[j] - length(cell));
            line += &if right[j] { fill + cell } else { format!("{cell}{fill}") };
        }
        let lines: Vec<&str> = line.lines().map(str::trim_end).filter(|line| !line.is_empty()).collect();
        lines.join("\n") + "\n"
    };
    rows.iter().map(line).collect()
}

#[cfg(test)]
mod tests;
