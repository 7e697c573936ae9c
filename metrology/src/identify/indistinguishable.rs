//! Errors that the data cannot distinguish, by name.

use abbe::identify::{Group, Model, Reason, Unknown, groups};
use abbe::{Component, Description, Error, VariableKind};
use serde::Serialize;

/// Combination of unknowns that is equivalent to another, or that has no effect on the measurement.
#[derive(Clone, Debug, Serialize)]
pub struct Indistinguishable {
    /// Combination: names and factors.
    pub these: Vec<(String, f64)>,
    /// Equivalent combination; empty if these unknowns have no effect on the measurement.
    pub act_as: Vec<(String, f64)>,
    /// Reason.
    pub reason: IndistinguishableReason,
}

/// Reason why errors cannot be distinguished.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum IndistinguishableReason {
    /// Errors about and along the axis of this revolute joint act as those of the next frame.
    Revolute(String),
    /// Translations, and rotations about the axis of this prismatic joint, act as those of the
    /// next frame.
    Prismatic(String),
    /// This joint does not move in these data.
    NotMoved(String),
    /// No joint moves this frame relative to the previous one.
    Fixed {
        /// Number of the frame, from 1.
        frame: usize,
        /// Name of the frame.
        name: String,
    },
    /// The mounting of the target on the tool is unknown.
    UnknownMounting,
    /// Rotations about a single target do not move it.
    SingleTarget,
    /// The placement of the instruments is unknown: motions of the whole machine act as it.
    UnknownPlacement,
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
    all.extend(of_base.map(|group| Indistinguishable {
        these: group.act_as.iter().map(|(unknown, factor)| (model.name(*unknown), *factor)).collect(),
        act_as: Vec::new(),
        reason: IndistinguishableReason::UnknownPlacement,
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
            reason: IndistinguishableReason::new(group.reason, description),
        }
    }
}

impl IndistinguishableReason {
    fn new(reason: Reason, description: &Description) -> Self {
        let name = |variable: usize| description.variables[variable].name.to_string();
        match reason {
            Reason::Commutes(variable) => match description.variables[variable].kind {
                VariableKind::Revolute => Self::Revolute(name(variable)),
                VariableKind::Prismatic => Self::Prismatic(name(variable)),
            },
            Reason::Still(variable) => Self::NotMoved(name(variable)),
            Reason::Fixed(i) => Self::Fixed { frame: i + 1, name: description.frames[i].name.to_string() },
            Reason::Tool => Self::UnknownMounting,
            Reason::Unseen => Self::SingleTarget,
        }
    }
}
