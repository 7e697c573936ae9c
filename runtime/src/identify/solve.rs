//! Least squares on the exact model: Levenberg and Marquardt, on a triangle instead of a tall matrix.

use core::fmt;

use nalgebra::{DMatrix, DVector};

use super::known::{Known, what_can_be_known};
use super::robust::robust_scale;
use super::triangle::{Problem, Triangle};
use super::{Loss, Model, Observation};
use crate::Error;

/// Why there is no result.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// A row cannot be evaluated.
    Row(usize, Error),
    /// There are not more numbers than combinations to be known: nothing would be left to judge the result by.
    TooFew {
        /// Numbers measured.
        numbers: usize,
        /// Combinations of unknowns that they determine.
        rank: usize,
    },
    /// The steps do not come to an end: the model is far from what was measured.
    NotConverged {
        /// How many were made.
        steps: usize,
    },
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Row(row, error) => write!(f, "row {row}: {error}"),
            Self::TooFew { numbers, rank } => {
                write!(
                    f,
                    "{numbers} numbers were measured for {rank} unknowns: none is left to judge the result by"
                )
            }
            Self::NotConverged { steps } => write!(f, "no least squares solution after {steps} steps"),
        }
    }
}

impl core::error::Error for Failure {}

/// A row with less weight than this counts as left out.
pub(super) const REJECTED: f64 = 0.05;

/// How a fit is done.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Where it is judged what can be known; at zero, the nominal machine, if empty.
    ///
    /// A target exactly on the last axis hides more than one that is off it by as little as a real one is: the
    /// solution for base and tool alone is a good place.
    pub at: Vec<f64>,
    /// What a residual costs.
    pub loss: Loss,
    /// A standard deviation about zero for some unknowns, by index; none where nothing is known before.
    pub priors: Vec<Option<f64>>,
    /// The bounds of some unknowns, by index.
    pub bounds: Vec<Option<[f64; 2]>>,
    /// The most steps.
    pub steps: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self { at: Vec::new(), loss: Loss::Squares, priors: Vec::new(), bounds: Vec::new(), steps: 100 }
    }
}

/// The result of a fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// What the data determine.
    pub known: Known,
    /// The unknowns, zero where they are held.
    pub x: Vec<f64>,
    /// Covariance of the kept ones, in the order of `known.kept`.
    pub covariance: DMatrix<f64>,
    /// The priors that it was found with.
    pub priors: Vec<Option<f64>>,
    /// What the uncertainty of the instrument must be multiplied with to explain the residuals.
    pub sigma: f64,
    /// Weighted sum of squared residuals, in units of the uncertainty.
    pub cost: f64,
    /// Numbers measured.
    pub numbers: usize,
    /// The weight of every row.
    pub weights: Vec<f64>,
    /// How many steps were made.
    pub steps: usize,
}

