//! Allocation: factors of the error sources at which a tolerance is kept at least cost.
//!
//! Source k has the effect `v_k(q)` at configuration q, as a share of the tolerance. With the
//! factors x, and with all smaller ones, a repeatable source adds `y v_k` with `0 ≤ y ≤ x_k`, any
//! other source `y v_k` with `|y| ≤ x_k`. The largest error is, with `|·|⁺ = max(0, ·)`,
//!
//! ```text
//! (1)  W(x) = max_q max_y ‖Σ y_k v_k‖ = max_{q,n} a(q,n)·x
//!      a_k = |n·v_k|⁺ if repeatable, otherwise |n·v_k|          n: unit vectors
//! (2)  R(x) = max_q [ max_y ‖Σ y_k r_k‖ + √Σ x_k² ‖b_k‖² ]      r repeatable, b others
//! ```
//!
//! since a norm is the largest product with a unit vector, and each product is largest at an end of
//! its range; an error with several parts adds its largest norm in any direction. Both are convex,
//! homogeneous and nondecreasing in x ≥ 0: if `W(x) ≤ 1` then `W(x′) ≤ 1` for all `x′ ≤ x`. In (1)
//! the largest `a(q,n)·x` has n along the longest vector of the zonotope with the centre `Σ x_k
//! v_k/2` over repeatable sources, the half-edges `x_k v_k/2` of these and `x_k v_k` of the others.
//! By Euler `R(x) = ∇R(x)·x`, and `∇R(x)·x′ ≤ R(x′)` as R is convex. So each x that exceeds the
//! tolerance gives a cut `a·x′ ≤ 1`, `a ≥ 0`, which holds for all admissible x′ and excludes x.
//!
//! ```text
//! (3)  minimize Σ c_k x_k^(−p_k)   subject to   A x ≤ 1,  l_k ≤ x_k ≤ u_k
//! (4)  c_k p_k x_k^(−p_k−1) = (λᵀA)_k  where l_k < x_k < u_k,   λ ≥ 0,   λ_i (1 − a_i·x) = 0
//! ```
//!
//! The optimum of (3) over the cuts costs no more than any admissible allocation. Cuts are added
//! until it is admissible itself. The objective is strictly convex, so it is the only one.

mod program;
#[cfg(test)]
mod tests;

use abbe_kinematics::sampling::norm;

pub use self::program::ScalableSource;
use self::program::minimize;
use crate::{Measurand, worst_case};

/// Largest value of the criterion in the optimization, and by how much of it a cut may be exceeded
/// there. Their product is less than 1, so the allocated factors keep the tolerance.
const TARGET: f64 = 1.0 - 2e-10;
const EXCESS: f64 = 1e-10;
/// Number of cuts that are added at once, and slack above which one is dropped. The cost grows from
/// round to round, so none returns forever.
const CUTS: usize = 8;
const SLACK: f64 = 0.2;
/// Largest number of rounds.
const ROUNDS: usize = 2000;

/// Largest error at a configuration as a function of the factors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AllocationCriterion {
    /// Formula (1): all errors that are not repeatable have any sign.
    WorstCase,
    /// Formula (2): these errors add by the root sum of squares of their norms.
    RootSumOfSquares,
}

/// Errors of one measurand at one configuration.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorRow {
    /// Index of the configuration.
    pub configuration: usize,
    /// Position or orientation.
    pub measurand: Measurand,
    /// Error of each source at the factor 1, divided by the tolerance; of an error with several
    /// parts a vector with its largest norm, and zeros.
    pub errors: Vec<[f64; 3]>,
}

/// Factors at least cost.
#[derive(Clone, Debug)]
pub struct Allocation {
    /// Factor of each source.
    pub factors: Vec<f64>,
    /// Rows at which the tolerance is reached, with their multipliers λ: the derivative of the cost
    /// by a relative increase of the errors there. The largest is first.
    pub active: Vec<(usize, f64)>,
    /// Largest residual of the conditions (4): stationarity relative to the slope of the cost,
    /// complementarity relative to Σ λ, excess over the tolerance relative to it.
    pub residual: f64,
}

/// Optimization of the factors over rows, which may be added between solutions.
#[derive(Clone, Debug)]
pub struct Allocator {
    criterion: AllocationCriterion,
    /// The sources.
    pub sources: Vec<ScalableSource>,
    /// The rows.
    pub rows: Vec<ErrorRow>,
    /// Rows and slopes a of the cuts.
    cuts: Vec<(usize, Vec<f64>)>,
}

impl Allocator {
    /// Creates the optimization without rows.
    pub fn new(criterion: AllocationCriterion, sources: Vec<ScalableSource>) -> Self {
        Self { criterion, sources, rows: Vec::new(), cuts: Vec::new() }
    }

    /// Returns the optimization with one factor for all sources that are not fixed.
    pub fn with_one_factor(&self) -> Self {
        let mut one = Self { cuts: Vec::new(), ..self.clone() };
        let first = one.sources.iter().position(|source| !source.is_fixed()).unwrap_or_default();
        let is_free = |source: &&mut ScalableSource| !self.sources[source.follows].is_fixed();
        one.sources.iter_mut().filter(is_free).for_each(|source| source.follows = first);
        one
    }

    /// Returns the criterion at a row, or an upper bound of it that is less than `least`.
    pub fn value(&self, errors: &[[f64; 3]], factors: &[f64], least: f64) -> f64 {
        let lengths = errors.iter().zip(&self.sources).map(|(v, source)| factors[source.follows] * norm(*v));
        let sum: f64 = lengths.sum();
        if sum < least { sum } else { product(&self.slopes(errors, factors), factors) }
    }

