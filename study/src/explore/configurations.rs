//! Configurations of the study's workspace.

use abbe::analysis::{Configuration, Subset};
use abbe_spec::diagnostic::Diagnostics;

use super::report::Configurations;
use crate::analyze::Analyze;
use crate::mistake;

/// Largest number of configurations on a page.
const COUNT: usize = 1000;

/// Returns reachable configurations, evenly chosen.
pub(super) fn configurations(analysis: &Analyze) -> Result<Configurations, Diagnostics> {
    let machine = analysis.machine();
    let manipulator = machine.evaluator(true);
    let region = &analysis.study().region;
    let workspace = region.workspace(&*manipulator, analysis.seed);
    let workspace = workspace.map_err(|error| mistake::whole(&machine.origin, &error))?;
    let reached = abbe::analysis::Workspace::reached(&Subset { workspace: &*workspace, count: COUNT });
    Ok(Configurations {
        q: column(&reached, |one| &one.q, true),
        u: column(&reached, |one| &one.u, !analysis.moving_inputs().is_empty()),
        s: column(&reached, |one| &one.s, !analysis.varying().is_empty()),
    })
}

fn column(all: &[Configuration], values: fn(&Configuration) -> &Vec<f64>, varies: bool) -> Vec<Vec<f64>> {
    if varies { all.iter().map(|one| values(one).clone()).collect() } else { Vec::new() }
}
