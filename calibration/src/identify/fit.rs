//! Least squares on the exact model: what is asked for, and what comes out.

use nalgebra::DMatrix;

use super::clustered::{Independent, Known};
use super::solver::Solver;
use super::{
    Configurations, Failure, Identifiable, Loss, Model, Observation, Options, identifiable, knowable,
};

/// An observation with less weight than this counts as left out.
pub(super) const REJECTED: f64 = 0.05;

/// The result of a fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// What the data determine.
    pub identifiable: Identifiable,
    /// The unknowns, zero where they are held.
    pub x: Vec<f64>,
    /// Covariance of the kept ones, in the order of `identifiable.kept`.
    pub covariance: DMatrix<f64>,
    /// The priors that it was found with.
    pub priors: Vec<Option<f64>>,
    /// What the uncertainty of the instrument must be multiplied with to explain the residuals.
    pub sigma: f64,
    /// Degrees of freedom of that, and of the covariance: Student's t says what standard deviations hold.
    pub freedom: f64,
    /// What was counted as independent.
    pub independent: Independent,
    /// How many configurations stand behind it; those of gross errors do not.
    pub configurations: usize,
    /// Weighted sum of squared residuals, in units of the uncertainty.
    pub cost: f64,
    /// Numbers measured.
    pub numbers: usize,
    /// 0 for every observation that a robust loss left out, 1 for all others; their own weights come on top.
    pub weights: Vec<f64>,
    /// How many steps were made.
    pub steps: usize,
}

impl Fit {
    /// The standard deviation of every unknown; none where it is held at zero.
    pub fn standard_deviations(&self) -> Vec<Option<f64>> {
        let mut all = vec![None; self.x.len()];
        for (i, k) in self.identifiable.kept.iter().enumerate() {
            all[*k] = Some(self.covariance[(i, i)].max(0.0).sqrt());
        }
        all
    }

    /// Kept unknowns of which the data say less than was known before, by their priors.
    pub fn hardly_known(&self) -> Vec<usize> {
        let deviations = self.standard_deviations();
        let hardly = |k: &usize| match (deviations[*k], self.priors.get(*k).copied().flatten()) {
            (Some(found), Some(prior)) => found > 0.5 * prior,
            _ => false,
        };
        self.identifiable.kept.iter().copied().filter(hardly).collect()
    }

    /// Pairs of kept unknowns whose correlation is beyond `least`, either sign, strongest first.
    pub fn correlations(&self, least: f64) -> Vec<(usize, usize, f64)> {
        let mut pairs = Vec::new();
        for i in 0..self.identifiable.kept.len() {
            for j in 0..i {
                let c = self.covariance[(i, j)] / (self.covariance[(i, i)] * self.covariance[(j, j)]).sqrt();
                if c.abs() > least {
                    pairs.push((self.identifiable.kept[j], self.identifiable.kept[i], c));
                }
            }
        }
        pairs.sort_by(|a, b| b.2.abs().total_cmp(&a.2.abs()));
        pairs
    }

    /// The observations that a robust loss left out; `data` are those of the fit.
    pub fn rejected<'o>(&self, data: &'o [Observation]) -> impl Iterator<Item = &'o Observation> {
        self.weighed(data).filter(|(weight, _)| *weight < REJECTED).map(|(_, observation)| observation)
    }

    /// All others.
    pub fn kept<'o>(&self, data: &'o [Observation]) -> impl Iterator<Item = &'o Observation> {
        self.weighed(data).filter(|(weight, _)| *weight >= REJECTED).map(|(_, observation)| observation)
    }

    /// Whether the observation of that number is one of these.
    pub fn is_kept(&self, i: usize) -> bool {
        self.weights[i] >= REJECTED
    }

    /// Every observation with the weight that the loss gave it.
    pub(super) fn weighed<'o>(
        &self,
        data: &'o [Observation],
    ) -> impl Iterator<Item = (f64, &'o Observation)> {
        self.weights.iter().copied().zip(data)
    }
}

/// The unknowns that explain the measurements best.
///
/// What cannot be known is held at zero; see [`identifiable()`]. Known sources do not count there: an error that
/// changes from place to place makes groups differ by a little of a little, which no data of a real machine tell.
pub fn fit(model: &Model, data: &[Observation], options: &Options) -> Result<Fit, Failure> {
    let mut at = options.at.clone();
    at.resize(model.unknowns.len(), 0.0);
    let plain = model.without_known_sources();
    let identifiable = match options.expected.is_empty() {
        true => identifiable(&plain, data, &at)?,
        false => knowable(&plain, data, &at, &options.expected, options.noise)?,
    };
    let numbers = data.iter().map(Observation::count).sum();
    // A configuration that is visited again tells no more of the machine. What is told badly counts, too: as many numbers
    // are explained by anything.
    let (independent, configurations) = Configurations::independent(data);
    let rank = identifiable.rank + identifiable.weak.len();
    if independent <= rank {
        return Err(Failure::TooFew { numbers: independent, configurations, rank });
    }
    let kept = model.with(identifiable.kept.iter().map(|k| model.unknowns[*k]).collect());
    // The same place with what is held at zero: to first order, which is near enough to start from.
    let mut start = at.clone();
    for (k, act_as) in &identifiable.held {
        act_as.iter().for_each(|(j, factor)| start[*j] += factor * at[*k]);
    }
    let start = identifiable.kept.iter().map(|k| start[*k]).collect();
    let mut solver = Solver::new(&kept, data, options, &identifiable.kept, start);
    let known = match options.loss {
        Loss::Squares => None,
        loss => solver.leave_out_gross_errors(loss, options.steps)?,
    };
    if !solver.steps_at_most(options.steps)? {
        return Err(Failure::NotConverged { steps: solver.steps });
    }
    let cost = solver.cost_of_data();
    let known = known.map_or_else(|| solver.known(), Ok)?;
    let Known { covariance, sigma, freedom, independent, configurations } = known;
    let mut x = vec![0.0; model.unknowns.len()];
    identifiable.kept.iter().zip(solver.x.iter()).for_each(|(k, value)| x[*k] = *value);
    let (priors, weights, steps) = (options.priors.clone(), solver.weights, solver.steps);
    Ok(Fit {
        identifiable,
        x,
        covariance,
        priors,
        sigma,
        freedom,
        independent,
        configurations,
        cost,
        numbers,
        weights,
        steps,
    })
}
