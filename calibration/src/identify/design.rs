//! Optimal designs: the most informative configurations of a list.
//!
//! With `J_i` the derivatives of the measurement at configuration i, in units of its uncertainty, a
//! design has the information matrix `M = Σ J_iᵀJ_i` and the covariance `C = M⁻¹`. A D-optimal
//! design maximizes `det M`. A V-optimal design minimizes the mean variance of the tool point over
//! the configurations of use, `tr(C B)`, with `B` the mean of `TᵀT` over the derivatives `T` of the
//! tool point.
//!
//! The search is that of Mitchell, *An algorithm for the construction of D-optimal experimental
//! designs*, 1974: it adds the configuration with the largest gain and removes the one with the
//! smallest loss, as long as the objective improves. For long lists, it first exchanges many at
//! once (Fedorov's exchange for a bounded density), because each pass over the list has the same
//! cost.

use nalgebra::{DMatrix, DVector};

use super::information::{Candidates, Criterion, Information};
use super::{Identifiable, Model, Observation, Result, ToolPoints};
use abbe_analysis::sampling;

/// Objective of a design.
#[derive(Clone, Copy, Debug)]
pub struct Objective<'a> {
    /// The criterion.
    pub criterion: Criterion,
    /// Derivatives of the tool point at the configurations of use.
    pub used: &'a ToolPoints,
    /// Standard deviation of the residual error of the model, per coordinate, in the length unit.
    ///
    /// It adds to the noise of the instrument, is common to all targets of a configuration, and is
    /// independent between configurations. For an angle, it is divided by the length of the arm.
    pub model_error: f64,
}

/// Configurations chosen from a list.
#[derive(Clone, Debug, PartialEq)]
pub struct Design {
    /// Indices in the list, ascending and distinct.
    pub chosen: Vec<usize>,
    /// `ln det(JᵀJ)`, with columns of unit length over the whole list.
    pub log_det: f64,
    /// Mean variance of the tool point over the configurations of use, `tr(C B)`, in the length
    /// unit squared, without the residual error of the model.
    pub variance: f64,
    /// Covariance of the kept unknowns.
    pub covariance: DMatrix<f64>,
    /// Number of exchanges.
    pub exchanges: usize,
}

/// Largest number of evaluations of a candidate, each a fraction of a microsecond.
const LOOKS: usize = 3_000_000;
/// Largest number of pairs for a search from several starts.
const SHORT: usize = 2_000;
const STARTS: usize = 6;
/// Smallest relative gain of an exchange.
const GAIN: f64 = 1e-9;
/// Regularization of an undetermined design, as a share of the information of the whole list.
const RIDGE: f64 = 1e-9;

/// Chooses `count` of the `candidates` that are best by the objective, without repetition.
///
/// The unknowns of `model` must be identifiable. Only the kind of measurement at a candidate
/// counts, not its values. `progress` receives the completed and the largest possible number of
/// evaluations. Returns none if `count` configurations cannot determine the unknowns, or if there
/// are fewer candidates.
pub fn optimal(
    model: &Model,
    candidates: &[Observation],
    identifiable: &Identifiable,
    count: usize,
    objective: &Objective<'_>,
    progress: &mut dyn FnMut(usize, usize),
) -> Result<Option<Design>> {
    let search = Search::new(model, candidates, identifiable, objective, progress)?;
    let n = candidates.len();
    if count > n || count == 0 {
        return Ok(None);
    }
    let starts = if n * count <= SHORT { STARTS } else { 1 };
    let looks = LOOKS / starts;
    let mut best: Option<(f64, Vec<usize>, usize)> = None;
    for start in 0..starts {
        let (value, chosen, exchanges) =
            search.exchanged(spread(n, count, start), looks, &mut |done| progress(n * done / looks, n));
        if best.as_ref().is_none_or(|(least, ..)| value < *least) {
            best = Some((value, chosen, exchanges));
        }
    }
    progress(n, n);
    Ok(best.and_then(|(_, chosen, exchanges)| search.design(chosen, exchanges)))
}

