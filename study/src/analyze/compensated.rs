//! Errors of the compensated machine over a workspace: the configurations at which they are
//! largest, and at which a tolerance is least likely to be met.

use abbe::analysis::{Correction, ErrorDistribution, Extreme, Measurand, Subset, Sweepable, Unevaluated};
use abbe::analysis::{Workspace, comparable, sweep};

/// Largest number of configurations at which the compensated machine, or the yield, is evaluated.
pub(super) const CHECKED: usize = 10_000;
/// Number of least likely configurations that are kept.
const KEPT: usize = 8;

/// Errors of the compensated machine over a workspace.
pub(super) struct CompensatedErrors {
    /// Number of evaluated configurations.
    pub(super) checked: usize,
    /// Errors of position and orientation.
    pub(super) extremes: [CompensatedExtremes; 2],
}

/// Errors of one measurand over the evaluated configurations.
#[derive(Default)]
pub(super) struct CompensatedExtremes {
    /// Largest norm of what remains of the repeatable errors,
    /// [`ErrorDistribution::repeatable_radius`].
    pub(super) repeatable: Extreme,
    /// Largest radius, [`ErrorDistribution::radius`].
    pub(super) radius: Extreme,
    /// Largest error over all signs.
    pub(super) worst_case: Extreme,
    /// Indicates that no draw exceeds it.
    pub(super) is_bounded: bool,
    /// Configuration where the norm that is exceeded with 5 % probability is largest, by an
    /// approximation.
    farthest: Extreme,
    /// Standard deviations by which the tolerance exceeds the median, and configurations, the least
    /// likely first.
    least_likely: Vec<(f64, usize)>,
}

impl CompensatedErrors {
    /// Evaluates a workspace; at most [`CHECKED`] configurations of it, evenly spaced. Only the
    /// errors of position are evaluated without a tolerance.
    pub(super) fn new(
        manipulator: &dyn Sweepable,
        workspace: &dyn Workspace,
        correction: Correction<'_>,
        tolerances: [Option<f64>; 2],
    ) -> Result<Self, Unevaluated> {
        let description = manipulator.description();
        let mut all = Self { checked: 0, extremes: Default::default() };
        all.extremes.iter_mut().for_each(|one| one.is_bounded = true);
        let subset = Subset { workspace, count: CHECKED };
        sweep(manipulator, &subset, &mut |row| {
            let index = subset.place(row.index);
            all.checked += 1;
            for (measurand, extremes) in Measurand::ALL.into_iter().zip(&mut all.extremes) {
                let tolerance = tolerances[measurand as usize];
                if measurand == Measurand::Orientation && (tolerance.is_none() || !row.oriented) {
                    continue;
                }
                let error = ErrorDistribution::at(description, row.sources, measurand, Some(correction));
                extremes.add(&error, index, tolerance);
            }
        })?;
        Ok(all)
    }

    /// Returns the indices of all configurations in the result.
    pub(super) fn indices(&self) -> impl Iterator<Item = usize> {
        self.extremes.iter().flat_map(CompensatedExtremes::candidates).flatten()
    }
}

impl CompensatedExtremes {
    fn add(&mut self, error: &ErrorDistribution, index: usize, tolerance: Option<f64>) {
        self.repeatable.add(index, error.repeatable_radius());
        self.radius.add(index, error.radius());
        if self.worst_case.configuration.is_none() || error.simple_bound() > self.worst_case.value {
            self.worst_case.add(index, error.worst_case().norm);
        }
        self.is_bounded &= error.is_bounded();
        let Some(tolerance) = tolerance else { return };
        let [farthest, deviations] = error.approximate(tolerance);
        let deviations = comparable(deviations);
        self.farthest.add(index, farthest);
        let after = self.least_likely.partition_point(|kept| kept.0 <= deviations);
        if after < KEPT {
            self.least_likely.truncate(KEPT - 1);
            self.least_likely.insert(after, (deviations, index));
        }
    }

    /// Returns the configurations at which the distribution is evaluated, the one with the largest
    /// radius first.
    pub(super) fn candidates(&self) -> Vec<Option<usize>> {
        let mut candidates = vec![self.radius.configuration];
        let others = self.least_likely.iter().map(|(_, index)| Some(*index));
        for index in [self.farthest.configuration].into_iter().chain(others) {
            if !candidates.contains(&index) {
                candidates.push(index);
            }
        }
        candidates
    }
}
