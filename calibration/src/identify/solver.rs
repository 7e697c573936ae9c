//! Levenberg-Marquardt iterations on a triangular factor instead of the tall Jacobian.
//!
//! Steps that did not gain are accelerated along geodesics. Weakly determined unknowns make a long,
//! curved valley of the cost, in which a step along the tangent climbs the side, so that damping
//! shortens the steps. Transtrum and Sethna, *Improvements to the Levenberg-Marquardt algorithm for
//! nonlinear least-squares minimization*, 2012, add the second derivative of the residuals along
//! the step δ:
//!
//! ```text
//! r″ = 2 ((r(x + hδ) − r(x))/h − J δ)/h,      (JᵀJ + λ D²) a = −Jᵀ r″,      x + δ + ½ a
//! ```

use nalgebra::{DMatrix, DVector};

use super::{
    EvaluatedModel, Failure, Loss, Model, Observation, Problem, Result, by_blocks, linearize, with_priors,
};

/// State of a fit.
#[derive(Clone)]
pub(super) struct Solver<'a> {
    pub(super) model: &'a Model<'a>,
    pub(super) data: &'a [Observation],
    /// Rows of the prior.
    pub(super) prior: DMatrix<f64>,
    pub(super) x: DVector<f64>,
    pub(super) weights: Vec<f64>,
    /// Triangle of the data without priors.
    pub(super) data_alone: DMatrix<f64>,
    pub(super) problem: Problem,
    pub(super) cost: f64,
    /// The linearization belongs to `x` and the weights.
    pub(super) linearized: bool,
    pub(super) steps: usize,
}

impl<'a> Solver<'a> {
    pub(super) fn new(
        model: &'a Model<'a>,
        data: &'a [Observation],
        start: Vec<f64>,
        prior: DMatrix<f64>,
    ) -> Self {
        let p = model.unknowns.len();
        Self {
            model,
            data,
            prior,
            x: DVector::from_vec(start),
            weights: vec![1.0; data.len()],
            data_alone: DMatrix::zeros(0, p + 1),
            problem: Problem { a: DMatrix::zeros(0, p), b: DVector::zeros(0) },
            cost: f64::INFINITY,
            linearized: false,
            steps: 0,
        }
    }

