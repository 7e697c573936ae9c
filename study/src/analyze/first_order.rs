//! First-order error: the distance between `ΔX ≈ J_e ε` and the exact chain.

use abbe::analysis::{Configuration, Row, Subset, Sweepable, Unevaluated, Workspace, sweep};
use abbe::{Class, Error, deviation, drawn_pose};
use serde::Serialize;

/// Largest number of configurations at which the exact chain is evaluated.
const CHECKED: usize = 2000;

/// Largest distance between first order and the exact chain, over at most 2000 configurations
/// spread evenly over the workspace.
///
/// Compares the repeatable sources; if there are none, the random sources at their bounds, all with
/// a positive sign.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FirstOrder {
    /// Number of configurations that were compared.
    #[serde(rename = "configurations")]
    pub checked: usize,
    /// Largest difference in the tool point's position, in the length unit.
    #[serde(rename = "largest_difference")]
    pub largest: f64,
}

impl FirstOrder {
    /// Compares over a workspace. Skips configurations where the exact chain cannot be evaluated.
    pub(super) fn compare(
        manipulator: &dyn Sweepable,
        workspace: &dyn Workspace,
    ) -> Result<Self, Unevaluated> {
        let comparison = Comparison::new(manipulator);
        let mut compared = Self { checked: 0, largest: 0.0 };
        sweep(manipulator, &Subset { workspace, count: CHECKED }, &mut |row| {
            if let Ok(difference) = comparison.difference(row) {
                compared.checked += 1;
                compared.largest = compared.largest.max(difference);
            }
        })?;
        Ok(compared)
    }
}

/// Comparison of first order with the exact chain, one configuration at a time.
struct Comparison<'a> {
    manipulator: &'a dyn Sweepable,
    repeatable: bool,
    /// Factor of each source's errors in the exact chain.
    magnitudes: Vec<f64>,
}

impl<'a> Comparison<'a> {
    fn new(manipulator: &'a dyn Sweepable) -> Self {
        let sources = &manipulator.description().sources;
        let repeatable = sources.iter().any(|source| source.class == Class::Repeatable);
        let magnitudes = sources.iter().map(|source| match source.class {
            Class::Repeatable => 1.0,
            Class::Random(_) if repeatable => 0.0,
            Class::Random(distribution) => distribution.bound(),
        });
        Self { manipulator, repeatable, magnitudes: magnitudes.collect() }
    }

    fn difference(&self, row: &Row) -> Result<f64, Error> {
        let Configuration { q, s, u } = row.configuration;
        let real = drawn_pose(self.manipulator, q, s, u, &self.magnitudes)?;
        let exact = deviation(self.manipulator.description().orientation, &row.pose, &real);
        let first = |i: usize| match self.repeatable {
            true => row.repeatable[i],
            false => row.sources.iter().map(|source| source[i]).sum::<f64>(),
        };
        Ok((0..3).map(|i| (exact[i] - first(i)).powi(2)).sum::<f64>().sqrt())
    }
}
