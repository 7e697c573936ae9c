//! Rows of a table as joints.

use abbe_spec::{DhConvention, Diagnostic, Document, Notes, as_identifier, diagnostic::Span};

use super::cell::{Amount, Cells};
use super::heading::Quantity;
use super::text::Text;
use crate::import::AngleRounding;
use crate::import::chain::{DhRow, Frame, Geometry, Motion, Variable};

/// Joint of a row.
pub(super) struct Joint {
    name: String,
    /// Motion; `None` for a fixed joint.
    motion: Option<JointMotion>,
    /// theta, d, a and alpha without the variable.
    numbers: [f64; 4],
}

/// Motion of a joint by its own variable.
struct JointMotion {
    prismatic: bool,
    variable: String,
    span: Span,
    sign: f64,
    /// Variable of an earlier row that is added, with its sign.
    with: Option<(String, f64)>,
    offset: f64,
    limits: Option<[f64; 2]>,
    /// The row names its variable.
    is_named: bool,
    /// The row says that it moves: by that name, its kind, its limits, or no number in its place.
    is_stated: bool,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Fixed,
    Revolute,
    Prismatic,
}

/// Words of the column `kind`; the Robotics Toolbox writes 0 and 1.
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

/// Reads the joints of all rows; mistakes go to the document.
pub(super) fn read(text: &Text, cells: &Cells<'_>, notes: &mut dyn Notes) -> Vec<Joint> {
    let document = cells.document;
    let mut joints: Vec<Joint> = Vec::new();
    for (i, row) in text.rows.iter().enumerate() {
        let Some(joint) = joint(i, row, &joints, cells) else { continue };
        let same = |other: &&Joint| match (&other.motion, &joint.motion) {
            (Some(other), Some(this)) => other.variable == this.variable,
            _ => false,
        };
        if let (Some(Joint { motion: Some(first), .. }), Some(this)) =
            (joints.iter().find(same), &joint.motion)
        {
            let message = format!("`{}` is the variable of two rows", this.variable);
            let help = "give each row its own variable; if one joint moves two axes, write both in \
                the row of the second: `q3 + q2`";
            let mistake =
                Diagnostic::new(this.span.clone(), message).context(first.span.clone(), "first row");
            document.mistake(mistake.label("again").help(help));
        }
        if joints.iter().any(|other| other.name == joint.name) {
            let span = cells.cell(row, Quantity::Name).map_or(0..0, |(_, cell)| cell);
            let mistake = Diagnostic::new(span, format!("duplicate row name `{}`", joint.name));
            document.mistake(mistake.label("again").help("give each row its own name"));
        }
        joints.push(joint);
    }
    let motions = || joints.iter().filter_map(|joint| joint.motion.as_ref());
    let is_named = motions().any(|motion| motion.is_named) && document.mistakes() == 0;
    let used: Vec<String> = motions().filter_map(|motion| Some(motion.with.as_ref()?.0.clone())).collect();
    for joint in joints.iter_mut().filter(|_| is_named) {
        let Joint { name, motion, numbers } = joint;
        if let Some(JointMotion { offset, .. }) =
            motion.take_if(|motion| !motion.is_stated && !used.contains(&motion.variable))
        {
            numbers[0] = offset;
            notes.note(&format!(
                "`{name}` is fixed: its row has numbers only, and others name their variables"
            ));
        }
    }
    if document.mistakes() == 0 && joints.iter().all(|joint| joint.motion.is_none()) {
        let mistake = Diagnostic::new(cells.columns.span.clone(), "this table has no joint variable");
        document.mistake(mistake.help("write `revolute` or `prismatic` in the column `kind` of each joint"));
    }
    let slides = joints.iter().flat_map(|joint| &joint.motion).any(|motion| motion.prismatic);
    // After a mistake only mistakes are reported.
    if document.mistakes() == 0 && cells.columns.get(Quantity::Kind).is_none() && !slides && !is_named {
        notes.note(
            "the table has no column `kind` and no variable in `d`: all joints were read \
            as revolute",
        );
    }
    joints
}