/// Evaluates a list as a design that has each configuration once; `progress` receives the number of
/// evaluated configurations and their total.
pub fn whole(
    model: &Model,
    list: &[Observation],
    identifiable: &Identifiable,
    objective: &Objective<'_>,
    progress: &mut dyn FnMut(usize, usize),
) -> Result<Option<Design>> {
    Ok(Search::new(model, list, identifiable, objective, progress)?.design((0..list.len()).collect(), 0))
}

/// Returns a spread-out initial design; each `start` gives a different one.
fn spread(n: usize, count: usize, start: usize) -> Vec<usize> {
    let mut chosen: Vec<usize> = match start {
        0 => (0..count).map(|i| i * n / count).collect(),
        _ => Vec::new(),
    };
    let mut index = 1;
    while chosen.len() < count {
        let next = (sampling::halton(index, start) * n as f64) as usize;
        // In small lists, fills up in order with the candidates that the sequence misses.
        let next = if index <= 8 * n { next.min(n - 1) } else { index % n };
        if !chosen.contains(&next) {
            chosen.push(next);
        }
        index += 1;
    }
    chosen
}

struct Search {
    candidates: Candidates,
    criterion: Criterion,
    /// Original lengths of the columns, in the units of the unknowns.
    lengths: DVector<f64>,
}

impl Search {
    fn new(
        model: &Model,
        candidates: &[Observation],
        identifiable: &Identifiable,
        objective: &Objective<'_>,
        progress: &mut dyn FnMut(usize, usize),
    ) -> Result<Self> {
        let kept = model.with(identifiable.kept.iter().map(|k| model.unknowns[*k]).collect());
        let mut all = Candidates::new(&kept, candidates, objective.model_error, progress)?;
        let lengths = all.normalize();
        let used = objective.used.mean_square(&identifiable.kept);
        all.set_objective(&DMatrix::from_fn(lengths.len(), lengths.len(), |i, j| {
            used[(i, j)] / (lengths[i] * lengths[j])
        }));
        Ok(Self { candidates: all, criterion: objective.criterion, lengths })
    }

    /// Returns the minimized objective, `−ln det M` or `tr(C B)`; infinite if `M` is singular.
    fn value(&self, information: &DMatrix<f64>) -> (f64, Option<Information>) {
        let held = information + DMatrix::identity(self.lengths.len(), self.lengths.len()) * RIDGE;
        let Some(found) = Information::new(held, self.candidates.objective_root()) else {
            return (f64::INFINITY, None);
        };
        let value = match self.criterion {
            Criterion::Determinant => -found.log_det,
            Criterion::Variance => found.variance,
        };
        (value, Some(found))
    }

