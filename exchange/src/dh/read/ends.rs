//! Rows of base and tool: `x`, `y`, `z`, `roll`, `pitch` and `yaw` as in URDF, or four constant
//! numbers.

use abbe_spec::diagnostic::Span;

use super::{cell::Cells, heading::Quantity, text::Text};
use crate::import::AngleRounding;
use crate::import::chain::{DhRow, Geometry};
use crate::placement::Placement;

/// End of the chain: before the first joint, or after the last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    Base,
    Tool,
}

/// Columns of a placement; `true` for a length.
const PLACEMENT: [(Quantity, bool); 6] = [
    (Quantity::X, true),
    (Quantity::Y, true),
    (Quantity::Z, true),
    (Quantity::Roll, false),
    (Quantity::Pitch, false),
    (Quantity::Yaw, false),
];

/// Columns of the four numbers; `true` for a length.
const NUMBERS: [(Quantity, bool); 4] =
    [(Quantity::Theta, false), (Quantity::D, true), (Quantity::A, true), (Quantity::Alpha, false)];

/// Columns that only rows of joints use.
const JOINT_ONLY: [Quantity; 4] = [Quantity::Offset, Quantity::Lower, Quantity::Upper, Quantity::Sign];

impl End {
    /// Returns the end that a row describes.
    ///
    /// The column `kind` decides; a table without it that has columns of a placement names the ends
    /// in the first column.
    fn of_row(row: &[Span], cells: &Cells<'_>, whole: &str) -> Option<Self> {
        let has_placement = PLACEMENT.iter().any(|(quantity, _)| cells.columns.get(*quantity).is_some());
        let quantity = match cells.columns.get(Quantity::Kind) {
            Some(_) => Quantity::Kind,
            None if has_placement => Quantity::Name,
            None => return None,
        };
        let (_, cell) = cells.cell(row, quantity)?;
        match whole[cell].to_lowercase().as_str() {
            "base" => Some(Self::Base),
            "tool" => Some(Self::Tool),
            _ => None,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Base => "base",
            Self::Tool => "tool",
        }
    }
}

/// Reads the placements of base and tool, `None` for one that the table does not have, and removes
/// their rows.
pub(super) fn read(
    text: &mut Text,
    cells: &Cells<'_>,
    angles: &mut AngleRounding,
) -> Option<[Option<Placement>; 2]> {
    let document = cells.document;
    let whole = document.text.clone();
    let count = text.rows.len();
    let mut found = [None; 2];
    let mut joints = Vec::new();
    for (i, row) in text.rows.iter().enumerate() {
        let Some(end) = End::of_row(row, cells, &whole) else {
            joints.push(row.clone());
            continue;
        };
        let is_there = match end {
            End::Base => i == 0,
            End::Tool => i + 1 == count,
        };
        if !is_there {
            let (place, name) = if end == End::Base { ("first", "base") } else { ("last", "tool") };
            let span = row.iter().find(|cell| !cell.is_empty()).cloned().unwrap_or_default();
            return document.refuse(
                span,
                format!("the row of the {name} is not the {place} row"),
                "order the rows from base to tool; a constant row between joints has \
                    the kind `fixed`",
            );
        }
        found[end as usize] = Some(placement(end, row, cells, angles)?);
    }
    if found != [None; 2] {
        let is_zero = |cell: &Span| whole[cell.clone()].parse() == Ok(0.0);
        let placed = joints.iter().find_map(|row| {
            let mut places = PLACEMENT.iter().filter_map(|(quantity, _)| cells.cell(row, *quantity));
            places.find(|(_, cell)| !is_zero(cell))
        });
        if let Some((_, cell)) = placed {
            let help = "leave this cell empty; only the rows of base and tool have these columns";
            return document.refuse(cell, "the row of a joint cannot have x, y, z, roll, pitch or yaw", help);
        }
    }
    text.rows = joints;
    Some(found)
}

/// Reads the placement in a row of base or tool.
fn placement(end: End, row: &[Span], cells: &Cells<'_>, angles: &mut AngleRounding) -> Option<Placement> {
    let &Cells { document, convention, .. } = cells;
    if let Some((_, cell)) = JOINT_ONLY.iter().find_map(|quantity| cells.cell(row, *quantity)) {
        let message = format!("the {} is fixed: this column is for joints only", end.name());
        return document.refuse(cell, message, "leave this cell empty");
    }
    let mut number = |(quantity, is_length): (Quantity, bool)| match cells.cell(row, quantity) {
        Some((column, cell)) => cells.number(&column, cell, is_length),
        None => Some(0.0),
    };
    let six: Option<Vec<f64>> = PLACEMENT.into_iter().map(&mut number).collect();
    let [x, y, z, roll, pitch, yaw]: [f64; 6] = six?.try_into().ok()?;
    let four: Option<Vec<f64>> = NUMBERS.into_iter().map(&mut number).collect();
    let [theta, d, a, alpha]: [f64; 4] = four?.try_into().ok()?;
    let placed = Placement { xyz: [x, y, z], rpy: [roll, pitch, yaw].map(|angle| angles.angle(angle)) };
    if [theta, d, a, alpha] == [0.0; 4] {
        return Some(placed);
    }
    if placed != Placement::default() {
        let span = row.first()?.start..row.last()?.end;
        let help = "leave either the four DH numbers or x, y, z, roll, pitch and yaw empty";
        return document.refuse(span, format!("this row gives the pose of the {} twice", end.name()), help);
    }
    let [theta, alpha] = [theta, alpha].map(|angle| angles.angle(angle));
    let geometry = Geometry::DenavitHartenberg(DhRow { convention, theta, d, a, alpha });
    Some(Placement::from_motion(&(geometry.before() * geometry.after())))
}