/// Reads row `i`, counted from 0.
fn joint(i: usize, row: &[Span], earlier: &[Joint], cells: &Cells<'_>) -> Option<Joint> {
    let document = cells.document;
    let whole = document.text.clone();
    let theta = cells.amount(row, Quantity::Theta);
    let d = cells.amount(row, Quantity::D);
    let plain = |quantity| match cells.cell(row, quantity) {
        Some((column, cell)) => cells.number(&column, cell, quantity == Quantity::A),
        None => Some(0.0),
    };
    let (a, alpha) = (plain(Quantity::A), plain(Quantity::Alpha));
    let stated = match cells.cell(row, Quantity::Kind) {
        None => None,
        Some((_, cell)) => Some(kind(&whole, cell, document)?),
    };
    let (mut theta, mut d, a, alpha) = (theta?, d?, a?, alpha?);
    let is_earlier = |name: &str| {
        earlier.iter().any(|joint| joint.motion.as_ref().is_some_and(|motion| motion.variable == name))
    };
    let mut with = None;
    for (quantity, variables) in [(Quantity::Theta, &mut theta.variables), (Quantity::D, &mut d.variables)] {
        // `q3 - q2`: the variable of an earlier row turns this one, too.
        let shared =
            variables.iter().position(|(name, ..)| is_earlier(name)).filter(|_| variables.len() == 2);
        if let Some((name, span, sign)) = shared.map(|at| variables.remove(at)) {
            let is_angle = quantity == Quantity::Theta;
            let motions = earlier.iter().filter_map(|joint| joint.motion.as_ref());
            if motions.filter(|motion| motion.variable == name).any(|motion| motion.prismatic == is_angle) {
                let help = "angles take angles, and lengths take lengths";
                return document.refuse(span, format!("`{name}` moves a joint of the other kind"), help);
            }
            with = Some((name, sign));
        }
        if let [_, (name, span, _), ..] = &variables[..] {
            let mistake = Diagnostic::new(span.clone(), format!("`{name}` is no variable of a row above"));
            let help = "a row has one variable of its own, and may add one of a row above: `q3 - q2`";
            return document.fail(mistake.help(help));
        }
    }
    let own = |amount: &Amount| amount.variables.first().cloned();
    let [in_theta, in_d] = [own(&theta), own(&d)];
    let whole_row = row.first()?.start..row.last()?.end;
    let kind = match (stated, &in_theta, &in_d) {
        (_, Some((_, first, _)), Some((_, second, _))) => {
            let mistake = Diagnostic::new(second.clone(), "this row has two variables");
            let help = "a row has one variable: write a joint that both rotates and translates as \
                two rows";
            return document
                .fail(mistake.context(first.clone(), "first variable").label("second variable").help(help));
        }
        (Some(Kind::Revolute | Kind::Fixed), None, Some((name, span, _)))
        | (Some(Kind::Prismatic | Kind::Fixed), Some((name, span, _)), None) => {
            let message = format!("the column of the variable `{name}` does not match the `kind` of the row");
            let help = "a prismatic joint has its variable in `d`, a revolute joint in `theta`, and a \
                 fixed row has none";
            return document.refuse(span.clone(), message, help);
        }
        (None, None, Some(_)) => Kind::Prismatic,
        (None, ..) => Kind::Revolute,
        (Some(kind), ..) => kind,
    };
    let stated_name = cells.cell(row, Quantity::Name).map(|(_, cell)| (whole[cell.clone()].to_owned(), cell));
    let name = match &stated_name {
        Some((name, _)) if !name.chars().all(|c| c.is_ascii_digit()) => name.clone(),
        _ => format!("joint {}", i + 1),
    };
    if kind == Kind::Fixed {
        return Some(Joint { name, motion: None, numbers: [theta.constant, d.constant, a, alpha] });
    }
    let prismatic = kind == Kind::Prismatic;
    let (variable, constant) = if prismatic { (in_d, d.constant) } else { (in_theta, theta.constant) };
    let has_number = cells.cell(row, Quantity::Theta).is_some();
    let number = |quantity| match cells.cell(row, quantity) {
        Some((column, cell)) => cells.number(&column, cell, prismatic).map(Some),
        None => Some(None),
    };
    let (offset, lower, upper) =
        (number(Quantity::Offset)?, number(Quantity::Lower)?, number(Quantity::Upper)?);
    if let (Some(offset), Some((_, cell))) = (offset, cells.cell(row, Quantity::Offset))
        && offset != 0.0
        && constant != 0.0
    {
        let message = "this row has two constants added to its variable";
        let help = "give the constant either with the variable or in the column `offset`";
        return document.fail(Diagnostic::new(cell, message).label("and in `theta` or `d`").help(help));
    }
    let limits = match (lower, upper) {
        (Some(lower), Some(upper)) if lower < upper => Some([lower, upper]),
        (None, None) => None,
        _ => {
            let upper = cells.cell(row, Quantity::Upper).or_else(|| cells.cell(row, Quantity::Lower));
            let span = upper.map_or(whole_row, |(_, cell)| cell);
            return document.refuse(
                span,
                format!("invalid limits of `{name}`"),
                "`lower` must be less than `upper`; leave both cells empty if there \
                    are no limits",
            );
        }
    };
    let flipped = match cells.cell(row, Quantity::Sign) {
        None => false,
        Some((_, cell)) => match whole[cell.clone()].replace('−', "-").parse::<f64>() {
            Ok(1.0) => false,
            Ok(-1.0) => true,
            _ => {
                let help = "1 is positive about or along z, -1 is negative";
                return document.refuse(cell, "expected the sign 1 or -1", help);
            }
        },
    };
    let own = || match (&stated_name, prismatic) {
        (Some((name, _)), _) if !name.chars().all(|c| c.is_ascii_digit()) => as_identifier(name),
        (_, true) => format!("d{}", i + 1),
        (_, false) => format!("q{}", i + 1),
    };
    let span = stated_name.as_ref().map_or(whole_row, |(_, cell)| cell.clone());
    let is_named = variable.is_some();
    let is_stated = stated.is_some() || is_named || limits.is_some() || !has_number;
    let (variable, span, sign) = variable.unwrap_or_else(|| (own(), span, 1.0));
    let (theta, d) = if prismatic { (theta.constant, 0.0) } else { (0.0, d.constant) };
    let motion = JointMotion {
        prismatic,
        variable,
        span,
        sign: if flipped { -sign } else { sign },
        with,
        offset: constant + offset.unwrap_or_default(),
        limits,
        is_named,
        is_stated,
    };
    Some(Joint { name, motion: Some(motion), numbers: [theta, d, a, alpha] })
}

