//! Detection of outliers: a robust loss proposes, an F-test of the least-squares fit decides.
//!
//! The remaining rows are fitted by plain least squares, so degrees of freedom and covariances are
//! those of least squares. A rejected row returns if its distance from the fit of the others is not
//! significant: `T² = rᵀ (I + J B Jᵀ)⁻¹ r / (d σ²)` is F distributed with `d` and the degrees of
//! freedom of σ.

use nalgebra::{DMatrix, DVector};

use super::{
    Configurations, Failure, Folds, Loss, Observation, Options, REJECTED, Residuals, Result, Solver,
    by_blocks, f_beyond,
};
use super::{clustered::Known, robust::robust_scale_after};

/// Probability that any good row is rejected.
const CHANCE: f64 = 0.01;

/// Size of the subset that provides the start, with more than twice as many rows.
const PART: usize = 4000;

/// Iterations with Huber's weights, then with the requested ones.
const ROUNDS: [usize; 2] = [20, 40];

/// Largest number of times that the damping increases in an iteration.
const TRIES: usize = 8;

impl Solver<'_> {
    /// Rejects outliers if the loss does, and iterates to convergence. Returns the covariance if it
    /// was computed on the way.
    pub(super) fn solve(&mut self, options: &Options) -> Result<Option<Known>> {
        let known = match options.loss {
            Loss::Squares => None,
            loss => self.reject_outliers(loss, options.steps)?,
        };
        match self.steps_at_most(options.steps)? {
            true => Ok(known),
            false => Err(Failure::NotConverged { steps: self.steps }),
        }
    }

    /// Sets the weights to 0 for outliers and 1 for all others.
    ///
    /// `steps` limits each fit. Returns the covariance if it was computed on the way.
    fn reject_outliers(&mut self, loss: Loss, steps: usize) -> Result<Option<Known>> {
        let places = self.places_by_number();
        if self.data.len() > 2 * PART {
            let folds = Folds::new(self.data, self.data.len() / PART);
            let part = self.data.iter().zip(&folds.fold).filter(|(_, fold)| **fold == 0);
            let part: Vec<Observation> = part.map(|(row, _)| row.clone()).collect();
            let mut few = self.with_data(&part);
            few.rounds(loss, places)?;
            self.x = few.x;
        }
        let (scale, norms) = self.rounds(loss, places)?;
        self.reweight(Loss::Tukey, &norms, scale);
        self.weights.iter_mut().for_each(|weight| *weight = f64::from(u8::from(*weight >= REJECTED)));
        let counts = self.data.iter().map(Observation::count);
        let left: usize =
            counts.zip(&self.weights).filter(|(_, weight)| **weight > 0.0).map(|(n, _)| n).sum();
        if left <= self.x.len() {
            self.weights.fill(1.0);
        }
        for _ in 0..10 {
            if self.weights.iter().all(|weight| *weight > 0.0) {
                break;
            }
            self.steps_at_most(steps)?;
            let known = self.known()?;
            let back = self.could_be_chance(&known)?;
            if back.is_empty() {
                return Ok(Some(known));
            }
            back.into_iter().for_each(|i| self.weights[i] = 1.0);
            self.linearized = false;
        }
        Ok(None)
    }

    /// Returns the number of measured numbers per independent one: visits of a configuration count
    /// once.
    fn places_by_number(&self) -> f64 {
        let numbers: usize = self.data.iter().map(Observation::count).sum();
        let (independent, _) = Configurations::independent(self.data);
        numbers as f64 / independent.max(1) as f64
    }

    /// Runs iteratively reweighted least squares; returns the robust scale and the residual norms
    /// of all rows.
    ///
    /// Huber's loss converges from any start and determines the scale; the requested loss then uses
    /// that scale. An iteration is one step and evaluates only the residuals at its end; `Σ ρ` must
    /// decrease.
    fn rounds(&mut self, loss: Loss, visits: f64) -> Result<(f64, Vec<f64>)> {
        let spent = (self.x.len() as f64 * visits) as usize;
        let scale_of = |mut all: Vec<f64>| robust_scale_after(&mut all, spent).max(1e-300);
        let Residuals { all, mut norms } = self.residuals(&self.x)?;
        let mut scale = scale_of(all);
        for (loss, most) in [Loss::Huber, loss].into_iter().zip(ROUNDS) {
            let mut damping = 1e-9;
            for _ in 0..most {
                self.reweight(loss, &norms, scale);
                self.linearize_here()?;
                let before = self.robust_cost(loss, &norms, scale, &self.x);
                let mut moved = 0.0;
                for _ in 0..TRIES {
                    let Some(trial) = self.trial(damping) else {
                        damping *= 10.0;
                        continue;
                    };
                    let found = Failure::unless_open(self.residuals(&trial))?;
                    let is_better = |found: &Residuals| {
                        self.robust_cost(loss, &found.norms, scale, &trial) <= before * (1.0 + 1e-12)
                    };
                    if let Some(found) = found.filter(is_better) {
                        moved = (&trial - &self.x).component_mul(&self.scale()).amax();
                        damping = f64::max(damping * 0.1, 1e-15);
                        (self.x, norms, self.linearized) = (trial, found.norms, false);
                        if loss == Loss::Huber {
                            scale = scale_of(found.all);
                        }
                        break;
                    }
                    damping = f64::max(damping * 10.0, 1e-6);
                }
                if moved < 1e-3 * self.cost.sqrt() {
                    break;
                }
            }
        }
        Ok((scale, norms))
    }

    /// Computes `s² Σ ρ(|r|/s)` plus the cost of the priors.
    fn robust_cost(&self, loss: Loss, norms: &[f64], scale: f64, x: &DVector<f64>) -> f64 {
        let rows = norms.iter().zip(self.data);
        let costs = rows.map(|(norm, row)| loss.cost(norm / scale, row.count()));
        scale * scale * costs.sum::<f64>() + self.cost_of_priors(x)
    }

    /// Returns the rejected rows whose distance is not significant.
    fn could_be_chance(&self, known: &Known) -> Result<Vec<usize>> {
        let Some(l) = self.problem.half() else { return Ok(Vec::new()) };
        let left_out: Vec<usize> = (0..self.data.len()).filter(|i| self.weights[*i] == 0.0).collect();
        let block = |_: usize, rows: &[usize]| {
            let mut at = self.at();
            let mut back = Vec::new();
            for i in rows.iter().copied() {
                let (mut r, mut u) = (Vec::new(), Vec::new());
                at.linear(&self.data[i], |residual, row| {
                    r.push(residual);
                    u.push(l.tr_mul(&DVector::from_column_slice(row)));
                })?;
                let d = r.len();
                let spread = DMatrix::from_fn(d, d, |a, b| f64::from(u8::from(a == b)) + u[a].dot(&u[b]));
                let r = DVector::from_vec(r);
                let squares = spread.cholesky().map_or(f64::INFINITY, |spread| r.dot(&spread.solve(&r)));
                let f = squares / (d as f64 * known.sigma.powi(2)).max(1e-300);
                if f_beyond(f, d as f64, known.freedom) * self.data.len() as f64 > CHANCE {
                    back.push(i);
                }
            }
            Ok(back)
        };
        let mut back = Vec::new();
        by_blocks(&left_out, block, |part| back.extend(part))?;
        Ok(back)
    }
}
