//! Tables of Denavit-Hartenberg numbers: CSV, and what the Robotics Toolbox prints.
//!
//! `text` finds the rows of the table, `columns` says what its heading means, `cell` what a cell does, `rows` makes joints of them.

mod cell;
mod columns;
mod rows;
mod text;

use std::str::FromStr;

use abbe::LengthUnit;
use abbe_codegen::diagnostic::{Diagnostic, listed};
use abbe_codegen::document::Document;
use abbe_codegen::spec::DhConvention;

use self::cell::Cells;
use self::columns::Columns;
use self::text::Text;
use super::almost::Almost;
use super::chain::Chain;
use super::placement::Placement;
use crate::notes::Notes;

/// What numbers are in where neither heading nor cell says it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Units {
    /// Lengths; the spec is in this unit, too.
    pub length: Option<LengthUnit>,
    /// Whether angles are in degrees; in rad if not.
    pub degrees: Option<bool>,
}

/// `mm,deg`, in either order; or one of them.
impl FromStr for Units {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let mut units = Self::default();
        for unit in text.split(',').map(str::trim) {
            match unit {
                "m" if units.length.is_none() => units.length = Some(LengthUnit::Metre),
                "mm" if units.length.is_none() => units.length = Some(LengthUnit::Millimetre),
                "deg" if units.degrees.is_none() => units.degrees = Some(true),
                "rad" if units.degrees.is_none() => units.degrees = Some(false),
                _ => return Err("give one of m and mm, and one of deg and rad, as in `mm,deg`"),
            }
        }
        Ok(units)
    }
}

/// The chain of a table; what is wrong goes to the document, what is left out to the notes.
pub(super) fn chain(
    document: &mut Document,
    convention: DhConvention,
    units: Units,
    almost: &mut Almost,
    notes: &mut dyn Notes,
) -> Option<Chain> {
    let text = Text::find(document)?;
    contradicted(&text, convention, document)?;
    let columns = Columns::read(&text, convention, document)?;
    let length = units.length.or_else(|| columns.length()).unwrap_or(LengthUnit::Metre);
    let mistakes = document.found.len();
    let cells = Cells { columns: &columns, units, length, decimal_comma: text.decimal_comma };
    let joints = rows::joints(&text, &cells, document, notes);
    if document.found.len() > mistakes {
        return None;
    }
    let unread = columns.unread();
    if !unread.is_empty() {
        notes.note(&format!("columns that are not read: {}", listed(&unread)));
    }
    if text.has_ends {
        notes.warn(
            "what stands beside the table about base and tool is not read: add it to the spec, as a first [[frame]] and as [tool]",
        );
    }
    let word = match convention {
        DhConvention::Standard => "Standard",
        DhConvention::Modified => "Modified",
    };
    let (variables, frames) = rows::frames(joints, convention, almost);
    Some(Chain {
        robot: text.name.clone(),
        origin: format!("{word} Denavit-Hartenberg numbers"),
        length,
        degrees: cells.degrees(),
        base: "F_0".to_owned(),
        tip: format!("F_{}", frames.len()),
        variables,
        frames,
        tool: Placement::default(),
        masses: Vec::new(),
    })
}

/// The table says of itself that it is of the other convention.
fn contradicted(text: &Text, convention: DhConvention, document: &mut Document) -> Option<()> {
    let Some((span, stated)) = &text.convention else { return Some(()) };
    if *stated == convention {
        return Some(());
    }
    let other = match stated {
        DhConvention::Standard => "standard",
        DhConvention::Modified => "modified",
    };
    let mistake = Diagnostic::new(span.clone(), format!("this table says that it is {other}"));
    document.mistake(mistake.help(format!("read it so: `--dh {other}`")));
    None
}
