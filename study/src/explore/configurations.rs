//! Configurations of the study's workspace, or of measured rows.

use abbe::analysis::{Configuration, Subset, Workspace};
use abbe_spec::{Diagnostics, Spec};

use super::report::Configurations;
use crate::analyze::Analyze;
use crate::{Residuals, mistake};

/// Largest number of configurations on a page.
const COUNT: usize = 1000;

/// Returns reachable configurations, evenly chosen.
pub(super) fn configurations(analysis: &Analyze) -> Result<Configurations, Diagnostics> {
    let machine = analysis.machine();
    let manipulator = machine.evaluator(true);
    let region = &analysis.study().region;
    let workspace = region.workspace(&*manipulator, analysis.seed);
    let workspace = workspace.map_err(|error| mistake::whole(&machine.origin, &error))?;
    let reached = Subset { workspace: &*workspace, count: COUNT }.reached();
    let home = workspace.home();
    Ok(Configurations {
        q: reached.iter().map(|one| one.q.clone()).collect(),
        u: unless_nominal(&home.u, &reached, |one| &one.u),
        s: unless_nominal(&home.s, &reached, |one| &one.s),
    })
}

/// Returns the configurations of measured rows, with nominal parameters.
pub(super) fn measured(residuals: &Residuals, spec: &Spec) -> Configurations {
    let inputs = spec.inputs.len();
    let u = residuals.rows.iter().map(|row| row.u[..inputs].to_vec());
    Configurations {
        q: residuals.rows.iter().map(|row| row.q.clone()).collect(),
        u: if inputs > 0 { u.collect() } else { Vec::new() },
        s: Vec::new(),
    }
}

/// Returns values of each configuration; none if all are nominal.
fn unless_nominal(
    nominal: &Vec<f64>,
    reached: &[Configuration],
    values: fn(&Configuration) -> &Vec<f64>,
) -> Vec<Vec<f64>> {
    match reached.iter().all(|one| values(one) == nominal) {
        true => Vec::new(),
        false => reached.iter().map(|one| values(one).clone()).collect(),
    }
}
