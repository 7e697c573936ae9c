//! The first screen of each job: at most 25 lines with the verdict, the figures and their causes.
//!
//! One file for each job. A headline comes first, then aligned figures, then named facts.

mod analysis;
mod bound;
mod check;
mod compensation;
mod doctor;
mod exported;
mod identification;
mod measurement;
mod monitoring;
mod plan;
mod positioning;

use abbe_metrology::data::Summary;
use abbe_study::number::{digits, error_unit, unbroken};
use abbe_study::{Extrapolation, OtherTool};

use super::{full, wrapped};

pub(super) use analysis::analysis;
pub(super) use bound::bound;
pub(super) use check::check;
pub(super) use compensation::compensation;
pub(super) use doctor::doctor;
pub(super) use exported::exported;
pub(super) use identification::identification;
pub(super) use measurement::measurement;
pub(super) use monitoring::monitoring;
pub(super) use plan::plan;
pub(super) use positioning::positioning;

/// Number of values of a configuration that are shown.
const NAMED: usize = 12;
/// Column at which the text of a fact begins.
const INDENT: usize = 10;

/// The text of an answer while it grows.
struct Answer(String);

impl Answer {
    fn new(headline: &str) -> Self {
        Self(wrapped(headline, 0) + "\n")
    }

    /// Adds lines below an empty one; nothing if there are none.
    fn block(&mut self, lines: &str) {
        if !lines.is_empty() {
            self.0 += &format!("\n{}\n", lines.trim_end());
        }
    }

    /// Adds facts below an empty line, each with its name in front.
    fn facts<N: AsRef<str>>(&mut self, facts: impl IntoIterator<Item = (N, String)>) {
        let lines: String = facts.into_iter().map(|(name, text)| fact(name.as_ref(), &text)).collect();
        self.block(&lines);
    }
}

/// Returns the last line of an answer: what to do next.
pub fn next(text: &str) -> String {
    fact("Next", text)
}

/// Returns the facts about a data file: its rows, and the first of those that cannot be used.
fn data(file: &Summary) -> Vec<(&'static str, String)> {
    let lines = file.lines();
    let names = std::iter::once("Data").chain(std::iter::repeat(""));
    names.zip(lines.iter().take(3)).map(|(name, line)| (name, line.trim().to_owned())).collect()
}

/// Returns the uncertainty with a tool that is not the measured one.
fn other_tool(tool: &OtherTool, length: &str) -> String {
    let (factor, unit) = error_unit(length);
    let [all, noise] = [tool.standard_deviation, tool.by_noise].map(|value| digits(factor * value, 3));
    format!("not the measured one: σ {all} {unit}, {noise} {unit} by noise; not all errors are determined")
}

/// Returns the number of rows outside the fitted ranges.
fn outside(rows: &Extrapolation) -> String {
    format!("{} of {} rows are outside the identified ranges", rows.outside, rows.all)
}

/// Returns the first texts under one name, and the number of the others.
fn some<'n>(name: &'n str, texts: &[String], shown: usize) -> Vec<(&'n str, String)> {
    let plain = |text: &String| text.strip_prefix("note: ").unwrap_or(text).to_owned();
    let mut facts: Vec<_> = texts.iter().take(shown).map(|text| (name, plain(text))).collect();
    if texts.len() > shown {
        facts.push(("", format!("… and {} more", texts.len() - shown)));
    }
    facts
}

/// Returns a name and, beside it, a wrapped text.
pub(super) fn fact(name: &str, text: &str) -> String {
    format!("{name:<INDENT$}{}\n", wrapped(text, INDENT))
}

/// Aligns cells in columns, two spaces from the margin and three apart. The columns `right` are
/// flush right.
fn aligned<const N: usize>(rows: &[[String; N]], right: [bool; N]) -> String {
    let length = |cell: &String| cell.chars().count();
    let width: [usize; N] =
        std::array::from_fn(|j| rows.iter().map(|row| length(&row[j])).max().unwrap_or_default());
    let line = |row: &[String; N]| {
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

/// Returns a configuration with at most [`NAMED`] of its values.
fn place(label: &str) -> String {
    let values: Vec<&str> = label.split(", ").collect();
    format!("at {}", unbroken(&first(&values, NAMED)))
}

/// Returns the first items of a list, separated by commas, and the number of the others.
fn first<T: AsRef<str>>(items: &[T], shown: usize) -> String {
    let names: Vec<&str> = items.iter().take(shown).map(AsRef::as_ref).collect();
    match items.len().saturating_sub(shown) {
        0 => names.join(", "),
        more => format!("{} and {more} more", names.join(", ")),
    }
}
