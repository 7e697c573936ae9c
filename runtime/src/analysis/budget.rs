//! The error budget of a workspace: every source alone and all together, in one sweep.

use super::single::Tally;
use super::{Combined, Row, SourceErrors, Unevaluated, Workspace, sweep};
use crate::Manipulator;

/// What the sources of a manipulator do over a workspace, to first order.
#[derive(Clone, Debug, PartialEq)]
pub struct Budget {
    /// Each source alone, in the order of the description.
    pub sources: Vec<SourceErrors>,
    /// All together.
    pub combined: Combined,
}

/// What the sources do over a workspace with inputs `u`, section 5 of the paper; `visit` sees every
/// configuration on the way, in order.
pub fn error_budget(
    manipulator: &dyn Manipulator,
    workspace: &Workspace,
    u: &[f64],
    visit: &mut dyn FnMut(&Row),
) -> Result<Budget, Unevaluated> {
    let description = manipulator.description();
    let mut home = Vec::new();
    let at_home = |row: &Row| home.extend_from_slice(row.sources);
    sweep(manipulator, core::slice::from_ref(&workspace.home), u, &mut { at_home })
        .map_err(|Unevaluated { error, .. }| Unevaluated { configuration: None, error })?;

    let sources = description.sources.iter().zip(home).enumerate();
    let mut tallies =
        sources.map(|(i, (source, home))| Tally::new(i, source.class, home)).collect::<Vec<_>>();
    let mut combined = Combined::default();
    sweep(manipulator, &workspace.configurations, u, &mut |row| {
        for (tally, deviation) in tallies.iter_mut().zip(row.sources) {
            tally.add(row.index, deviation);
        }
        combined.add(row);
        visit(row);
    })?;
    let sources = tallies.into_iter().map(Tally::finish).collect();
    Ok(Budget { sources, combined })
}
