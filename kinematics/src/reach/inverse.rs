//! Inverse kinematics: damped Newton steps on the joint Jacobian, within limits.

use super::bounds::Bounds;
use super::descents::Descents;
use super::joint_chain::JointChain;
use super::search::Search;
use super::target_search::Problem;
use super::{ReachError, Target, generated};
use abbe_core::{Manipulator, lanes::InstructionSet};

/// Computes values of the variables in `free` that bring the tool to `target`, with the others
/// fixed as in `start`.
///
/// Returns all of `q`, within its limits. If all variables are free, and the manipulator has all
/// solutions for a pose in closed form ([`Manipulator::inverse`]), it is the one nearest to
/// `start`, with angles in rad and lengths in arm lengths. Otherwise it is found by a search.
/// Redundant free variables are allowed: every step is the shortest one (angles in rad, lengths in
/// arm lengths). The search begins at `start`. Unless the chain proves the target unreachable, it
/// continues from 32 points spread within the limits. If all fail, it searches beyond the limits to
/// name the variable that prevents reaching the target. It compares up to four such solutions, the
/// first one started from the best point within the limits.
pub fn inverse(
    manipulator: &dyn Manipulator,
    s: &[f64],
    start: &[f64],
    free: &[usize],
    target: &Target,
) -> Result<Vec<f64>, ReachError> {
    let problem = Problem::new(manipulator, s, start, free)?;
    let nearby = || Search { problem: &problem, target }.from(0);
    if let Some(found) = closed(&problem, target).or_else(nearby) {
        return Ok(found);
    }
    Inverse::from_problem(problem).solve_from(1, core::slice::from_ref(target)).remove(0)
}

/// Inverse kinematics of many targets with one start and one set of free variables.
pub(crate) struct Inverse<'a> {
    problem: Problem<'a>,
    chain: Option<(JointChain, Bounds)>,
}

impl<'a> Inverse<'a> {
    /// Prepares the search. Errors as for [`inverse()`], if they do not depend on the target.
    pub(crate) fn new(
        manipulator: &'a dyn Manipulator,
        s: &[f64],
        start: &[f64],
        free: &[usize],
    ) -> Result<Self, ReachError> {
        Problem::new(manipulator, s, start, free).map(Self::from_problem)
    }

    fn from_problem(mut problem: Problem<'a>) -> Self {
        problem.spread();
        let chain = JointChain::new(&problem).map(|chain| {
            let bounds = Bounds::new(&problem, &chain);
            (chain, bounds)
        });
        Self { problem, chain }
    }

    /// Solves [`inverse()`] for each target. Chains of lower pairs are solved several at once, one
    /// per lane; each result is independent of the other targets.
    pub(crate) fn solve(&self, targets: &[Target]) -> Vec<Result<Vec<f64>, ReachError>> {
        self.solve_from(0, targets)
    }

    fn solve_from(&self, start: usize, targets: &[Target]) -> Vec<Result<Vec<f64>, ReachError>> {
        let Self { problem, chain } = self;
        let Some((chain, bounds)) = chain.as_ref().filter(|_| targets.iter().all(Target::is_finite)) else {
            return targets.iter().map(|target| Search { problem, target }.solve()).collect();
        };
        let set = InstructionSet::best();
        let mut found: Vec<_> = targets.iter().map(|target| closed(problem, target).map(Ok)).collect();
        let rows = |target: &Target| match target {
            Target::Point(_) => 3,
            Target::Axis { .. } => 5,
            Target::Pose(_) => 6,
        };
        for count in [3, 5, 6] {
            let open: Vec<usize> =
                (0..targets.len()).filter(|i| found[*i].is_none() && rows(&targets[*i]) == count).collect();
            let targets: &[Target] = &open.iter().map(|i| targets[*i]).collect::<Vec<_>>();
            let searched = match count {
                _ if open.is_empty() => continue,
                3 => set.run(Descents::<3> { problem, chain, targets, bounds, start }),
                6 => set.run(Descents::<6> { problem, chain, targets, bounds, start }),
                _ => targets.iter().map(|target| Search { problem, target }.solve()).collect(),
            };
            open.into_iter().zip(searched).for_each(|(i, searched)| found[i] = Some(searched));
        }
        found.into_iter().flatten().collect()
    }
}

/// Returns the solution nearest to the first start if there is a closed form.
fn closed(problem: &Problem<'_>, target: &Target) -> Option<Vec<f64>> {
    match target {
        Target::Pose(pose) => generated::nearest(problem, pose),
        Target::Point(_) | Target::Axis { .. } => None,
    }
}
