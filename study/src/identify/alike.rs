//! What cannot be told apart, by name.

use abbe::identify::{Group, Model, Reason, Unknown};
use abbe::{Description, VariableKind};
use serde::Serialize;

/// Unknowns that cannot be told apart: a combination that acts as another, or cannot be seen at all.
#[derive(Clone, Debug, Serialize)]
pub struct Alike {
    /// The combination: names and factors.
    pub these: Vec<(String, f64)>,
    /// What acts the same; nothing if it cannot be seen.
    pub act_as: Vec<(String, f64)>,
    /// Why.
    pub reason: String,
}

impl Alike {
    pub(crate) fn new(group: &Group, model: &Model, description: &Description) -> Self {
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

/// Why, with the names of the spec.
fn reason(reason: Reason, description: &Description) -> String {
    let name = |variable: usize| &description.variables[variable].name;
    match reason {
        Reason::Commutes(variable) => match description.variables[variable].kind {
            VariableKind::Revolute => {
                format!(
                    "{} turns: turns about its axis and shifts along it stay what they are behind it",
                    name(variable)
                )
            }
            VariableKind::Prismatic => {
                format!(
                    "{} slides: all shifts and turns about its direction stay what they are behind it",
                    name(variable)
                )
            }
        },
        Reason::Still(variable) => format!("{} is not moved in these data", name(variable)),
        Reason::Fixed(frame) => {
            format!("nothing moves at frame {} ({})", frame + 1, description.frames[frame].name)
        }
        Reason::Tool => "the place of the target on the tool is unknown too".to_owned(),
        Reason::Unseen => "turns about a single target do not move it".to_owned(),
    }
}
