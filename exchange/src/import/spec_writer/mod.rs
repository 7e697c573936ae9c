//! Text of the spec of a chain.
//!
//! `transform` writes where a frame stands, `number` numbers and angles.

mod number;
mod transform;

use std::f64::consts::TAU;
use std::fmt::Write;

use abbe_spec::as_identifier;
use abbe_spec::literal::quoted;

use self::number::{angle, number, quoted_if_expression, three};
use self::transform::{origin, transform};
use super::chain::{Chain, Mass, Variable};
use crate::placement::Placement;

/// Writes the spec of a chain; `file` is the name of the file that it comes from.
pub(super) fn spec(chain: &Chain, file: &str) -> String {
    let Chain { robot, tip, frames, tool, masses, .. } = chain;
    let mut text = format!(
        "[manipulator]\nname = {}\ntitle = {}\ndescription = {}\nlength = {}\n",
        quoted(&as_identifier(robot)),
        quoted(robot),
        quoted(&format!("{}, imported from {file}", chain.description)),
        quoted(chain.length.symbol()),
    );
    if !masses.is_empty() {
        text += "gravity = [0, 0, \"-9.80665 m/s^2\"]         # where z of the base points up\n";
    }
    for (i, frame) in frames.iter().enumerate() {
        text += "\n[[frame]]\n";
        line(&mut text, "name", &quoted(&frame.joint));
        if let Some(link) = &frame.link {
            line(&mut text, "description", &quoted(&format!("Link {link}")));
        }
        let owned = frame.motion.filter(|motion| chain.owner(motion.variable) == i);
        if let Some(motion) = owned {
            let variable = &chain.variables[motion.variable];
            let endless = if variable.continuous { "       # turns without end" } else { "" };
            line(&mut text, "variable", &(self::variable(variable, chain.degrees) + endless));
        }
        text += &transform(chain, frame, owned.is_some());
    }
    if *tool != Placement::default() {
        let _ = write!(text, "\n[tool]\n");
        if frames.iter().any(|frame| frame.link.is_some()) {
            line(&mut text, "description", &quoted(&format!("Link {tip}")));
        }
        line(&mut text, "origin", &origin(tool));
    }
    for Mass { link, kilograms, frame, centre } in masses {
        text += "\n[[load]]\n";
        line(&mut text, "name", &quoted(link));
        line(&mut text, "mass", &quoted(&format!("{} kg", number(*kilograms))));
        line(&mut text, "frame", &quoted(&frames[*frame].joint));
        line(&mut text, "point", &three(centre));
    }
    text
}

/// Writes a line `key = value`.
fn line(text: &mut String, key: &str, value: &str) {
    let _ = writeln!(text, "{key} = {value}");
}

/// Writes the inline table of a variable.
fn variable(variable: &Variable, degrees: bool) -> String {
    let Variable { name, prismatic, limits, continuous, .. } = variable;
    let kind = if *prismatic { "prismatic" } else { "revolute" };
    let limits = match limits {
        _ if *continuous => ", limits = [\"-pi\", \"pi\"]".to_owned(),
        None => String::new(),
        Some([lower, upper]) => {
            let value = |value: f64| match degrees && !prismatic {
                true => quoted_if_expression(&angle(value, true)),
                // Without its unit, a whole number of more than one revolution is a mistake.
                false if !prismatic && value.abs() > TAU => quoted(&format!("{} rad", number(value))),
                false => number(value),
            };
            let home = match *lower > 0.0 || *upper < 0.0 {
                true => format!(", home = {}", value(0.5 * (lower + upper))),
                false => String::new(),
            };
            format!(", limits = [{}, {}]{home}", value(*lower), value(*upper))
        }
    };
    format!("{{ name = {}, kind = \"{kind}\"{limits} }}", quoted(name))
}
