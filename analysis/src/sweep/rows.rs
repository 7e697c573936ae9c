//! `ΔX = J_e ε` of every source at every configuration, block by block.

use core::fmt;

use super::block::Block;
use super::in_order::in_order;
use crate::workspace::STREAM;
use crate::{Configuration, UnreachableSummary, Workspace};
use abbe_core::lanes::Sweepable;
use abbe_core::{Error, Pose, Quantity, checks};

/// How many configurations are evaluated at once: few enough for what the sources do to stay in the cache, and
/// as many as take random numbers from one stream.
pub const BLOCK: usize = STREAM;

/// A configuration of the workspace that could not be evaluated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unevaluated {
    /// Its index; none for the home configuration.
    pub configuration: Option<usize>,
    /// Why.
    pub error: Error,
}

impl fmt::Display for Unevaluated {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.configuration {
            Some(index) => write!(f, "configuration {index}: {}", self.error),
            None => write!(f, "home configuration: {}", self.error),
        }
    }
}

impl core::error::Error for Unevaluated {}

/// What the sources do at one configuration, to first order.
///
/// Deviations have rows 1–3 in the length unit and `F_0`, rows 4–6 in rad as the manipulator's orientation.
#[derive(Clone, Copy, Debug)]
pub struct Row<'a> {
    /// Index of the configuration in the workspace; those that cannot be reached are left out.
    pub index: usize,
    /// The configuration.
    pub configuration: &'a Configuration,
    /// The nominal pose of the tool point in `F_0`, equation (3).
    pub pose: Pose,
    /// ΔX of each source: of a repeatable one with its sign; of a random one its bound (half-width or 3σ),
    /// whose sign as a whole is unknown.
    pub sources: &'a [[f64; 6]],
    /// The sum of the repeatable sources.
    pub repeatable: [f64; 6],
    /// The root sum of squares of the random sources, row by row.
    pub random: [f64; 6],
}

/// Evaluates all sources at all configurations that can be reached and visits them in order.
///
/// The effects of one source share one magnitude, so its ΔX is their sum with signs. What cannot be reached is
/// counted in the result. Blocks are evaluated in parallel (feature `parallel`), the results are the same for
/// any number of threads. [`Error::Count`] before anything is visited if the workspace is not the manipulator's,
/// [`Error::OutOfRange`] where an input is outside its range.
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

/// Whether a workspace is that of a manipulator.
pub(crate) fn ready(manipulator: &dyn Sweepable, workspace: &dyn Workspace) -> Result<(), Unevaluated> {
    let description = manipulator.description();
    let Configuration { q, s, u } = workspace.home();
    let at_home = |error| Unevaluated { configuration: None, error };
    for (quantity, expected, found) in [
        (Quantity::Variables, description.variables.len(), q.len()),
        (Quantity::Parameters, description.parameters.len(), s.len()),
        (Quantity::Inputs, description.inputs.len(), u.len()),
    ] {
        if expected != found {
            return Err(at_home(Error::Count { quantity, expected, found }));
        }
    }
    checks::finite(Quantity::Inputs, u).map_err(at_home)?;
    checks::inputs(&description.inputs, u).map_err(at_home)
}