impl Fit {
    /// The standard deviation of every unknown; none where it is held at zero.
    pub fn standard_deviations(&self) -> Vec<Option<f64>> {
        let mut all = vec![None; self.x.len()];
        for (i, k) in self.known.kept.iter().enumerate() {
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
        self.known.kept.iter().copied().filter(hardly).collect()
    }

    /// Pairs of kept unknowns whose correlation is beyond `least`, either sign, strongest first.
    pub fn correlations(&self, least: f64) -> Vec<(usize, usize, f64)> {
        let mut pairs = Vec::new();
        for i in 0..self.known.kept.len() {
            for j in 0..i {
                let c = self.covariance[(i, j)] / (self.covariance[(i, i)] * self.covariance[(j, j)]).sqrt();
                if c.abs() > least {
                    pairs.push((self.known.kept[j], self.known.kept[i], c));
                }
            }
        }
        pairs.sort_by(|a, b| b.2.abs().total_cmp(&a.2.abs()));
        pairs
    }

    /// Whether a row was left out.
    pub fn rejects(&self, row: usize) -> bool {
        self.weights.get(row).is_some_and(|weight| *weight < REJECTED)
    }

    /// Rows that a robust loss left out.
    pub fn rejected(&self) -> Vec<usize> {
        (0..self.weights.len()).filter(|row| self.rejects(*row)).collect()
    }
}

/// Residuals and derivatives of all rows at `x`, as a triangle.
pub(super) fn linearize(
    model: &Model,
    data: &[Observation],
    x: &[f64],
    weights: Option<&[f64]>,
) -> Result<Triangle, Failure> {
    let p = model.unknowns.len();
    let mut triangle = Triangle::new(p);
    let mut room = model.room();
    for (i, seen) in data.iter().enumerate() {
        let weight = weights.map_or(1.0, |weights| weights[i].sqrt());
        if weight > 0.0 {
            let take = |residual: f64, derivative: &mut dyn FnMut(usize) -> f64| {
                // A step solves J dx = −r.
                triangle.push((0..p).map(derivative).chain([-residual]), weight);
            };
            model.rows(&mut room, seen, x, take).map_err(|error| Failure::Row(i, error))?;
        }
    }
    Ok(triangle)
}

/// The unknowns that explain the measurements best.
///
/// What cannot be known is held at zero; see [`what_can_be_known`]. Known sources do not count there: an error that
/// changes from place to place makes groups differ by a little of a little, which no data of a real machine tell.
pub fn fit(model: &Model, data: &[Observation], options: &Options) -> Result<Fit, Failure> {
    let mut at = options.at.clone();
    at.resize(model.unknowns.len(), 0.0);
    let known = what_can_be_known(&model.without_known_sources(), data, &at)?;
    let numbers = data.iter().map(Observation::count).sum();
    if numbers <= known.rank {
        return Err(Failure::TooFew { numbers, rank: known.rank });
    }
    let kept = model.with(known.kept.iter().map(|k| model.unknowns[*k]).collect());
    // The same place with what is held at zero: to first order, which is near enough to start from.
    let mut start = at.clone();
    for (k, act_as) in &known.held {
        act_as.iter().for_each(|(j, factor)| start[*j] += factor * at[*k]);
    }
    let start = known.kept.iter().map(|k| start[*k]).collect();
    let mut solver = Solver::new(&kept, data, options, &known.kept, start);
    if options.loss != Loss::Squares {
        // Huber first: it comes near from anywhere; then the loss that was asked for. Gross errors never have their say.
        for round in 0..60 {
            let before = solver.x.clone();
            solver.reweight(if round < 12 { Loss::Huber } else { options.loss })?;
            solver.steps_at_most(3)?;
            let moved = (&solver.x - &before).component_mul(&solver.scale()).amax();
            if round >= 15 && moved < 1e-3 * solver.cost.sqrt() {
                break;
            }
        }
    }
    if !solver.steps_at_most(options.steps)? {
        return Err(Failure::NotConverged { steps: solver.steps });
    }
    let weight: f64 =
        solver.weights.iter().zip(data).map(|(weight, seen)| weight * seen.count() as f64).sum();
    let freedom = (weight - known.rank as f64).max(1.0);
    let cost = solver.cost_of_data();
    let sigma = match options.loss {
        Loss::Squares => (cost / freedom).sqrt(),
        // Of what is not gross.
        _ => robust_scale(&mut solver.residuals()?.0),
    };
    let covariance = solver.covariance(sigma);
    let mut x = vec![0.0; model.unknowns.len()];
    known.kept.iter().zip(solver.x.iter()).for_each(|(k, value)| x[*k] = *value);
    let (priors, weights, steps) = (options.priors.clone(), solver.weights, solver.steps);
    Ok(Fit { known, x, covariance, priors, sigma, cost, numbers, weights, steps })
}

/// A fit under way.
struct Solver<'a> {
    model: &'a Model<'a>,
    data: &'a [Observation],
    priors: Vec<Option<f64>>,
    bounds: Vec<Option<[f64; 2]>>,
    x: DVector<f64>,
    weights: Vec<f64>,
    /// The triangle of the data alone.
    data_alone: DMatrix<f64>,
    problem: Problem,
    cost: f64,
    steps: usize,
}

impl<'a> Solver<'a> {
    fn new(
        model: &'a Model<'a>,
        data: &'a [Observation],
        options: &Options,
        kept: &[usize],
        start: Vec<f64>,
    ) -> Self {
        let p = model.unknowns.len();
        Self {
            model,
            data,
            priors: kept.iter().map(|k| options.priors.get(*k).copied().flatten()).collect(),
            bounds: kept.iter().map(|k| options.bounds.get(*k).copied().flatten()).collect(),
            x: DVector::from_vec(start),
            weights: vec![1.0; data.len()],
            data_alone: DMatrix::zeros(0, p + 1),
            problem: Problem { a: DMatrix::zeros(0, p), b: DVector::zeros(0) },
            cost: f64::INFINITY,
            steps: 0,
        }
    }

    /// The triangle of the data alone, then the whole problem and its cost.
    fn linearize(&self, x: &DVector<f64>) -> Result<(DMatrix<f64>, Problem, f64), Failure> {
        let triangle = linearize(self.model, self.data, x.as_slice(), Some(&self.weights))?;
        let data_alone = triangle.clone().finish();
        let problem = with_priors(triangle, &self.priors, x.as_slice());
        let cost = problem.b.norm_squared();
        Ok((data_alone, problem, cost))
    }