    /// Returns the gradient of the criterion at a row by the factors; the value is their product.
    fn slopes(&self, errors: &[[f64; 3]], factors: &[f64]) -> Vec<f64> {
        let is_linear = self.criterion == AllocationCriterion::WorstCase;
        let (mut center, mut edges, mut square) = ([0.0; 3], Vec::new(), 0.0);
        let all = || errors.iter().zip(&self.sources);
        for (v, source) in all() {
            let edge = v.map(|v| factors[source.follows] * v);
            match source.is_repeatable {
                true => {
                    center = core::array::from_fn(|i| center[i] + edge[i] / 2.0);
                    edges.push(edge.map(|edge| edge / 2.0));
                }
                false if is_linear && source.has_parts => {}
                false if is_linear => edges.push(edge),
                false => square += norm(edge).powi(2),
            }
        }
        let longest = worst_case(center, &edges);
        let [length, root] = [norm(longest), square.sqrt()].map(|norm| norm.max(f64::MIN_POSITIVE));
        let mut slopes = vec![0.0; errors.len()];
        for (v, source) in all() {
            let along = product(&longest, v) / length;
            slopes[source.follows] += match source.is_repeatable {
                true => along.max(0.0),
                false if is_linear && source.has_parts => norm(*v),
                false if is_linear => along.abs(),
                false => factors[source.follows] * norm(*v).powi(2) / root,
            };
        }
        slopes
    }

    /// Returns the largest value of the criterion for factors of the sources.
    pub fn largest(&self, factor: impl Fn(&ScalableSource) -> f64) -> f64 {
        let factors: Vec<f64> = self.sources.iter().map(factor).collect();
        self.rows.iter().fold(0.0, |most, row| most.max(self.value(&row.errors, &factors, most)))
    }

    /// Returns the optimal factors.
    ///
    /// # Errors
    ///
    /// Returns the largest value of the criterion of the fixed sources alone, and with all others
    /// at their lower limits, if that exceeds the tolerance.
    pub fn solve(&mut self) -> Result<Allocation, [f64; 2]> {
        let at_lower_limits = self.largest(|source| source.limits[0]);
        if at_lower_limits >= TARGET {
            let fixed = |source: &ScalableSource| if source.is_fixed() { source.limits[0] } else { 0.0 };
            return Err([self.largest(fixed), at_lower_limits]);
        }
        for round in 1.. {
            let (factors, multipliers) = minimize(&self.sources, &self.cuts, TARGET);
            let value = |row: &ErrorRow| self.value(&row.errors, &factors, TARGET);
            let mut values: Vec<(f64, usize)> = self.rows.iter().map(value).zip(0..).collect();
            values.sort_by(|a, b| b.0.total_cmp(&a.0));
            let excess = values.first().map_or(0.0, |(value, _)| value - TARGET);
            if excess <= EXCESS * TARGET || round == ROUNDS {
                return Ok(self.allocation(&factors, &multipliers, excess.max(0.0)));
            }
            let exceeding = values.iter().take(CUTS).filter(|(value, _)| *value > TARGET);
            let cut = |(_, row): &(f64, usize)| (*row, self.slopes(&self.rows[*row].errors, &factors));
            let added: Vec<(usize, Vec<f64>)> = exceeding.map(cut).collect();
            self.cuts.retain(|(_, slopes)| product(slopes, &factors) > TARGET * (1.0 - SLACK));
            self.cuts.extend(added);
        }
        unreachable!("the last round returns")
    }

    /// Evaluates the conditions (4).
    fn allocation(&self, factors: &[f64], multipliers: &[f64], excess: f64) -> Allocation {
        let sum: f64 = multipliers.iter().sum();
        let cuts = || self.cuts.iter().zip(multipliers);
        let stationarity = self.sources.iter().zip(factors).enumerate().map(|(k, (source, factor))| {
            let is_inside = source.follows == k && source.limits[0] < *factor && *factor < source.limits[1];
            let own = source.exponent * source.cost_of(*factor);
            let slope: f64 = cuts().map(|((_, slopes), multiplier)| multiplier * slopes[k]).sum();
            if is_inside { (own - factor * slope).abs() / own } else { 0.0 }
        });
        let complementarity = cuts().map(|((_, slopes), multiplier)| {
            let slack = TARGET - product(slopes, factors);
            (multiplier * slack / sum).max(-slack)
        });
        let residual = stationarity.chain(complementarity).fold(excess, f64::max);
        let of_row = |row: usize| cuts().filter(move |((of, _), _)| *of == row).map(|(_, own)| own).sum();
        let mut active: Vec<(usize, f64)> = (0..self.rows.len()).map(|row| (row, of_row(row))).collect();
        active.retain(|(_, multiplier)| *multiplier > 1e-6 * sum);
        active.sort_by(|a, b| b.1.total_cmp(&a.1));
        let factors = self.sources.iter().map(|source| factors[source.follows]).collect();
        Allocation { factors, active, residual }
    }

    /// Returns the cost of factors.
    pub fn cost(&self, factors: &[f64]) -> f64 {
        let own = self.sources.iter().zip(factors).enumerate();
        let own = own.filter(|(k, (source, _))| source.follows == *k && !source.is_fixed());
        own.map(|(_, (source, factor))| source.cost_of(*factor)).sum()
    }
}

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
