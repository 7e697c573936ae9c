//! The rows of a table as joints.

use abbe_spec::diagnostic::{Diagnostic, Span};
use abbe_spec::document::Document;
use abbe_spec::{DhConvention, as_identifier};

use super::cell::{Amount, Cells};
use super::columns::Meaning;
use super::text::Text;
use crate::import::almost::Almost;
use crate::import::chain::{Frame, Motion, Variable};
use crate::import::geometry::{Geometry, Numbers};
use crate::notes::Notes;

/// A row.
pub(super) struct Joint {
    name: String,
    moved: Option<Moved>,
    numbers: [f64; 4],
}

/// What moves it.
struct Moved {
    prismatic: bool,
    variable: String,
    span: Span,
    reversed: bool,
    offset: f64,
    limits: Option<[f64; 2]>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Fixed,
    Revolute,
    Prismatic,
}

/// The words for kinds; the Robotics Toolbox says 0 and 1.
const KINDS: [(&str, Kind); 10] = [
    ("revolute", Kind::Revolute),
    ("rotational", Kind::Revolute),
    ("r", Kind::Revolute),
    ("0", Kind::Revolute),
    ("prismatic", Kind::Prismatic),
    ("linear", Kind::Prismatic),
    ("p", Kind::Prismatic),
    ("1", Kind::Prismatic),
    ("fixed", Kind::Fixed),
    ("f", Kind::Fixed),
];

/// The joints of all rows; what is wrong goes to the document.
pub(super) fn joints(
    text: &Text,
    cells: &Cells<'_>,
    document: &mut Document,
    notes: &mut dyn Notes,
) -> Vec<Joint> {
    let mut joints: Vec<Joint> = Vec::new();
    for (i, row) in text.rows.iter().enumerate() {
        let Some(joint) = joint(i, row, cells, document) else { continue };
        let same = |other: &&Joint| match (&other.moved, &joint.moved) {
            (Some(other), Some(this)) => other.variable == this.variable,
            _ => false,
        };
        if let (Some(Joint { moved: Some(first), .. }), Some(this)) = (joints.iter().find(same), &joint.moved)
        {
            let message = format!("`{}` moves two rows", this.variable);
            let help = "give each row a variable of its own; where one joint moves two axes, write that into the spec: \
                        `theta = \"q3 + q2\"`";
            let mistake =
                Diagnostic::new(this.span.clone(), message).context(first.span.clone(), "the first");
            document.mistake(mistake.label("again").help(help));
        }
        if joints.iter().any(|other| other.name == joint.name) {
            let span = cells.cell(row, Meaning::Name).map_or(0..0, |(_, cell)| cell);
            let mistake = Diagnostic::new(span, format!("two rows are called `{}`", joint.name));
            document.mistake(mistake.label("again").help("give each row a name of its own"));
        }
        joints.push(joint);
    }
    if document.found.is_empty() && joints.iter().all(|joint| joint.moved.is_none()) {
        let mistake = Diagnostic::new(cells.columns.span.clone(), "nothing moves in this table");
        document.mistake(mistake.help("`kind` says `revolute` or `prismatic` where a joint is"));
    }
    let named = joints.iter().flat_map(|joint| &joint.moved).any(|moved| moved.prismatic);
    // Of rows that are not read nothing is said but what is wrong.
    if document.found.is_empty() && cells.columns.get(Meaning::Kind).is_none() && !named {
        notes.note("no column says which joints slide, and no `d` has a variable: all rows were read as joints that turn");
    }
    joints
}

