//! Tables of Denavit-Hartenberg numbers: CSV, and what the Robotics Toolbox prints.
//!
//! `text` finds the rows of the table, `columns` says what its heading means, `cell` what a cell does, `rows` makes joints of them; `ends` are those
//! of base and tool.

mod cell;
mod columns;
mod ends;
mod rows;
mod text;

use std::str::FromStr;

use abbe::LengthUnit;
use abbe_spec::DhConvention;
use abbe_spec::diagnostic::{Diagnostic, listed};
use abbe_spec::document::Document;

use self::cell::Cells;
use self::columns::Columns;
use self::text::Text;
use super::almost::Almost;
use super::chain::{Chain, Frame};
use super::geometry::Geometry;
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
    let mut text = Text::find(document)?;
    contradicted(&text, convention, document)?;
    let columns = Columns::read(&text, convention, document)?;
    let length = units.length.or_else(|| columns.length()).unwrap_or(LengthUnit::Metre);
    let (mistakes, whole) = (document.found.len(), document.text.clone());
    let cells = Cells { columns: &columns, units, length, decimal_comma: text.decimal_comma };
    let [base, tool] = ends::ends(&mut text, &cells, convention, almost, document)?;
    let joints = rows::joints(&text, &cells, document, notes);
    if document.found.len() > mistakes {
        return None;
    }
    let mut unread = columns.unread();
    if base.is_none() && tool.is_none() {
        unread.extend(columns.of_ends(&whole));
    }
    if !unread.is_empty() {
        notes.note(&format!("columns that are not read: {}", listed(&unread)));
    }
    if text.has_ends && base.is_none() && tool.is_none() {
        notes.warn(
            "what stands beside the table about base and tool is rounded, and not read: add rows of the kind base and tool, with columns x, y, z, roll, \
             pitch and yaw, or a first [[frame]] and [tool] to the spec",
        );
    }
    let word = match convention {
        DhConvention::Standard => "Standard",
        DhConvention::Modified => "Modified",
    };
    let (variables, mut frames) = rows::frames(joints, convention, almost);
    if let Some(base) = base {
        let geometry = Geometry::Origin(base);
        let is_taken = frames.iter().any(|frame| frame.joint == "base");
        let name = if is_taken { "before base" } else { "base" };
        frames.insert(0, Frame { joint: name.to_owned(), link: None, geometry, motion: None });
    }
    Some(Chain {
        robot: text.name.clone(),
        origin: format!("{word} Denavit-Hartenberg numbers"),
        length,
        degrees: cells.degrees(),
        base: "F_0".to_owned(),
        tip: if tool.is_some() { "tool".to_owned() } else { format!("F_{}", frames.len()) },
        variables,
        frames,
        tool: tool.unwrap_or_default(),
        masses: Vec::new(),
    })
}

/// The table says of itself that it is of the other convention.
fn contradicted(text: &Text, convention: DhConvention, document: &mut Document) -> Option<()> {
    let Some((span, stated)) = &text.convention else { return Some(()) };
    if *stated == convention {
        return Some(());
    }
    let other = stated.name();
    let mistake = Diagnostic::new(span.clone(), format!("this table says that it is {other}"));
    document.mistake(mistake.help(format!("read it so: `--dh {other}`")));
    None
}