    /// Searches from a start: returns the value, the design and the number of exchanges.
    fn exchanged(
        &self,
        mut chosen: Vec<usize>,
        looks: usize,
        progress: &mut dyn FnMut(usize),
    ) -> (f64, Vec<usize>, usize) {
        let (n, count) = (self.candidates.len(), chosen.len());
        let mut inside = vec![false; n];
        chosen.iter().for_each(|i| inside[*i] = true);
        let mut sum = self.candidates.sum(&chosen);
        let (mut value, mut found) = self.value(&sum);
        let (mut done, mut exchanges) = (0, 0);
        let mut together = (count / 4).min(n - count);
        if n < 2000 {
            together = together.min(1);
        }
        while together > 0 && done < looks {
            let Some(information) = &found else { break };
            done += n + count;
            progress(done.min(looks));
            if together > 1 {
                let gains = self.candidates.gains(information, self.criterion, |i| inside[i]);
                let mut outside: Vec<usize> = (0..n).filter(|i| !inside[*i]).collect();
                outside.sort_by(|a, b| gains[*b].total_cmp(&gains[*a]));
                let mut order: Vec<usize> = (0..count).collect();
                order.sort_by(|a, b| gains[chosen[*a]].total_cmp(&gains[chosen[*b]]));
                let mut trial = chosen.clone();
                order.iter().zip(&outside).take(together).for_each(|(place, i)| trial[*place] = *i);
                let there = self.candidates.sum(&trial);
                let (reached, information) = self.value(&there);
                if reached < value - GAIN * value.abs() {
                    chosen.iter().for_each(|i| inside[*i] = false);
                    trial.iter().for_each(|i| inside[*i] = true);
                    exchanges += together;
                    (chosen, sum, value, found) = (trial, there, reached, information);
                } else {
                    together /= 2;
                }
                continue;
            }
            // Single exchanges: add the best candidate, then remove the one with the smallest loss.
            let gains = self.candidates.gains(information, self.criterion, |_| false);
            let best = |a: &usize, b: &usize| gains[*a].total_cmp(&gains[*b]);
            let Some(add) = (0..n).filter(|i| !inside[*i]).max_by(best) else { break };
            let with = &sum + self.candidates.information(add);
            let (_, Some(information)) = self.value(&with) else { break };
            let losses = self.candidates.losses(&information, self.criterion, &chosen);
            let Some(place) = (0..count).min_by(|a, b| losses[*a].total_cmp(&losses[*b])) else { break };
            let without = with - self.candidates.information(chosen[place]);
            let (reached, information) = self.value(&without);
            if reached >= value - GAIN * value.abs() {
                break;
            }
            inside[chosen[place]] = false;
            inside[add] = true;
            chosen[place] = add;
            exchanges += 1;
            (sum, value, found) = (without, reached, information);
        }
        if n * count <= SHORT {
            exchanges += self.pairs(&mut chosen, &mut value);
        }
        (value, chosen, exchanges)
    }

    /// Tries all pairs until no exchange improves a short list.
    fn pairs(&self, chosen: &mut [usize], value: &mut f64) -> usize {
        let mut exchanges = 0;
        loop {
            let sum = self.candidates.sum(chosen);
            let mut best = (*value - GAIN * value.abs(), None);
            for place in 0..chosen.len() {
                let without = &sum - self.candidates.information(chosen[place]);
                let (_, Some(information)) = self.value(&without) else { continue };
                let gains = self.candidates.gains(&information, self.criterion, |_| false);
                for i in (0..self.candidates.len()).filter(|i| !chosen.contains(i)) {
                    // Exact value of the exchange.
                    let reached = match self.criterion {
                        Criterion::Determinant => -information.log_det - gains[i],
                        Criterion::Variance => information.variance - gains[i],
                    };
                    if reached < best.0 {
                        best = (reached, Some((place, i)));
                    }
                }
            }
            let Some((place, i)) = best.1 else { return exchanges };
            let before = chosen[place];
            chosen[place] = i;
            let (reached, _) = self.value(&self.candidates.sum(chosen));
            if reached >= *value - GAIN * value.abs() {
                // The gain was rounding error.
                chosen[place] = before;
                return exchanges;
            }
            *value = reached;
            exchanges += 1;
        }
    }

    /// Returns the design without regularization; none if it does not determine the unknowns.
    fn design(&self, mut chosen: Vec<usize>, exchanges: usize) -> Option<Design> {
        chosen.sort_unstable();
        let found = Information::new(self.candidates.sum(&chosen), self.candidates.objective_root())?;
        let p = self.lengths.len();
        let covariance = found.covariance();
        // Smaller information is rounding error of the sum: the design does not determine that
        // direction.
        let largest = self.candidates.sum(&chosen).diagonal().max();
        if (0..p).any(|i| covariance[(i, i)] * largest > 1e14) {
            return None;
        }
        let covariance =
            DMatrix::from_fn(p, p, |i, j| covariance[(i, j)] / (self.lengths[i] * self.lengths[j]));
        Some(Design { chosen, log_det: found.log_det, variance: found.variance, covariance, exchanges })
    }
}