fn joint(i: usize, row: &[Span], cells: &Cells<'_>, document: &mut Document) -> Option<Joint> {
    let whole = document.text.clone();
    let theta = cells.amount(row, Meaning::Theta, document);
    let d = cells.amount(row, Meaning::D, document);
    let mut plain = |meaning| match cells.cell(row, meaning) {
        Some((column, cell)) => cells.number(&column, cell, meaning == Meaning::A, document),
        None => Some(0.0),
    };
    let (a, alpha) = (plain(Meaning::A), plain(Meaning::Alpha));
    let stated = match cells.cell(row, Meaning::Kind) {
        None => None,
        Some((_, cell)) => Some(kind(&whole, cell, document)?),
    };
    let (theta, d, a, alpha) = (theta?, d?, a?, alpha?);
    let whole_row = row.first()?.start..row.last()?.end;
    let kind = match (stated, &theta.variable, &d.variable) {
        (_, Some((_, first)), Some((_, second))) => {
            let mistake = Diagnostic::new(second.clone(), "this row has two variables");
            let help = "a row moves in one way: write a joint that turns and slides as two rows";
            document.mistake(mistake.context(first.clone(), "the first").label("the second").help(help));
            return None;
        }
        (Some(Kind::Revolute | Kind::Fixed), None, Some((name, span)))
        | (Some(Kind::Prismatic | Kind::Fixed), Some((name, span)), None) => {
            let message = format!("`{name}` moves what `kind` says does not move so");
            let help =
                "a prismatic joint has its variable in `d`, a revolute one in `theta`, a fixed one none";
            document.mistake(Diagnostic::new(span.clone(), message).help(help));
            return None;
        }
        (None, None, Some(_)) => Kind::Prismatic,
        (None, ..) => Kind::Revolute,
        (Some(kind), ..) => kind,
    };
    let stated_name = cells.cell(row, Meaning::Name).map(|(_, cell)| (whole[cell.clone()].to_owned(), cell));
    let name = match &stated_name {
        Some((name, _)) if !name.chars().all(|c| c.is_ascii_digit()) => name.clone(),
        _ => format!("joint {}", i + 1),
    };
    if kind == Kind::Fixed {
        return Some(Joint { name, moved: None, numbers: [theta.constant, d.constant, a, alpha] });
    }
    let prismatic = kind == Kind::Prismatic;
    let Amount { variable, reversed, constant } = if prismatic { d.clone() } else { theta.clone() };
    let mut number = |meaning| match cells.cell(row, meaning) {
        Some((column, cell)) => cells.number(&column, cell, prismatic, document).map(Some),
        None => Some(None),
    };
    let (offset, lower, upper) = (number(Meaning::Offset)?, number(Meaning::Lower)?, number(Meaning::Upper)?);
    if let (Some(offset), Some((_, cell))) = (offset, cells.cell(row, Meaning::Offset))
        && offset != 0.0
        && constant != 0.0
    {
        let message = "this row says twice what is added to its variable";
        let help = "leave it in one of the two: in the cell of the variable, or in `offset`";
        document.mistake(Diagnostic::new(cell, message).label("and in `theta` or `d`").help(help));
        return None;
    }
    let limits = match (lower, upper) {
        (Some(lower), Some(upper)) if lower < upper => Some([lower, upper]),
        (None, None) => None,
        _ => {
            let upper = cells.cell(row, Meaning::Upper).or_else(|| cells.cell(row, Meaning::Lower));
            let span = upper.map_or(whole_row, |(_, cell)| cell);
            let mistake = Diagnostic::new(span, format!("the limits of `{name}` are no range"));
            document.mistake(
                mistake.help("`lower` is the smaller one; leave both cells empty if there are none"),
            );
            return None;
        }
    };
    let flipped = match cells.cell(row, Meaning::Sign) {
        None => false,
        Some((_, cell)) => match whole[cell.clone()].replace('−', "-").parse::<f64>() {
            Ok(1.0) => false,
            Ok(-1.0) => true,
            _ => {
                document.mistake(
                    Diagnostic::new(cell, "a sign is 1 or -1").help("1 counts about z, -1 against it"),
                );
                return None;
            }
        },
    };
    let own = || match (&stated_name, prismatic) {
        (Some((name, _)), _) if !name.chars().all(|c| c.is_ascii_digit()) => as_identifier(name),
        (_, true) => format!("d{}", i + 1),
        (_, false) => format!("q{}", i + 1),
    };
    let span = stated_name.as_ref().map_or(whole_row, |(_, cell)| cell.clone());
    let (variable, span) = variable.unwrap_or_else(|| (own(), span));
    let (theta, d) = if prismatic { (theta.constant, 0.0) } else { (0.0, d.constant) };
    let moved = Moved {
        prismatic,
        variable,
        span,
        reversed: reversed != flipped,
        offset: constant + offset.unwrap_or_default(),
        limits,
    };
    Some(Joint { name, moved: Some(moved), numbers: [theta, d, a, alpha] })
}

fn kind(whole: &str, cell: Span, document: &mut Document) -> Option<Kind> {
    let word = whole[cell.clone()].to_lowercase();
    let found = KINDS.iter().find(|(name, _)| *name == word).map(|(_, kind)| *kind);
    if found.is_none() {
        let message = format!("there is no joint of the kind `{}`", whole[cell.clone()].escape_debug());
        document.mistake(Diagnostic::new(cell, message).help(
            "the kinds are revolute, prismatic and fixed, and base and tool of the first row and the last",
        ));
    }
    found
}

/// As a chain has them.
pub(super) fn frames(
    joints: Vec<Joint>,
    convention: DhConvention,
    almost: &mut Almost,
) -> (Vec<Variable>, Vec<Frame>) {
    let (mut variables, mut frames) = (Vec::new(), Vec::new());
    for Joint { name, moved, numbers: [theta, d, a, alpha] } in joints {
        let [theta, alpha] = [theta, alpha].map(|angle| almost.angle(angle));
        let motion = moved.map(|Moved { prismatic, variable, reversed, offset, limits, .. }| {
            variables.push(Variable {
                joint: name.clone(),
                name: variable,
                prismatic,
                limits,
                continuous: false,
            });
            Motion {
                prismatic,
                axis: [0.0, 0.0, 1.0],
                variable: variables.len() - 1,
                multiplier: if reversed { -1.0 } else { 1.0 },
                offset: if prismatic { offset } else { almost.angle(offset) },
            }
        });
        let geometry = Geometry::Numbers(Numbers { convention, theta, d, a, alpha });
        frames.push(Frame { joint: name, link: None, geometry, motion });
    }
    (variables, frames)
}
