//! Rows that say where the base of a robot stands and where its tool is: `x`, `y`, `z`, then `roll`, `pitch` and `yaw`, as in URDF; or
//! four numbers that are constant.

use abbe_spec::DhConvention;
use abbe_spec::diagnostic::{Diagnostic, Span};
use abbe_spec::document::Document;

use super::cell::Cells;
use super::columns::Meaning;
use super::text::Text;
use crate::import::almost::Almost;
use crate::import::geometry::{Geometry, Numbers};
use crate::import::placement::Placement;

/// Before the first joint and behind the last one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    Base,
    Tool,
}

/// The columns of a place, and whether it is a length.
const PLACE: [(Meaning, bool); 6] = [
    (Meaning::X, true),
    (Meaning::Y, true),
    (Meaning::Z, true),
    (Meaning::Roll, false),
    (Meaning::Pitch, false),
    (Meaning::Yaw, false),
];

/// The four numbers of a row, and whether each is a length.
const FOUR: [(Meaning, bool); 4] =
    [(Meaning::Theta, false), (Meaning::D, true), (Meaning::A, true), (Meaning::Alpha, false)];

/// What a row of a joint has and one of an end does not.
const OF_JOINTS: [Meaning; 4] = [Meaning::Offset, Meaning::Lower, Meaning::Upper, Meaning::Sign];

impl End {
    /// Which end a row is, if it is one: `kind` says it; where there is no such column, and columns of a place are, its name.
    pub(super) fn of(row: &[Span], cells: &Cells<'_>, whole: &str) -> Option<Self> {
        let has_place = PLACE.iter().any(|(meaning, _)| cells.columns.get(*meaning).is_some());
        let meaning = match cells.columns.get(Meaning::Kind) {
            Some(_) => Meaning::Kind,
            None if has_place => Meaning::Name,
            None => return None,
        };
        let (_, cell) = cells.cell(row, meaning)?;
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

/// Where base and tool are, none of which is not said; these rows are taken out of the table.
pub(super) fn ends(
    text: &mut Text,
    cells: &Cells<'_>,
    convention: DhConvention,
    almost: &mut Almost,
    document: &mut Document,
) -> Option<[Option<Placement>; 2]> {
    let whole = document.text.clone();
    let count = text.rows.len();
    let mut found = [None; 2];
    let mut joints = Vec::new();
    for (i, row) in text.rows.iter().enumerate() {
        let Some(end) = End::of(row, cells, &whole) else {
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
            let mistake = Diagnostic::new(span, format!("the row of the {name} is not the {place} one"));
            document.mistake(
                mistake.help("rows go from base to tool; a constant row between joints is of the kind fixed"),
            );
            return None;
        }
        found[end as usize] = Some(placement(end, row, cells, convention, almost, document)?);
    }
    if found != [None; 2] {
        let is_zero = |cell: &Span| whole[cell.clone()].parse() == Ok(0.0);
        let placed = joints.iter().find_map(|row| {
            let mut places = PLACE.iter().filter_map(|(meaning, _)| cells.cell(row, *meaning));
            places.find(|(_, cell)| !is_zero(cell))
        });
        if let Some((_, cell)) = placed {
            let mistake = Diagnostic::new(cell, "the row of a joint has no place beside its four numbers");
            document.mistake(mistake.help("leave it empty: only the rows of base and tool have a place"));
            return None;
        }
    }
    text.rows = joints;
    Some(found)
}

fn placement(
    end: End,
    row: &[Span],
    cells: &Cells<'_>,
    convention: DhConvention,
    almost: &mut Almost,
    document: &mut Document,
) -> Option<Placement> {
    if let Some((_, cell)) = OF_JOINTS.iter().find_map(|meaning| cells.cell(row, *meaning)) {
        let mistake = Diagnostic::new(cell, format!("the {} does not move", end.name()));
        document.mistake(mistake.help("leave this cell empty"));
        return None;
    }
    let mut number = |(meaning, is_length): (Meaning, bool)| match cells.cell(row, meaning) {
        Some((column, cell)) => cells.number(&column, cell, is_length, document),
        None => Some(0.0),
    };
    let [x, y, z, roll, pitch, yaw] = {
        let six: Option<Vec<f64>> = PLACE.into_iter().map(&mut number).collect();
        six?.try_into().ok()?
    };
    let four: Option<Vec<f64>> = FOUR.into_iter().map(&mut number).collect();
    let [theta, d, a, alpha]: [f64; 4] = four?.try_into().ok()?;
    let placed = Placement { xyz: [x, y, z], rpy: [roll, pitch, yaw].map(|angle| almost.angle(angle)) };
    if [theta, d, a, alpha] == [0.0; 4] {
        return Some(placed);
    }
    if placed != Placement::default() {
        let span = row.first()?.start..row.last()?.end;
        let mistake = Diagnostic::new(span, format!("this row says twice where the {} is", end.name()));
        document.mistake(mistake.help("leave the four numbers empty, or x, y, z, roll, pitch and yaw"));
        return None;
    }
    let [theta, alpha] = [theta, alpha].map(|angle| almost.angle(angle));
    let geometry = Geometry::Numbers(Numbers { convention, theta, d, a, alpha });
    Some(Placement::from_motion(&(geometry.before() * geometry.after())))
}