    fn cost_of_data(&self) -> f64 {
        let priors = self.priors.iter().zip(self.x.iter());
        let of_priors: f64 = priors.filter_map(|(prior, x)| Some((x / (*prior)?).powi(2))).sum();
        (self.cost - of_priors).max(0.0)
    }

    /// Steps until they are nothing beside what the data can tell; whether that was reached.
    fn steps_at_most(&mut self, most: usize) -> Result<bool, Failure> {
        (self.data_alone, self.problem, self.cost) = self.linearize(&self.x)?;
        let mut damping = 1e-9;
        for _ in 0..most {
            let Some(step) = self.problem.solve(damping) else {
                damping = f64::max(damping * 10.0, 1e-12);
                continue;
            };
            let trial = self.within(&self.x + step);
            let step = &trial - &self.x;
            let share = step.component_mul(&self.scale()).norm();
            // Far below what a single measurement changes.
            let small = share < 1e-7 * (1.0 + self.cost.sqrt());
            let (data_alone, problem, cost) = self.linearize(&trial)?;
            self.steps += 1;
            if cost <= self.cost * (1.0 + 1e-12) {
                let gained = self.cost - cost;
                (self.x, self.data_alone, self.problem, self.cost) = (trial, data_alone, problem, cost);
                damping = f64::max(damping * 0.1, 1e-15);
                // A millionth of what a single number of the data explains by chance.
                if small || gained <= 1e-6 * self.cost / self.data.len().max(1) as f64 {
                    return Ok(true);
                }
            } else if small {
                return Ok(true);
            } else {
                damping = f64::max(damping * 10.0, 1e-6);
            }
        }
        Ok(false)
    }

    fn within(&self, mut x: DVector<f64>) -> DVector<f64> {
        for (value, bounds) in x.iter_mut().zip(&self.bounds) {
            if let Some([lower, upper]) = bounds {
                *value = value.clamp(*lower, *upper);
            }
        }
        x
    }

    fn scale(&self) -> DVector<f64> {
        DVector::from_vec(self.problem.lengths())
    }

    /// All residuals, and the norm of those of each row.
    fn residuals(&self) -> Result<(Vec<f64>, Vec<f64>), Failure> {
        let mut room = self.model.room();
        let (mut all, mut norms) = (Vec::new(), Vec::new());
        for (i, seen) in self.data.iter().enumerate() {
            let mut square = 0.0;
            let take = |residual: f64, _: &mut dyn FnMut(usize) -> f64| {
                all.push(residual);
                square += residual * residual;
            };
            self.model
                .rows(&mut room, seen, self.x.as_slice(), take)
                .map_err(|error| Failure::Row(i, error))?;
            norms.push(square.sqrt());
        }
        Ok((all, norms))
    }

    fn reweight(&mut self, loss: Loss) -> Result<(), Failure> {
        let (mut all, norms) = self.residuals()?;
        let scale = robust_scale(&mut all).max(1e-300);
        for ((weight, norm), seen) in self.weights.iter_mut().zip(norms).zip(self.data) {
            *weight = loss.weight(norm / scale, seen.count());
        }
        Ok(())
    }

    /// `(JᵀJ/σ² + P)⁻¹` with the information `P` of the priors.
    fn covariance(&self, sigma: f64) -> DMatrix<f64> {
        let p = self.x.len();
        let mut triangle = Triangle::new(p);
        for row in self.data_alone.row_iter() {
            triangle.push(row.iter().copied(), 1.0 / sigma.max(1e-300));
        }
        let problem = with_priors(triangle, &self.priors, self.x.as_slice());
        let inverse = problem.a.rows(0, p).solve_upper_triangular(&DMatrix::identity(p, p));
        let square = |inverse: DMatrix<f64>| &inverse * inverse.transpose();
        inverse.map_or_else(|| DMatrix::from_element(p, p, f64::INFINITY), square)
    }
}

/// A row more for every prior: `x/σ`.
pub(super) fn with_priors(mut triangle: Triangle, priors: &[Option<f64>], x: &[f64]) -> Problem {
    let p = x.len();
    for (k, prior) in priors.iter().enumerate() {
        if let Some(sigma) = prior {
            triangle.push((0..p).map(|j| f64::from(u8::from(j == k)) / sigma).chain([-x[k] / sigma]), 1.0);
        }
    }
    Problem::of(&triangle.finish(), &(0..p).collect::<Vec<_>>())
}
