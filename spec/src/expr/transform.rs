//! Products of elementary motions: `Tx(d1) Ry(q4) Tz(300 mm)`.

use abbe_core::Component;

use super::parse::{Parsed, Parser, parsed};
use super::scope::Allowed;
use super::tokens::Token;
use super::{Dimension, Entry, Expression, LocatedText, Scope};
use crate::diagnostic::{Diagnostic, suggestion};

/// Kind of an elementary motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// Translation along its axis.
    Translation,
    /// Rotation about its axis.
    Rotation,
}

/// Returns the motion of a generalized error and its axis: 0 = x, 1 = y, 2 = z.
pub fn motion(component: Component) -> (Motion, usize) {
    let motion = if component.is_rotation() { Motion::Rotation } else { Motion::Translation };
    (motion, component.axis())
}

/// One factor of a transform.
#[derive(Clone, Debug, PartialEq)]
pub struct Elementary {
    /// Translation or rotation.
    pub motion: Motion,
    /// Axis: 0 = x, 1 = y, 2 = z.
    pub axis: usize,
    /// Distance in the spec's length unit, or angle in rad.
    pub amount: Expression,
}

const NAMES: [&str; 6] = ["Tx", "Ty", "Tz", "Rx", "Ry", "Rz"];

/// Parses and checks a product of elementary motions. Mistakes are recorded in `found`, and the
/// result is then `None`.
pub(crate) fn parse_transform(
    text: &LocatedText<'_>,
    scope: &Scope,
    found: &mut Vec<Diagnostic>,
) -> Option<Vec<Elementary>> {
    parsed(text, scope, found, |parser| {
        let mut factors = Vec::new();
        while parser.peek() != Token::End {
            factors.push(factor(parser)?);
            parser.accept('*');
        }
        Ok(factors)
    })
}

fn factor(parser: &mut Parser<'_>) -> Parsed<Elementary> {
    let expected = "Tx, Ty, Tz, Rx, Ry or Rz";
    let Token::Word(name) = parser.peek() else {
        return Err(parser.unexpected(expected));
    };
    let Some(index) = NAMES.iter().position(|known| *known == name) else {
        return Err(Diagnostic::new(parser.here(), format!("unknown motion `{name}`"))
            .label(format!("expected {expected}"))
            .help(suggestion(0, name, &NAMES, "motions")));
    };
    parser.advance();
    let axis = index % 3;
    let (motion, dimension, verb) = if index < 3 {
        (Motion::Translation, Dimension::LENGTH, "translation along")
    } else {
        (Motion::Rotation, Dimension::NONE, "rotation about")
    };
    let what = format!("the {verb} {}", ["x", "y", "z"][axis]);
    parser.expect('(')?;
    let amount = parser.entry(Entry { dimension: Some(dimension), what: &what, names: Allowed::Geometry })?;
    parser.expect(')')?;
    Ok(Elementary { motion, axis, amount })
}
