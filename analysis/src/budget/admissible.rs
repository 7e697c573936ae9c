//! The budget backwards: how large the sources may be for a tolerance.

use super::Budget;
use crate::Measurand;

/// A normal error is within its bound, 3σ, with this probability.
const WITHIN_BOUND: f64 = 0.997_300_203_936_739_8;

/// How large the sources may be for a tolerance T. Scales are multiples of what the sources are now; none where nothing
/// limits them, because they do nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct Admissible {
    /// Each source alone, as if there were no other: `T / max ‖ΔX_k‖`.
    pub alone: Vec<Option<f64>>,
    /// All by the same factor, so that the paper's radius `max ‖Σ repeatable‖ + ‖RSS random‖` is T: `T / radius`.
    pub together: Option<f64>,
    /// What every source may contribute if all contribute alike: `a = T / n` with n sources that do something.
    pub share: Option<f64>,
    /// Each source at its equal share: `a / max ‖ΔX_k‖`.
    pub equal: Vec<Option<f64>>,
    /// How likely T is met with equal shares, at least. 1 if all random sources are bounded: wherever each is worst, and
    /// whatever their signs, `Σ ‖ΔX_k‖ ≤ n a`. Otherwise 0.9973^m, the probability that the m normal ones are all within
    /// their bounds.
    pub equal_probability: f64,
}

impl Admissible {
    /// For the position errors of a budget and a tolerance in the length unit.
    pub fn new(budget: &Budget, tolerance: f64) -> Self {
        Self::of_measurand(budget, Measurand::Position, tolerance)
    }

    /// For the errors of a measurand and a tolerance in its unit.
    pub fn of_measurand(budget: &Budget, measurand: Measurand, tolerance: f64) -> Self {
        let (sources, combined, _) = budget.errors(measurand);
        let radius = combined.radius.value;
        let largest = || sources.iter().map(|errors| errors.plain_max.norm);
        let scale = |limit: f64, norm: f64| (norm > 0.0).then(|| limit / norm).filter(|s| s.is_finite());
        let active = sources.iter().filter(|errors| errors.plain_max.norm > 0.0);
        let unbounded = active.clone().filter(|errors| !errors.class.is_bounded()).count();
        let count = active.count();
        let share = (count > 0).then(|| tolerance / count as f64);
        Self {
            alone: largest().map(|norm| scale(tolerance, norm)).collect(),
            together: scale(tolerance, radius),
            share,
            equal: largest().map(|norm| scale(share?, norm)).collect(),
            equal_probability: WITHIN_BOUND.powi(unbounded as i32),
        }
    }
}

impl Budget {
    /// The sources in the order in which they should be tightened for position: the largest gain per percent first.
    pub fn tighten_first(&self) -> Vec<usize> {
        self.tighten_first_for(Measurand::Position)
    }

    /// The same for a measurand.
    pub fn tighten_first_for(&self, measurand: Measurand) -> Vec<usize> {
        let (_, _, gains) = self.errors(measurand);
        let mut order = (0..gains.len()).collect::<Vec<_>>();
        order.sort_by(|&i, &j| gains[j].total_cmp(&gains[i]));
        order
    }

    /// The rank of each source by its largest position error, 1 for the largest; equal ones in their order.
    pub fn ranks(&self) -> Vec<usize> {
        self.ranks_for(Measurand::Position)
    }

    /// The same for a measurand.
    pub fn ranks_for(&self, measurand: Measurand) -> Vec<usize> {
        let (sources, ..) = self.errors(measurand);
        let norm = |i: usize| sources[i].plain_max.norm;
        let mut order = (0..sources.len()).collect::<Vec<_>>();
        order.sort_by(|&i, &j| norm(j).total_cmp(&norm(i)));
        let mut ranks = vec![0; order.len()];
        for (rank, source) in order.into_iter().enumerate() {
            ranks[source] = rank + 1;
        }
        ranks
    }
}
