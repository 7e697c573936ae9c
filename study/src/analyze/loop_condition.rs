//! Condition of `φ_p`: it says how well the loops determine the passive variables.

use abbe::Manipulator;
use abbe::analysis::decompose::singular_values;
use abbe::analysis::sampling::arm_length;
use abbe::analysis::{Configuration, Workspace};
use abbe_codegen::chain::LoopEquations;
use abbe_spec::Spec;
use serde::Serialize;

use crate::loop_units::LoopUnits;
use crate::number;

/// Largest number of configurations at which the condition is evaluated.
const CHECKED: usize = 2000;

/// Condition number from which on the machine counts as nearly singular: errors in the loops are
/// then up to that many times larger at the tool than where the loops are best determined.
pub const NEARLY_SINGULAR: f64 = 1000.0;

/// Condition number of `φ_p`, the derivative of the equations of the loops with respect to the
/// passive variables, with lengths in arm lengths. It is infinite where the machine can move
/// although all commanded joints are held.
#[derive(Clone, Debug, Serialize)]
pub struct LoopCondition {
    /// Number of configurations that were evaluated, spread evenly over the workspace.
    pub configurations: usize,
    /// Condition number in the 2-norm, the largest of them.
    pub largest: f64,
    /// Its configuration: differences from home.
    pub at: String,
}

impl LoopCondition {
    /// Evaluates home and at most 2000 configurations of a workspace where the loops close. Returns
    /// `None` for a machine without loops.
    pub(super) fn new(spec: &Spec, manipulator: &dyn Manipulator, workspace: &dyn Workspace) -> Option<Self> {
        if spec.loops.is_empty() {
            return None;
        }
        let equations = LoopEquations::new(spec);
        let home = workspace.home();
        let units = LoopUnits::new(spec, arm_length(manipulator, &home.s).ok()?);
        let condition = |at: &Configuration| condition(spec, manipulator, &equations, &units, at);
        let label = |at: &Configuration| number::configuration(at, home, spec);
        let mut found = Self { configurations: 0, largest: condition(home)?, at: label(home) };
        let step = workspace.len().div_ceil(CHECKED).max(1);
        for index in (0..workspace.len()).step_by(step) {
            let Ok(at) = workspace.configuration(index) else { continue };
            let Some(here) = condition(&at) else { continue };
            found.configurations += 1;
            if here > found.largest {
                (found.largest, found.at) = (here, label(&at));
            }
        }
        Some(found)
    }

    /// Returns whether the machine comes near a singular configuration.
    pub fn is_nearly_singular(&self) -> bool {
        self.largest > NEARLY_SINGULAR
    }
}

/// Returns the condition number at a configuration; `None` where the loops do not close.
fn condition(
    spec: &Spec,
    manipulator: &dyn Manipulator,
    equations: &LoopEquations,
    units: &LoopUnits,
    Configuration { q, s, .. }: &Configuration,
) -> Option<f64> {
    let mut p = vec![0.0; spec.passive.len()];
    manipulator.passive(q, s, &mut p).ok()?;
    let values = singular_values(units.derivatives(&equations.derivatives_at(q, &p, s)))?;
    let (largest, least) = (values.first()?, values.last()?);
    Some(if *least > 0.0 { largest / least } else { f64::MAX })
}
