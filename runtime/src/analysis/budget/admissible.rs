//! The budget backwards: how large the sources may be for a tolerance.

use super::Budget;
use crate::Class;

/// How large the sources may be, so that the radius `max ‖Σ repeatable‖ + ‖RSS random‖` stays within a tolerance T.
/// Scales are multiples of what the sources are now; none where nothing limits them, because they do nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct Admissible {
    /// Each source alone, as if there were no other: `T / max ‖ΔX_k‖`.
    pub alone: Vec<Option<f64>>,
    /// All by the same factor: `T / radius`, because the radius grows with it.
    pub together: Option<f64>,
    /// What every source may contribute if all contribute alike: `a = T / (n + √m)` with n repeatable and m random
    /// sources that do something. Length unit.
    pub share: Option<f64>,
    /// Each source at its equal share: `a / max ‖ΔX_k‖`. T is met for certain, wherever each is worst:
    /// `‖Σ r_k‖ ≤ n a` and `‖RSS‖ ≤ √(m a²)`.
    pub equal: Vec<Option<f64>>,
}

impl Admissible {
    /// For the sources of a budget and a tolerance in the length unit.
    pub fn new(budget: &Budget, tolerance: f64) -> Self {
        let largest = || budget.sources.iter().map(|errors| errors.plain_max.norm);
        let scale = |limit: f64, norm: f64| (norm > 0.0).then(|| limit / norm).filter(|s| s.is_finite());
        let active = budget.sources.iter().filter(|errors| errors.plain_max.norm > 0.0);
        let repeatable = active.clone().filter(|errors| errors.class == Class::Repeatable).count();
        let random = active.count() - repeatable;
        let parts = repeatable as f64 + (random as f64).sqrt();
        let share = (parts > 0.0).then(|| tolerance / parts);
        Self {
            alone: largest().map(|norm| scale(tolerance, norm)).collect(),
            together: scale(tolerance, budget.combined.radius.value),
            share,
            equal: largest().map(|norm| scale(share?, norm)).collect(),
        }
    }
}

impl Budget {
    /// The sources in the order in which they should be tightened: the largest gain per percent first.
    pub fn tighten_first(&self) -> Vec<usize> {
        let mut order = (0..self.gains.len()).collect::<Vec<_>>();
        order.sort_by(|&i, &j| self.gains[j].total_cmp(&self.gains[i]));
        order
    }

    /// The rank of each source by its largest error, 1 for the largest; equal ones in their order.
    pub fn ranks(&self) -> Vec<usize> {
        let norm = |i: usize| self.sources[i].plain_max.norm;
        let mut order = (0..self.sources.len()).collect::<Vec<_>>();
        order.sort_by(|&i, &j| norm(j).total_cmp(&norm(i)));
        let mut ranks = vec![0; order.len()];
        for (rank, source) in order.into_iter().enumerate() {
            ranks[source] = rank + 1;
        }
        ranks
    }
}
