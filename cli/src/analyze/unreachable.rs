//! What of the workspace could not be reached, and why.

use abbe::Description;
use abbe::analysis::{Configuration, ReachError, Unreachable, UnreachableSummary};
use serde::Serialize;

use abbe_study::number;

/// How many are shown one by one.
const SHOWN: usize = 3;

/// A reason, and how often it occurs.
#[derive(Serialize)]
pub(super) struct Reason {
    reason: String,
    count: usize,
}

/// The reasons, the most frequent first.
pub(super) fn reasons(unreachable: &UnreachableSummary, description: &Description) -> Vec<Reason> {
    let name = |reason: &ReachError| match reason {
        ReachError::OutOfReach { .. } => "out of reach".to_owned(),
        ReachError::OutsideLimits { variable, .. } => {
            format!("{} outside its limits", description.variables[*variable].name)
        }
        ReachError::Evaluation(error) => error.to_string(),
    };
    unreachable.reasons.iter().map(|(reason, count)| Reason { reason: name(reason), count: *count }).collect()
}

/// The reasons in a sentence.
pub(super) fn summary(unreachable: &UnreachableSummary, description: &Description) -> String {
    let reasons = reasons(unreachable, description);
    reasons.iter().map(|r| format!("{} ({})", r.reason, r.count)).collect::<Vec<_>>().join(", ")
}

/// The first few: what was asked for, and why it could not be had.
pub(super) fn first_few(
    unreachable: &UnreachableSummary,
    home: &Configuration,
    description: &Description,
) -> Vec<String> {
    let shown = unreachable.first.iter().take(SHOWN).map(|unreachable| {
        let asked = match unreachable.point {
            Some(point) => {
                let [x, y, z] = point.map(number::short);
                format!("({x}, {y}, {z}) {}", description.length.symbol())
            }
            None => number::configuration(&unreachable.asked, home, description),
        };
        format!("{asked}: {}", reason(unreachable, description))
    });
    shown.collect()
}

/// Why it could not be had, with names and units.
pub(super) fn reason(unreachable: &Unreachable, description: &Description) -> String {
    match unreachable.reason {
        ReachError::OutOfReach { residual, .. } => {
            format!("out of reach, at best {} away", number::length(residual, description.length))
        }
        ReachError::OutsideLimits { variable, value, limits: [lower, upper] } => {
            let variable = &description.variables[variable];
            let show = |value| number::of_variable(value, variable.kind, description.length);
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
