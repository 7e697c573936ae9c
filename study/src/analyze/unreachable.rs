//! What of the workspace could not be reached, and why.

use abbe::analysis::{Configuration, ReachError, Unreachable, UnreachableSummary};
use abbe_spec::Spec;
use serde::Serialize;

use crate::number;

/// How many are shown one by one.
const SHOWN: usize = 3;

/// A reason, and how often it occurs.
#[derive(Clone, Debug, Serialize)]
pub struct Reason {
    /// Why.
    pub reason: String,
    /// How often.
    pub count: usize,
}

/// The reasons, the most frequent first.
pub fn reasons(unreachable: &UnreachableSummary, spec: &Spec) -> Vec<Reason> {
    let name = |reason: &ReachError| match reason {
        ReachError::OutOfReach { .. } => "out of reach".to_owned(),
        ReachError::OutsideLimits { variable, .. } => {
            format!("{} outside its limits", spec.variables[*variable].name)
        }
        ReachError::Evaluation(error) => error.to_string(),
    };
    unreachable.reasons.iter().map(|(reason, count)| Reason { reason: name(reason), count: *count }).collect()
}

/// The reasons in a sentence.
pub fn summary(unreachable: &UnreachableSummary, spec: &Spec) -> String {
    let reasons = reasons(unreachable, spec);
    reasons.iter().map(|r| format!("{} ({})", r.reason, r.count)).collect::<Vec<_>>().join(", ")
}

/// The first few: what was asked for, and why it could not be had.
pub fn first_few(unreachable: &UnreachableSummary, home: &Configuration, spec: &Spec) -> Vec<String> {
    let shown = unreachable.first.iter().take(SHOWN).map(|unreachable| {
        let asked = match unreachable.point {
            Some(point) => {
                let [x, y, z] = point.map(number::short);
                format!("({x}, {y}, {z}) {}", spec.length.symbol())
            }
            None => number::configuration(&unreachable.asked, home, spec),
        };
        format!("{asked}: {}", reason(unreachable, spec))
    });
    shown.collect()
}

/// Why it could not be had, with names and units.
pub fn reason(unreachable: &Unreachable, spec: &Spec) -> String {
    match unreachable.reason {
        ReachError::OutOfReach { residual, .. } => {
            format!("out of reach, at best {} away", number::length(residual, spec.length))
        }
        ReachError::OutsideLimits { variable, value, limits: [lower, upper] } => {
            let variable = &spec.variables[variable];
            let show = |value| number::of_variable(value, variable.kind, spec.length);
            let name = &variable.name;
            format!(
                "{name} would have to be {}, its limits are {} … {}",
                show(value),
                show(lower),
                show(upper)
            )
        }
        ReachError::Evaluation(error) => error.to_string(),
    }
}
