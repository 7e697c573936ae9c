//! Unreachable configurations of the workspace, with reasons.
//!
//! Condition of `φ_p`: it says how well the loops determine the passive variables.

use abbe::Manipulator;
use abbe::analysis::{Configuration, ReachError, Unreachable, UnreachableSummary, Workspace};
use abbe_spec::Spec;
use serde::Serialize;

use crate::{Closing, dead_point::DeadPoint, number, open_loops::open_loops};

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
            error.is_open().then(|| open_loops(spec, q, s)).flatten().unwrap_or_else(|| error.to_string())
        }
    }
}

/// Largest number of configurations at which the condition is evaluated.
const CHECKED: usize = 2000;

/// Condition number from which on the machine counts as nearly singular: errors in the loops are
/// then up to that many times larger at the tool than where the loops are best determined.
pub const NEARLY_SINGULAR: f64 = 1000.0;

/// Condition number and singular values of `φ_p`, the derivative of the equations of the loops with
/// respect to the passive variables, with lengths relative to those of the loops. It is singular
/// where the machine can move although all commanded joints are held.
#[derive(Clone, Debug, Serialize)]
pub struct LoopCondition {
    /// Number of configurations that were evaluated, spread evenly over the workspace.
    pub configurations: usize,
    /// Condition number in the 2-norm, the largest of them.
    pub largest: f64,
    /// Its configuration: differences from home.
    pub at: String,
    /// Smallest singular value of the configurations, without a unit.
    pub smallest_singular: f64,
    /// Its configuration: differences from home.
    pub smallest_at: String,
    /// Nearest dead point that one joint reaches alone from home; absent if there is none within
    /// the limits of the joints.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dead_point: Option<DeadPoint>,
}

impl LoopCondition {
    /// Evaluates home and at most 2000 configurations of a workspace where the loops close. Returns
    /// `None` for a machine without loops.
    pub(super) fn new(spec: &Spec, manipulator: &dyn Manipulator, workspace: &dyn Workspace) -> Option<Self> {
        if spec.loops.is_empty() {
            return None;
        }
        let home = workspace.home();
        let mut closing = Closing::new(spec, &home.q, &home.s);
        let mut passive = closing.home();
        let mut condition = |Configuration { q, s, .. }: &Configuration| {
            manipulator.passive(q, s, &mut passive).ok()?;
            (closing.q, closing.s) = (q.clone(), s.clone());
            let [largest, least] = closing.singular_values(&passive)?;
            Some([if least > 0.0 { largest / least } else { f64::MAX }, least])
        };
        let label = |at: &Configuration| number::configuration(at, home, spec);
        let [largest, smallest_singular] = condition(home)?;
        let mut found = Self {
            configurations: 0,
            largest,
            at: label(home),
            smallest_singular,
            smallest_at: label(home),
            dead_point: None,
        };
        for index in (0..workspace.len()).step_by(workspace.len().div_ceil(CHECKED).max(1)) {
            let Ok(at) = workspace.configuration(index) else { continue };
            let Some([largest, smallest]) = condition(&at) else { continue };
            found.configurations += 1;
            if largest > found.largest {
                (found.largest, found.at) = (largest, label(&at));
            }
            if smallest < found.smallest_singular {
                (found.smallest_singular, found.smallest_at) = (smallest, label(&at));
            }
        }
        found.dead_point =
            DeadPoint::nearest(spec, manipulator, [&home.q, &home.s], &closing.equations.variable_units);
        Some(found)
    }

    /// Returns whether the machine comes near a singular configuration.
    pub fn is_nearly_singular(&self) -> bool {
        self.largest > NEARLY_SINGULAR
    }
}
