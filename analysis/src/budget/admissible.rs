//! The inverse budget: admissible sizes of the sources for a tolerance.

use super::Budget;
use crate::Measurand;

/// Probability that a normal error is within its bound, 3σ.
const WITHIN_BOUND: f64 = 0.997_300_203_936_739_8;

/// Admissible sizes of the sources for a tolerance T. Scales are multiples of the present sizes.
/// `None` for a source without effect, which nothing limits.
#[derive(Clone, Debug, PartialEq)]
pub struct Admissible {
    /// Scale of each source without the others: `T / max ‖ΔX_k‖`.
    pub alone: Vec<Option<f64>>,
    /// Common scale of all sources at which the paper's radius `max ‖Σ repeatable‖ + ‖RSS random‖`
    /// is T: `T / radius`.
    pub together: Option<f64>,
    /// Contribution of each source if all contribute equally: `a = T / n` with n sources that have
    /// an effect.
    pub share: Option<f64>,
    /// Scale of each source at its equal share: `a / max ‖ΔX_k‖`.
    pub equal: Vec<Option<f64>>,
    /// Lower bound of the probability that T is met with equal shares. 1 if all random sources are
    /// bounded, since `Σ ‖ΔX_k‖ ≤ n a` for any signs and any worst configurations. Otherwise
    /// 0.9973^m, the probability that the m normal errors are all within their bounds.
    pub equal_probability: f64,
}

impl Admissible {
    /// Computes the admissible sizes for the position errors of a budget and a tolerance in the
    /// length unit.
    pub fn new(budget: &Budget, tolerance: f64) -> Self {
        Self::for_measurand(budget, Measurand::Position, tolerance)
    }

    /// Computes the admissible sizes for a measurand and a tolerance in its unit.
    pub fn for_measurand(budget: &Budget, measurand: Measurand, tolerance: f64) -> Self {
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
    /// Returns the sources in the order in which to tighten them for position: the largest gain per
    /// percent first.
    pub fn tighten_first(&self) -> Vec<usize> {
        self.tighten_first_for(Measurand::Position)
    }

    /// Returns the sources in the order in which to tighten them for a measurand.
    pub fn tighten_first_for(&self, measurand: Measurand) -> Vec<usize> {
        let (_, _, gains) = self.errors(measurand);
        let mut order = (0..gains.len()).collect::<Vec<_>>();
        order.sort_by(|&i, &j| gains[j].total_cmp(&gains[i]));
        order
    }

    /// Returns the rank of each source by its largest position error, 1 for the largest. Equal
    /// errors are ranked in the order of the sources.
    pub fn ranks(&self) -> Vec<usize> {
        self.ranks_for(Measurand::Position)
    }

    /// Returns the rank of each source by its largest error of a measurand.
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
