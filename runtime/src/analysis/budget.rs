//! The error budget of a workspace: every source alone and all together, in one sweep.

use super::combined::Gather;
use super::enclosing::Enclosing;
use super::scattered::Scattered;
use super::single::{Tally, position};
use super::tightening::Tightening;
use super::workspace::One;
use super::{Combined, Row, SourceErrors, Unevaluated, Unreachables, Workspace, sweep};
use crate::Manipulator;

/// How many configurations the error sphere begins with.
const SCATTERED: usize = 512;

/// What the sources of a manipulator do over a workspace, to first order.
#[derive(Clone, Debug, PartialEq)]
pub struct Budget {
    /// Each source alone, in the order of the description.
    pub sources: Vec<SourceErrors>,
    /// All together.
    pub combined: Combined,
    /// By how much the radius shrinks if a source is made smaller by one percent, in the length unit. Less than
    /// nothing where it counteracts the others.
    pub gains: Vec<f64>,
    /// How many configurations were reached and evaluated.
    pub configurations: usize,
    /// Those that could not be reached.
    pub unreachable: Unreachables,
}

/// What the sources do over a workspace with inputs `u`, section 5 of the paper; `visit` sees every
/// configuration on the way, in order.
pub fn error_budget(
    manipulator: &dyn Manipulator,
    workspace: &dyn Workspace,
    u: &[f64],
    visit: &mut dyn FnMut(&Row),
) -> Result<Budget, Unevaluated> {
    let description = manipulator.description();
    let mut home = Vec::new();
    sweep(manipulator, &One(workspace.home()), u, &mut |row| home.extend_from_slice(row.sources))
        .map_err(|Unevaluated { error, .. }| Unevaluated { configuration: None, error })?;

    // If one of these cannot be evaluated, the sweep over all of them will say which.
    let (mut points, scattered) = (Vec::new(), Scattered { workspace, count: SCATTERED });
    let _ = sweep(manipulator, &scattered, u, &mut |row| points.push(position(&row.repeatable)));

    let sources = description.sources.iter().zip(home).enumerate();
    let mut tallies =
        sources.map(|(i, (source, home))| Tally::new(i, source.class, home)).collect::<Vec<_>>();
    let mut combined = Gather::new(description.sources, Enclosing::new(points.into_iter()));
    let mut tightening = Tightening::new(description.sources);
    let unreachable = sweep(manipulator, workspace, u, &mut |row| {
        for (tally, deviation) in tallies.iter_mut().zip(row.sources) {
            tally.add(row.index, deviation);
        }
        combined.add(row);
        tightening.add(row);
        visit(row);
    })?;
    let sources = tallies.into_iter().map(Tally::finish).collect();
    let (combined, configurations) = combined.finish();
    let gains = tightening.gains(combined.radius.value);
    Ok(Budget { sources, combined, gains, configurations, unreachable })
}
