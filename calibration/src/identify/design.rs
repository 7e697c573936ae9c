//! Where to measure: the configurations of a list that tell most.
//!
//! With `J_i` the derivatives of what is seen at configuration i, in units of its uncertainty, a choice has the information
//! `M = Σ J_iᵀJ_i` and leaves the covariance `C = M⁻¹`. D-optimal is the largest `det M`; V-optimal the smallest mean variance
//! of the tool point where the machine is used, `tr(C B)` with `B` the mean of `TᵀT` over the tool points' derivatives `T`.
//!
//! Mitchell, *An algorithm for the construction of D-optimal experimental designs*, 1974: a configuration is added where it gains
//! most, the one that is missed least is taken away, as long as that gains. Of long lists many are exchanged at once to begin
//! with (Fedorov's exchange for a bounded density), as every look at the list costs the same.

use nalgebra::{DMatrix, DVector};

use super::information::{Candidates, Criterion, Information};
use super::{Failure, Identifiable, Model, Observation, ToolPoints};
use abbe_analysis::sampling;

/// What a choice is judged by.
#[derive(Clone, Copy, Debug)]
pub struct Objective<'a> {
    /// The criterion.
    pub criterion: Criterion,
    /// How the tool point moves where the machine is used.
    pub used: &'a ToolPoints,
    /// One standard deviation of what the model itself leaves of a coordinate, beside the instrument's noise, in the length
    /// unit: the same for all targets of a configuration, and independent from one configuration to the next. Of an angle it
    /// is as much as that is over the length of the arm.
    pub model_error: f64,
}

/// Configurations chosen from a list.
#[derive(Clone, Debug, PartialEq)]
pub struct Design {
    /// By index in the list, ascending, each at most once.
    pub chosen: Vec<usize>,
    /// `ln det(JᵀJ)` of columns that over the whole list have unit length.
    pub log_det: f64,
    /// The mean variance of the tool point where the machine is used: `tr(C B)`, the length unit squared. The model's own error
    /// comes on top.
    pub variance: f64,
    /// Covariance of the kept unknowns.
    pub covariance: DMatrix<f64>,
    /// How many exchanges were made.
    pub exchanges: usize,
}

/// So many looks at a candidate there are at most; a fraction of a microsecond each.
const LOOKS: usize = 3_000_000;
/// Lists with fewer pairs than this are searched from several starts.
const SHORT: usize = 2_000;
const STARTS: usize = 6;
/// An exchange that gains less than this share gains nothing.
const GAIN: f64 = 1e-9;
/// Holds up what a choice does not determine, as a share of what the whole list tells.
const RIDGE: f64 = 1e-9;

/// `count` of the `candidates` that are best by the objective; each is chosen once at most.
///
/// The unknowns of `model` are those that can be known; what was seen at the candidates does not matter, only which
/// targets or poses would be. `progress` hears how much of the search is done, of how much at most. None if `count`
/// configurations cannot determine them, or if there are fewer candidates.
pub fn optimal(
    model: &Model,
    candidates: &[Observation],
    identifiable: &Identifiable,
    count: usize,
    objective: &Objective<'_>,
    progress: &mut dyn FnMut(usize, usize),
) -> Result<Option<Design>, Failure> {
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

/// A list as it is: every configuration once; `progress` is told how many are evaluated, of how many.
pub fn whole(
    model: &Model,
    list: &[Observation],
    identifiable: &Identifiable,
    objective: &Objective<'_>,
    progress: &mut dyn FnMut(usize, usize),
) -> Result<Option<Design>, Failure> {
    let search = Search::new(model, list, identifiable, objective, progress)?;
    Ok(search.design((0..list.len()).collect(), 0))
}

/// Spread over the list; every start differently.
fn spread(n: usize, count: usize, start: usize) -> Vec<usize> {
    let mut chosen: Vec<usize> = match start {
        0 => (0..count).map(|i| i * n / count).collect(),
        _ => Vec::new(),
    };
    let mut index = 1;
    while chosen.len() < count {
        let next = (sampling::halton(index, start) * n as f64) as usize;
        // Small lists: what the sequence does not meet is taken in order.
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
    /// The lengths that the columns had, in the unknowns' units.
    lengths: DVector<f64>,
}

impl Search {
    fn new(
        model: &Model,
        candidates: &[Observation],
        identifiable: &Identifiable,
        objective: &Objective<'_>,
        progress: &mut dyn FnMut(usize, usize),
    ) -> Result<Self, Failure> {
        let kept = model.with(identifiable.kept.iter().map(|k| model.unknowns[*k]).collect());
        let mut all = Candidates::new(&kept, candidates, objective.model_error, progress)?;
        let lengths = all.normalize();
        let used = objective.used.of(&identifiable.kept);
        all.aim(&DMatrix::from_fn(lengths.len(), lengths.len(), |i, j| {
            used[(i, j)] / (lengths[i] * lengths[j])
        }));
        Ok(Self { candidates: all, criterion: objective.criterion, lengths })
    }

    /// What is to be small: `−ln det M`, or `tr(C B)`; infinite where there is no covariance.
    fn value(&self, information: &DMatrix<f64>) -> (f64, Option<Information>) {
        let held = information + DMatrix::identity(self.lengths.len(), self.lengths.len()) * RIDGE;
        let Some(found) = Information::new(held, self.candidates.aim_root()) else {
            return (f64::INFINITY, None);
        };
        let value = match self.criterion {
            Criterion::Determinant => -found.log_det,
            Criterion::Variance => found.variance,
        };
        (value, Some(found))
    }

    /// The exchanges from a start: what they reach, with what, in how many.
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
            // One for one: the best is added, then the one that is missed least is taken away.
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

    /// Short lists: every pair is tried until none gains.
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
                    // What is gained when i comes back instead, exactly.
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
                // Rounding.
                chosen[place] = before;
                return exchanges;
            }
            *value = reached;
            exchanges += 1;
        }
    }

    /// The choice, without what held it up; none if it determines too little.
    fn design(&self, mut chosen: Vec<usize>, exchanges: usize) -> Option<Design> {
        chosen.sort_unstable();
        let found = Information::new(self.candidates.sum(&chosen), self.candidates.aim_root())?;
        let p = self.lengths.len();
        let covariance = found.covariance();
        // Less than this is rounding of the sum: a direction that the choice does not tell.
        let largest = self.candidates.sum(&chosen).diagonal().max();
        if (0..p).any(|i| covariance[(i, i)] * largest > 1e14) {
            return None;
        }
        let covariance =
            DMatrix::from_fn(p, p, |i, j| covariance[(i, j)] / (self.lengths[i] * self.lengths[j]));
        Some(Design { chosen, log_det: found.log_det, variance: found.variance, covariance, exchanges })
    }
}