/// Reads a word of the column `kind`.
fn kind(whole: &str, cell: Span, document: &Document) -> Option<Kind> {
    let word = whole[cell.clone()].to_lowercase();
    let found = KINDS.iter().find(|(name, _)| *name == word).map(|(_, kind)| *kind);
    if found.is_none() {
        let message = format!("unknown kind `{}`", whole[cell.clone()].escape_debug());
        document.mistake(Diagnostic::new(cell, message).help(
            "the kinds are revolute, prismatic and fixed; base for the first row, tool for the \
             last",
        ));
    }
    found
}

/// Converts joints to the variables and frames of a chain.
pub(super) fn frames(
    joints: Vec<Joint>,
    convention: DhConvention,
    angles: &mut AngleRounding,
) -> (Vec<Variable>, Vec<Frame>) {
    let (mut variables, mut frames) = (Vec::new(), Vec::new());
    for Joint { name, motion, numbers: [theta, d, a, alpha] } in joints {
        let [theta, alpha] = [theta, alpha].map(|angle| angles.angle(angle));
        let motion = motion.map(|JointMotion { prismatic, variable, sign, with, offset, limits, .. }| {
            let index = |(name, sign): (String, f64)| {
                Some((variables.iter().position(|one: &Variable| one.name == name)?, sign))
            };
            let with = with.and_then(index);
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
                multiplier: sign,
                with,
                offset: if prismatic { offset } else { angles.angle(offset) },
            }
        });
        let geometry = Geometry::DenavitHartenberg(DhRow { convention, theta, d, a, alpha });
        frames.push(Frame { joint: name, link: None, geometry, motion, upward: false });
    }
    (variables, frames)
}
