//! Text of the spec of a chain.
//!
//! `transform` writes where a frame stands, in numbers and angles.

mod transform;

use std::f64::consts::TAU;

use abbe_spec::{as_identifier, edit::TableText, edit::write::quoted};

use self::transform::{origin, transform};
use super::chain::{Chain, Mass, Variable};
use crate::placement::Placement;
use transform::{angle, number, quoted_if_expression, three};

/// Writes the spec of a chain; `file` is the name of the file that it comes from.
pub(super) fn spec(chain: &Chain, file: &str) -> String {
    let Chain { robot, tip, frames, tool, masses, .. } = chain;
    let mut text = TableText::with_header("[manipulator]")
        .text("name", &as_identifier(robot))
        .text("title", robot)
        .text("description", &format!("{}, imported from {file}", chain.description))
        .text("length", chain.length.symbol());
    if !masses.is_empty() {
        text = text.then("gravity = [0, 0, \"-9.80665 m/s^2\"]         # where z of the base points up\n");
    }
    let link = |name: &String| quoted(&format!("Link {name}"));
    for (i, frame) in frames.iter().enumerate() {
        text = text.then(TableText::with_header("\n[[frame]]").text("name", &frame.joint));
        text = text.optional("description", frame.link.as_ref().map(link));
        let owned = frame.motion.filter(|motion| chain.owner(motion.variable) == i);
        if let Some(motion) = owned {
            let variable = &chain.variables[motion.variable];
            let endless = if variable.continuous { "       # turns without end" } else { "" };
            text = text.key("variable", self::variable(variable, chain.degrees) + endless);
        }
        text = text.then(transform(chain, frame, owned.is_some()));
    }
    if *tool != Placement::default() {
        let has_links = frames.iter().any(|frame| frame.link.is_some());
        text = text
            .then(TableText::with_header("\n[tool]"))
            .optional("description", has_links.then(|| link(tip)));
        text = text.key("origin", origin(tool));
    }
    for Mass { link, kilograms, frame, centre } in masses {
        let load = TableText::with_header("\n[[load]]")
            .text("name", link)
            .text("mass", &format!("{} kg", number(*kilograms)));
        text = text.then(load.text("frame", &frames[*frame].joint).key("point", three(centre)));
    }
    text.to_string()
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