    /// Starts a fit of other data at the current `x`.
    pub(super) fn with_data<'b>(&self, data: &'b [Observation]) -> Solver<'b>
    where
        'a: 'b,
    {
        Solver { data, weights: vec![1.0; data.len()], linearized: false, steps: 0, ..self.clone() }
    }

    /// Returns the triangle of the data, the problem with priors, and its cost.
    fn linearize(&self, x: &DVector<f64>) -> Result<(DMatrix<f64>, Problem, f64)> {
        let triangle = linearize(self.model, self.data, x.as_slice(), Some(&self.weights))?;
        let data_alone = triangle.clone().finish();
        let problem = with_priors(triangle, &self.prior, x.as_slice());
        let cost = problem.b.norm_squared();
        Ok((data_alone, problem, cost))
    }

    pub(super) fn cost_of_data(&self) -> f64 {
        (self.cost - self.cost_of_priors(&self.x)).max(0.0)
    }

    pub(super) fn cost_of_priors(&self, x: &DVector<f64>) -> f64 {
        (&self.prior * x).norm_squared()
    }

    /// Replaces the rows of the prior.
    pub(super) fn set_prior(&mut self, prior: DMatrix<f64>) {
        (self.prior, self.linearized) = (prior, false);
    }

    /// Estimates the standard deviation of a number, in units of its uncertainty, which is prior
    /// information.
    pub(super) fn noise(&self) -> f64 {
        let (stated, used) = (self.model.stated_freedom, self.data.iter().zip(&self.weights));
        let count = self.model.count(used.filter(|(_, weight)| **weight > 0.0).map(|(row, _)| row));
        let freedom = (count as f64 - self.effective()).max(0.0);
        let variance = (stated + self.cost_of_data()) / (stated + freedom);
        if variance > 0.0 && variance.is_finite() { variance.sqrt() } else { 1.0 }
    }

    /// Linearizes at `x` with the current weights.
    pub(super) fn linearize_here(&mut self) -> Result<()> {
        (self.data_alone, self.problem, self.cost) = self.linearize(&self.x)?;
        self.linearized = true;
        Ok(())
    }

    /// Iterates until steps are negligible against the uncertainty, at most `most` times; returns
    /// whether it converged.
    pub(super) fn steps_at_most(&mut self, most: usize) -> Result<bool> {
        if !self.linearized {
            self.linearize_here()?;
        }
        // After a failed step, derivatives alone no longer predict the cost.
        let (mut damping, mut curved, mut still) = (1e-9, false, 0);
        for _ in 0..most {
            // A millionth of the expected contribution of a single number to the cost.
            let nothing = 1e-6 * self.cost / self.data.len().max(1) as f64;
            if self.problem.promise() <= nothing {
                return Ok(true);
            }
            let Some(step) = self.problem.solve(damping) else {
                damping = f64::max(damping * 10.0, 1e-12);
                continue;
            };
            let bent = if curved { Failure::unless_open(self.accelerated(&step, damping))? } else { None };
            let trial = &self.x + bent.unwrap_or(step);
            let share = (&trial - &self.x).component_mul(&self.scale()).norm();
            // Far below the effect of a single measurement.
            let small = share < 1e-7 * (1.0 + self.cost.sqrt());
            let found = Failure::unless_open(self.linearize(&trial))?;
            self.steps += 1;
            let better = found.filter(|(.., cost)| *cost <= self.cost * (1.0 + 1e-12));
            if let Some((data_alone, problem, cost)) = better {
                let gained = self.cost - cost;
                (self.x, self.data_alone, self.problem, self.cost) = (trial, data_alone, problem, cost);
                damping = f64::max(damping * 0.1, 1e-15);
                // In a curved valley, a single step can fail to gain by chance.
                still = if small || gained <= nothing { still + 1 } else { 0 };
                if still > usize::from(curved) {
                    return Ok(true);
                }
            } else if small {
                return Ok(true);
            } else {
                damping = f64::max(damping * 10.0, 1e-6);
                curved = true;
            }
        }
        Ok(false)
    }

    /// Returns the end of a damped step; none if the problem is singular.
    pub(super) fn trial(&self, damping: f64) -> Option<DVector<f64>> {
        Some(&self.x + self.problem.solve(damping)?)
    }

    pub(super) fn scale(&self) -> DVector<f64> {
        DVector::from_vec(self.problem.lengths())
    }

    /// Returns the model at the present unknowns.
    pub(super) fn at(&self) -> EvaluatedModel<'_> {
        self.model.at(self.x.as_slice())
    }

    /// Computes all residuals at `x`, and their norm for each observation.
    pub(super) fn residuals(&self, x: &DVector<f64>) -> Result<Residuals> {
        let block = |_: usize, rows: &[Observation]| {
            let mut at = self.model.at(x.as_slice());
            let (mut all, mut norms) = (Vec::new(), Vec::with_capacity(rows.len()));
            for observation in rows {
                let mut square = 0.0;
                at.residuals(observation, |residual| {
                    all.push(residual);
                    square += residual * residual;
                })?;
                norms.push(square.sqrt());
            }
            Ok((all, norms))
        };
        let mut residuals = Residuals::default();
        by_blocks(self.data, block, |(all, norms)| {
            residuals.all.extend(all);
            residuals.norms.extend(norms);
        })?;
        Ok(residuals)
    }

    /// Sets the weight of each row by a loss.
    pub(super) fn reweight(&mut self, loss: Loss, norms: &[f64], scale: f64) {
        for ((weight, norm), observation) in self.weights.iter_mut().zip(norms).zip(self.data) {
            *weight = loss.weight(norm / scale, observation.count());
        }
        self.linearized = false;
    }

    /// Returns `δ + ½ a`, or δ if `a` is too long.
    fn accelerated(&self, step: &DVector<f64>, damping: f64) -> Result<DVector<f64>> {
        let there = &self.x + step * AHEAD;
        let block = |first: usize, rows: &[Observation]| {
            let (mut here, mut there) = (self.at(), self.model.at(there.as_slice()));
            let (mut sum, mut ahead) = (DVector::zeros(step.len()), Vec::new());
            for i in (first..first + rows.len()).filter(|i| self.weights[*i] > 0.0) {
                ahead.clear();
                there.residuals(&self.data[i], |r| ahead.push(r))?;
                let mut ahead = ahead.iter();
                here.linear(&self.data[i], |residual, row| {
                    let along: f64 = row.iter().zip(step.iter()).map(|(a, b)| a * b).sum();
                    let moved = ahead.next().map_or(along, |ahead| (ahead - residual) / AHEAD);
                    let bend = self.weights[i] * 2.0 * (moved - along) / AHEAD;
                    sum.iter_mut().zip(row).for_each(|(sum, value)| *sum += bend * value);
                })?;
            }
            Ok(sum)
        };
        let mut bend = DVector::zeros(step.len());
        by_blocks(self.data, block, |part| bend += part)?;
        let Some(half) = self.problem.solve_normal(&(bend * -0.5), damping) else { return Ok(step.clone()) };
        let scale = self.scale();
        let length = |step: &DVector<f64>| step.component_mul(&scale).norm();
        Ok(if 2.0 * length(&half) <= BEND * length(step) { step + half } else { step.clone() })
    }
}

/// Residuals of the data.
#[derive(Default)]
pub(super) struct Residuals {
    /// Residual of each number.
    pub(super) all: Vec<f64>,
    /// Norm of the residuals of each observation.
    pub(super) norms: Vec<f64>,
}

/// Relative length `h` of the difference step.
const AHEAD: f64 = 0.1;

/// Largest length of `a` relative to the step.
const BEND: f64 = 0.75;
