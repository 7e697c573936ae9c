//! Inverse kinematics: damped Newton steps on the joint Jacobian, within limits.

use super::ReachError;
use super::bounds::Bounds;
use super::descents::Descents;
use super::joint_chain::JointChain;
use super::quest::Problem;
use super::search::Search;
use abbe_core::lanes::InstructionSet;
use abbe_core::{Manipulator, Pose};

/// Where the tool is to be brought, in `F_0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// The tool point: rows 1–3.
    Point([f64; 3]),
    /// Point and orientation: all six rows.
    Pose(Pose),
}

impl Target {
    fn is_finite(&self) -> bool {
        match self {
            Self::Point(point) => point.iter().all(|x| x.is_finite()),
            Self::Pose(pose) => pose.0.as_flattened().iter().all(|x| x.is_finite()),
        }
    }
}

/// Values of the variables in `free` that bring the tool to `target`, the others held as in `start`.
///
/// Returns all of `q`, within its limits. Too many free variables are no harm: every step is the shortest one
/// (angles in rad, lengths in arm lengths). The search begins at `start`, then, unless the chain proves that there is nothing, at 32
/// points spread within the limits; only if it finds nothing does it look beyond them, to say which variable stops it: of the four
/// solutions that it compares, the first one from where it came nearest within them.
pub fn inverse(
    manipulator: &dyn Manipulator,
    s: &[f64],
    start: &[f64],
    free: &[usize],
    target: &Target,
) -> Result<Vec<f64>, ReachError> {
    let problem = Problem::new(manipulator, s, start, free)?;
    if let Some(found) = (Search { problem: &problem, target }).nearby() {
        return Ok(found);
    }
    Inverse::of(problem).solve_from(1, core::slice::from_ref(target)).remove(0)
}

/// Inverse kinematics of many targets, all from one start with the same variables free.
pub(crate) struct Inverse<'a> {
    problem: Problem<'a>,
    chain: Option<(JointChain, Bounds)>,
}

impl<'a> Inverse<'a> {
    /// Errors as for [`inverse()`], of what does not depend on the target.
    pub(crate) fn new(
        manipulator: &'a dyn Manipulator,
        s: &[f64],
        start: &[f64],
        free: &[usize],
    ) -> Result<Self, ReachError> {
        Problem::new(manipulator, s, start, free).map(Self::of)
    }

    fn of(mut problem: Problem<'a>) -> Self {
        problem.spread();
        let chain = JointChain::new(&problem).map(|chain| {
            let bounds = Bounds::new(&problem, &chain);
            (chain, bounds)
        });
        Self { problem, chain }
    }

    /// What [`inverse()`] is for each target: of chains of lower pairs several at once, one in each lane, and for each the same
    /// whatever else is asked for.
    pub(crate) fn solve(&self, targets: &[Target]) -> Vec<Result<Vec<f64>, ReachError>> {
        self.solve_from(0, targets)
    }

    fn solve_from(&self, start: usize, targets: &[Target]) -> Vec<Result<Vec<f64>, ReachError>> {
        let Self { problem, chain } = self;
        let Some((chain, bounds)) = chain.as_ref().filter(|_| targets.iter().all(Target::is_finite)) else {
            return targets.iter().map(|target| Search { problem, target }.solve()).collect();
        };
        let set = InstructionSet::best();
        match targets.first() {
            Some(Target::Pose(_)) => set.run(Descents::<6> { problem, chain, targets, bounds, start }),
            _ => set.run(Descents::<3> { problem, chain, targets, bounds, start }),
        }
    }
}
