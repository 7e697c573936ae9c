//! Levenberg and Marquardt, on a triangle instead of a tall matrix.

use nalgebra::{DMatrix, DVector};

use super::linearize::{linearize, with_priors};
use super::robust::robust_scale_after;
use super::triangle::Problem;
use super::{Configurations, Failure, Loss, Model, Observation, Options};

/// A fit under way.
pub(super) struct Solver<'a> {
    pub(super) model: &'a Model<'a>,
    pub(super) data: &'a [Observation],
    pub(super) priors: Vec<Option<f64>>,
    bounds: Vec<Option<[f64; 2]>>,
    pub(super) x: DVector<f64>,
    pub(super) weights: Vec<f64>,
    /// The triangle of the data alone.
    pub(super) data_alone: DMatrix<f64>,
    pub(super) problem: Problem,
    pub(super) cost: f64,
    pub(super) steps: usize,
}

impl<'a> Solver<'a> {
    pub(super) fn new(
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

    pub(super) fn cost_of_data(&self) -> f64 {
        let priors = self.priors.iter().zip(self.x.iter());
        let of_priors: f64 = priors.filter_map(|(prior, x)| Some((x / (*prior)?).powi(2))).sum();
        (self.cost - of_priors).max(0.0)
    }

    /// Steps until they are nothing beside what the data can tell; whether that was reached.
    pub(super) fn steps_at_most(&mut self, most: usize) -> Result<bool, Failure> {
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

    pub(super) fn scale(&self) -> DVector<f64> {
        DVector::from_vec(self.problem.lengths())
    }

    /// All residuals, and the norm of those of each observation.
    pub(super) fn residuals(&self) -> Result<(Vec<f64>, Vec<f64>), Failure> {
        let mut room = self.model.room();
        let (mut all, mut norms) = (Vec::new(), Vec::new());
        for observation in self.data {
            let mut square = 0.0;
            self.model.residuals(&mut room, observation, self.x.as_slice(), |residual, _| {
                all.push(residual);
                square += residual * residual;
            })?;
            norms.push(square.sqrt());
        }
        Ok((all, norms))
    }

    /// The scale of what is left of numbers that are not gross errors; visits of a configuration count once.
    pub(super) fn robust_scale(&self) -> Result<f64, Failure> {
        let mut all = self.residuals()?.0;
        let configurations = Configurations::new(self.data);
        let visits = all.len() as f64 / configurations.numbers(self.data.iter(), usize::MAX).max(1) as f64;
        let spent = (self.x.len() as f64 * visits) as usize;
        Ok(robust_scale_after(&mut all, spent).max(1e-300))
    }

    pub(super) fn reweight(&mut self, loss: Loss, scale: f64) -> Result<(), Failure> {
        let norms = self.residuals()?.1;
        for ((weight, norm), observation) in self.weights.iter_mut().zip(norms).zip(self.data) {
            *weight = loss.weight(norm / scale, observation.count());
        }
        Ok(())
    }
}
