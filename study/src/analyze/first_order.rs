//! First-order error: the distance between `ΔX ≈ J_e ε` and the exact chain.

use abbe::analysis::sampling::vectors::{distance, norm};
use abbe::analysis::{Configuration, Row, Subset, Sweepable, Unevaluated, Workspace, sweep};
use abbe::{Class, Error, deviation, drawn_pose};
use serde::Serialize;

/// Largest number of configurations at which the exact chain is evaluated.
const CHECKED: usize = 2000;

/// Largest distance between first order and the exact chain, over at most 2000 configurations
/// spread evenly over the workspace.
///
/// Compares all sources: the random ones at their bounds, each with the sign with which it adds to
/// those before it.
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
    /// Bound of each random source in multiples of its errors; `None` for a repeatable one.
    bounds: Vec<Option<f64>>,
}

impl<'a> Comparison<'a> {
    fn new(manipulator: &'a dyn Sweepable) -> Self {
        let bounds = manipulator.description().sources.iter().map(|source| match source.class {
            Class::Repeatable => None,
            class => Some(class.bound()),
        });
        Self { manipulator, bounds: bounds.collect() }
    }

    fn difference(&self, row: &Row) -> Result<f64, Error> {
        let Configuration { q, s, u } = row.configuration;
        let mut first = [row.repeatable[0], row.repeatable[1], row.repeatable[2]];
        let mut magnitudes = vec![1.0; self.bounds.len()];
        let random = magnitudes.iter_mut().zip(&self.bounds).zip(row.sources);
        for ((magnitude, bound), moved) in
            random.filter_map(|((m, bound), moved)| Some(((m, (*bound)?), moved)))
        {
            let along: f64 = first.iter().zip(moved).map(|(sum, part)| sum * part).sum();
            // Perpendicular errors have no sign of their own.
            let zero = 1e-9 * norm(first) * norm([moved[0], moved[1], moved[2]]);
            let sign = if along < -zero { -1.0 } else { 1.0 };
            *magnitude = sign * bound;
            first = std::array::from_fn(|i| first[i] + sign * moved[i]);
        }
        let real = drawn_pose(self.manipulator, q, s, u, &magnitudes)?;
        let exact = deviation(self.manipulator.description().orientation, &row.pose, &real);
        Ok(distance([exact[0], exact[1], exact[2]], first))
    }
}
