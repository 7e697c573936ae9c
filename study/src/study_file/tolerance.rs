//! Reads `tolerance`: the permitted errors of the tool, and the probability of meeting them.

use abbe::LengthUnit;
use abbe_spec::expr::Dimension;
use abbe_spec::option::{TOLERANCE, option};
use abbe_spec::{Diagnostic, Document, Item};

use super::choices::{JudgedMachine, MACHINES};
use super::keys;
use crate::{Result, options::quantity, workspace::positive};

/// Permitted errors of the tool.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Tolerance {
    /// Permitted position error of the tool point, in the length unit.
    pub(super) position: Option<f64>,
    /// Permitted norm of rows 4–6, in rad.
    pub(super) orientation: Option<f64>,
    /// Probability with which the tolerance must be met; `None` if the study does not say.
    pub(super) probability: Option<f64>,
    /// Share of the machines that must meet it; `None` if the study does not say.
    pub(super) required_yield: Option<f64>,
    /// Largest share of the configurations that may be unreachable; 0 by default.
    pub(super) unreachable: f64,
    /// Machine whose verdict counts; `None` if the study does not say.
    pub(super) machine: Option<JudgedMachine>,
}

/// Parses limits given as options: a length limits the position error, an angle the orientation
/// error. Returns each with `true` for an angle; there is at most one of each.
pub(super) fn parse(texts: &[String], length: LengthUnit) -> Result<Vec<(bool, f64)>> {
    let mut limits: Vec<(bool, f64)> = Vec::new();
    for text in texts {
        let value = |dimension| quantity(TOLERANCE, text, length, dimension, "the tolerance");
        let is_angle = |text: &str| text.contains(char::is_alphabetic);
        let limit = match value(Dimension::LENGTH) {
            Ok(value) => (false, value),
            Err(refused) => match value(Dimension::NONE) {
                Ok(value) if is_angle(text) => (true, value),
                _ if text.trim().is_empty() => (false, 0.0),
                _ => return Err(refused),
            },
        };
        let problem = match limit {
            (_, value) if value <= 0.0 => Some("the tolerance must be positive"),
            (kind, _) if limits.iter().any(|(other, _)| *other == kind) => {
                Some("there are two tolerances of one kind: at most a length and an angle")
            }
            _ => None,
        };
        if let Some(message) = problem {
            let document = Document::new(TOLERANCE, text.as_str());
            let [length, angle] = ["0.5 mm", "0.5 mrad"].map(|value| option("tolerance", value));
            let help = format!("write `{length}` for the position, and `{angle}` for the orientation");
            document.mistake(Diagnostic::new(0..text.len(), message).help(help));
            return document.finish(None);
        }
        limits.push(limit);
    }
    Ok(limits)
}

/// Reads a length, or `{ position = "0.5 mm", orientation = "0.5 mrad", probability = 0.99 }`.
pub(super) fn read(item: &Item<'_>) -> Option<Tolerance> {
    if !item.is_table() {
        let position = positive(item, Dimension::LENGTH)?;
        return Some(Tolerance { position: Some(position), ..Tolerance::default() });
    }
    let section = item.section()?;
    section.check_keys(&[&keys::TOLERANCE]);
    let position = section.get("position").map(|item| positive(&item, Dimension::LENGTH));
    let number = |key: &str, most: f64, help: &str| {
        section.get(key).map(|item| {
            let value = item.quantity(Dimension::NONE)?;
            if value > 0.0 && value < most {
                return Some(value);
            }
            let message = match most {
                1.0 => format!("`{key}` must be between 0 and 1"),
                _ => format!("`{key}` must be positive"),
            };
            item.document.fail(Diagnostic::new(item.span(), message).label("out of range").help(help))
        })
    };
    let orientation = number("orientation", f64::INFINITY, "write an angle such as \"0.5 mrad\"");
    let probability = number("probability", 1.0, "write 0.95 for 95 %");
    let required_yield = number("yield", 1.0, "write 0.95 for 95 %");
    let unreachable = number("unreachable", 1.0, "write 0.1 for 10 %");
    let machine = section.get("machine").and_then(|item| item.choice(&MACHINES));
    if position.is_none() && orientation.is_none() {
        let mistake = Diagnostic::new(item.span(), "this tolerance is empty").label("no limit is given");
        let help = "give `position`, a length, or `orientation`, an angle, or both";
        return item.document.fail(mistake.help(help));
    }
    // A value that is present but invalid has already been reported.
    let unread = |given: Option<Option<f64>>| given == Some(None);
    if [position, orientation, probability, required_yield, unreachable].into_iter().any(unread) {
        return None;
    }
    Some(Tolerance {
        position: position.flatten(),
        orientation: orientation.flatten(),
        probability: probability.flatten(),
        required_yield: required_yield.flatten(),
        unreachable: unreachable.flatten().unwrap_or_default(),
        machine,
    })
}
