//! The sweep over the blocks of a workspace.

use super::block::Block;
use super::in_order::in_order;
use super::{Row, Unevaluated};
use crate::{Configuration, UnreachableSummary, Workspace};
use abbe_core::lanes::Sweepable;
use abbe_core::{Quantity, checks};
use abbe_kinematics::STREAM;

/// Number of configurations evaluated at once: few enough for the displacements to stay in the
/// cache, and as many as share one stream of random numbers.
pub const BLOCK: usize = STREAM;

/// Evaluates all sources at all reachable configurations and visits them in order. Returns a
/// summary of the unreachable ones.
///
/// The effects of one source share one magnitude, so its ΔX is their sum with signs. Blocks are
/// evaluated in parallel (feature `parallel`), with the same results for any number of threads.
/// Returns [`Error::Count`] before the first visit if the workspace belongs to another manipulator,
/// and [`Error::OutOfRange`] if an input is outside its range.
///
/// [`Error::Count`]: abbe_core::Error::Count
/// [`Error::OutOfRange`]: abbe_core::Error::OutOfRange
pub fn sweep(
    manipulator: &dyn Sweepable,
    workspace: &dyn Workspace,
    visit: &mut dyn FnMut(&Row),
) -> Result<UnreachableSummary, Unevaluated> {
    ready(manipulator, workspace)?;
    let mut here = workspace.home().clone();
    let mut unreachables = UnreachableSummary::default();
    let count = workspace.len();
    in_order(
        count.div_ceil(BLOCK),
        |block| {
            let range = block * BLOCK..count.min((block + 1) * BLOCK);
            let mut block = Block::new(manipulator, workspace, range.len());
            block.evaluate(range)?;
            Ok(block)
        },
        |mut block| {
            block.unreachable.drain(..).for_each(|unreachable| unreachables.add(unreachable));
            block.visit(&mut here, visit);
        },
    )?;
    Ok(unreachables.finish())
}

/// Checks that a workspace belongs to a manipulator.
pub(crate) fn ready(manipulator: &dyn Sweepable, workspace: &dyn Workspace) -> Result<(), Unevaluated> {
    let description = manipulator.description();
    let Configuration { q, s, u } = workspace.home();
    let fits = || {
        checks::length(Quantity::Variables, [description.variables.len(), 1], q.len())?;
        checks::length(Quantity::Parameters, [description.parameters.len(), 1], s.len())?;
        checks::length(Quantity::Inputs, [description.inputs.len(), 1], u.len())?;
        checks::finite(Quantity::Inputs, u)?;
        checks::inputs(&description.inputs, u)
    };
    fits().map_err(|error| Unevaluated { configuration: None, error })
}
