//! Errors that the data cannot distinguish, by name.

use abbe::identify::{Group, Model, Reason, Unknown, groups};
use abbe::{Component, Description, Error, VariableKind};
use serde::Serialize;

use abbe_study::number;

/// Combination of unknowns that is equivalent to another, or that has no effect on the measurement.
#[derive(Clone, Debug, Serialize)]
pub struct Indistinguishable {
    /// Combination: names and factors.
    pub these: Vec<(String, f64)>,
    /// Equivalent combination; empty if these unknowns have no effect on the measurement.
    pub act_as: Vec<(String, f64)>,
    /// Reason, in words.
    pub reason: String,
}

/// Returns all combinations that cannot be distinguished if only the variables in `moved` move and
/// all others stay at `q`.
pub(crate) fn indistinguishable(
    model: &Model,
    q: &[f64],
    moved: &[usize],
    pose: bool,
) -> Result<Vec<Indistinguishable>, Error> {
    let description = model.manipulator.description();
    let found = groups(model, q, moved, pose)?;
    let mut all: Vec<Indistinguishable> =
        found.iter().map(|group| Indistinguishable::new(group, model, description)).collect();
    if model.observables.is_empty() || model.stations.iter().any(|station| !station.exact) {
        return Ok(all);
    }
    // Finds the fixtures that errors of the base are equivalent to, if any.
    let base = Component::ALL.map(|component| Unknown::Base(0, component));
    let with_base = model.with(base.into_iter().chain(model.unknowns.iter().copied()).collect());
    let of_base = groups(&with_base, q, moved, pose)?.into_iter().filter(|group| {
        let is_base = |(unknown, _): &(Unknown, f64)| matches!(unknown, Unknown::Base(..));
        !group.these.is_empty() && group.these.iter().all(is_base)
    });
    all.extend(of_base.map(|group| {
        Indistinguishable {
            these: group.act_as.iter().map(|(unknown, factor)| (model.name(*unknown), *factor)).collect(),
            act_as: Vec::new(),
            reason: "the placement of the instruments is unknown: motions of the whole machine \
                are indistinguishable from it"
                .to_owned(),
        }
    }));
    Ok(all)
}

impl Indistinguishable {
    fn new(group: &Group, model: &Model, description: &Description) -> Self {
        let named = |combination: &[(Unknown, f64)]| {
            combination.iter().map(|(unknown, factor)| (model.name(*unknown), *factor)).collect()
        };
        Self {
            these: named(&group.these),
            act_as: named(&group.act_as),
            reason: reason(group.reason, description),
        }
    }
}

impl Indistinguishable {
    /// Formats the combination as a sentence, such as `e_z1 acts as e_z2`.
    pub fn sentence(&self) -> String {
        let these = combination(&self.these);
        let verb = if self.these.len() == 1 { "acts" } else { "act" };
        if self.act_as.is_empty() {
            format!("{these} cannot be observed")
        } else {
            format!("{these} {verb} as {}", combination(&self.act_as))
        }
    }
}

/// Formats a combination, such as `e_r2 − 425 e_y2`.
pub(super) fn combination(terms: &[(String, f64)]) -> String {
    let mut text = String::new();
    for (name, factor) in terms {
        let size = number::digits(factor.abs(), 4);
        let factor_text = if size == "1" { String::new() } else { format!("{size} ") };
        let sign = match (text.is_empty(), *factor < 0.0) {
            (true, false) => "",
            (true, true) => "−",
            (false, false) => " + ",
            (false, true) => " − ",
        };
        text += &format!("{sign}{factor_text}{name}");
    }
    text
}

/// Describes the reason with the names of the spec.
fn reason(reason: Reason, description: &Description) -> String {
    let name = |variable: usize| &description.variables[variable].name;
    match reason {
        Reason::Commutes(variable) => match description.variables[variable].kind {
            VariableKind::Revolute => {
                format!(
                    "{} is revolute: errors about and along its axis are indistinguishable from \
                     those of the next frame",
                    name(variable)
                )
            }
            VariableKind::Prismatic => {
                format!(
                    "{} is prismatic: translations, and rotations about its axis, are \
                     indistinguishable from those of the next frame",
                    name(variable)
                )
            }
        },
        Reason::Still(variable) => format!("{} does not move in these data", name(variable)),
        Reason::Fixed(frame) => {
            format!("the frame {} ({}) is fixed", frame + 1, description.frames[frame].name)
        }
        Reason::Tool => "the mounting of the target on the tool is unknown".to_owned(),
        Reason::Unseen => "rotations about a single target do not move it".to_owned(),
    }
}
