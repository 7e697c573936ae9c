//! Reads a table of Denavit-Hartenberg numbers: CSV, or the output of the Robotics Toolbox.
//!
//! `text` finds the table in the file. `heading` interprets the name of a column, `columns` the
//! heading line, `cell` a cell. `rows` turns rows into joints, and `ends` reads the rows of base
//! and tool.

mod cell;
mod columns;
mod ends;
mod heading;
mod rows;
mod text;

use abbe::LengthUnit;
use abbe_spec::{DhConvention, Document, Notes, diagnostic::listed, option::option};

use self::{cell::Cells, columns::Columns, text::Text};
use super::table::Units;
use crate::import::AngleRounding;
use crate::import::chain::{Chain, Frame, Geometry};

/// Reads a table as a chain.
///
/// Returns `None` if the table is wrong: the mistakes are then in the document. Notes say which
/// columns are left out.
pub fn read(
    document: &Document,
    convention: DhConvention,
    units: Units,
    angles: &mut AngleRounding,
    notes: &mut dyn Notes,
) -> Option<Chain> {
    let mut text = Text::find(document)?;
    check_convention(&text, convention, document)?;
    let columns = Columns::read(&text, convention, document)?;
    let length = units.length.or_else(|| columns.length()).unwrap_or(LengthUnit::Metre);
    let (mistakes, whole) = (document.mistakes(), document.text.clone());
    let decimal_comma = text.decimal_comma;
    let cells = Cells { document, convention, columns: &columns, units, length, decimal_comma };
    let [base, tool] = ends::read(&mut text, &cells, angles)?;
    let joints = rows::read(&text, &cells, notes);
    if document.mistakes() > mistakes {
        return None;
    }
    let mut ignored = columns.ignored();
    if base.is_none() && tool.is_none() {
        ignored.extend(columns.placement_names(&whole));
    }
    if !ignored.is_empty() {
        notes.note(&format!("ignored columns: {}", listed(&ignored)));
    }
    if text.has_ends && base.is_none() && tool.is_none() {
        notes.warn(
            "the text beside the table about base and tool is rounded and was ignored: add rows \
             of the kinds base and tool, with columns x, y, z, roll, pitch and yaw, or add a \
             first [[frame]] and [tool] to the spec",
        );
    }
    let word = match convention {
        DhConvention::Standard => "Standard",
        DhConvention::Modified => "Modified",
    };
    let (variables, mut frames) = rows::frames(joints, convention, angles);
    if let Some(base) = base {
        let geometry = Geometry::Origin(base);
        let is_taken = frames.iter().any(|frame| frame.joint == "base");
        let name = if is_taken { "before base" } else { "base" };
        frames.insert(0, Frame { joint: name.to_owned(), link: None, geometry, motion: None, upward: false });
    }
    Some(Chain {
        robot: text.name.clone(),
        description: format!("{word} Denavit-Hartenberg numbers"),
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

/// Reports a text that names the other convention.
fn check_convention(text: &Text, convention: DhConvention, document: &Document) -> Option<()> {
    let Some((span, stated)) = &text.convention else { return Some(()) };
    if *stated == convention {
        return Some(());
    }
    let other = stated.name();
    let help = format!("read it in that convention: `{}`", option("dh", other));
    document.refuse(span.clone(), format!("this table declares the convention {other}"), help)
}
