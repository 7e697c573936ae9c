//! Unreachable configurations of the workspace, with reasons.

use abbe::analysis::{Configuration, ReachError, Unreachable, UnreachableSummary};
use abbe_spec::Spec;
use serde::Serialize;

use crate::number;
use crate::open_loops::open_loops;

/// Reason why configurations are unreachable, with its count.
#[derive(Clone, Debug, Serialize)]
pub struct UnreachableReason {
    /// Description of the reason.
    pub reason: String,
    /// Number of configurations with this reason.
    pub count: usize,
}

/// Returns the reasons, most frequent first.
pub fn unreachable_reasons(unreachable: &UnreachableSummary, spec: &Spec) -> Vec<UnreachableReason> {
    let name = |reason: &ReachError| match reason {
        ReachError::OutOfReach { .. } => "out of reach".to_owned(),
        ReachError::OutsideLimits { variable, .. } => {
            format!("{} outside its limits", spec.variables[*variable].name)
        }
        ReachError::OutsideSumLimit { limit, .. } => {
            format!("{} outside its limits", spec.sum_limits[*limit].sum)
        }
        ReachError::Evaluation(error) => error.to_string(),
    };
    unreachable
        .reasons
        .iter()
        .map(|(reason, count)| UnreachableReason { reason: name(reason), count: *count })
        .collect()
}

/// Returns the reasons in one sentence.
pub fn unreachable_summary(unreachable: &UnreachableSummary, spec: &Spec) -> String {
    let reasons = unreachable_reasons(unreachable, spec);
    reasons.iter().map(|r| format!("{} ({})", r.reason, r.count)).collect::<Vec<_>>().join(", ")
}

/// Describes the reason with names and units.
pub fn unreachable_reason(unreachable: &Unreachable, spec: &Spec) -> String {
    match unreachable.reason {
        ReachError::OutOfReach { residual, .. } => {
            format!("out of reach by {}", number::length(residual, spec.length))
        }
        ReachError::OutsideLimits { variable, value, limits: [lower, upper] } => {
            let variable = &spec.variables[variable];
            let show = |value| number::of_variable(value, variable.kind, spec.length);
            let name = &variable.name;
            format!("needs {name} = {}, outside its limits {} … {}", show(value), show(lower), show(upper))
        }
        ReachError::OutsideSumLimit { limit, value } => {
            format!("needs {}", number::beyond_sum_limit(&spec.sum_limits[limit], value, spec.length))
        }
        ReachError::Evaluation(error) => {
            let Configuration { q, s, .. } = &unreachable.requested;
            let further = error.is_open().then(|| open_loops(spec, q, s)).flatten();
            further.unwrap_or_else(|| error.to_string())
        }
    }
}
