//! Which rows are gross errors: a robust loss suspects, a test of least squares decides.
//!
//! What is not gross is fitted by plain least squares, so that degrees of freedom and covariances are those of least
//! squares, with few rows as with many. A row that was left out comes back if its distance from the fit of the others could
//! be chance: `T² = rᵀ (I + J B Jᵀ)⁻¹ r / (d σ²)` is an F of `d` and the degrees of freedom of σ.

use nalgebra::{DMatrix, DVector};

use super::fit::REJECTED;
use super::solver::Solver;
use super::statistics::f_beyond;
use super::{Failure, Loss};

/// How likely it may be that any good row is left out by chance.
const CHANCE: f64 = 0.01;

impl Solver<'_> {
    /// Sets the weights: 0 for gross errors, 1 for all others. `steps` are the most of each fit.
    pub(super) fn leave_out_gross_errors(&mut self, loss: Loss, steps: usize) -> Result<(), Failure> {
        // Huber first: it comes near from anywhere, and finds the scale; then the loss that was asked for, with that scale.
        // Gross errors never have their say.
        let mut scale = self.robust_scale()?;
        for round in 0..60 {
            let before = self.x.clone();
            if round < 12 {
                scale = self.robust_scale()?;
            }
            self.reweight(if round < 12 { Loss::Huber } else { loss }, scale)?;
            self.steps_at_most(3)?;
            let moved = (&self.x - &before).component_mul(&self.scale()).amax();
            if round >= 15 && moved < 1e-3 * self.cost.sqrt() {
                break;
            }
        }
        self.reweight(Loss::Tukey, scale)?;
        self.weights.iter_mut().for_each(|weight| *weight = f64::from(u8::from(*weight >= REJECTED)));
        let counts = self.data.iter().map(super::Observation::count);
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
            let back = self.could_be_chance()?;
            if back.is_empty() {
                break;
            }
            back.into_iter().for_each(|i| self.weights[i] = 1.0);
        }
        Ok(())
    }

    /// Rows that were left out, and whose distance could be chance.
    fn could_be_chance(&self) -> Result<Vec<usize>, Failure> {
        let p = self.x.len();
        let known = self.known()?;
        let bread = self.problem.a.rows(0, p.min(self.problem.a.nrows()));
        let Some(l) = bread.solve_upper_triangular(&DMatrix::identity(bread.nrows(), p)) else {
            return Ok(Vec::new());
        };
        let mut room = self.model.room();
        let mut back = Vec::new();
        for (i, row) in self.data.iter().enumerate().filter(|(i, _)| self.weights[*i] == 0.0) {
            let (mut r, mut u) = (Vec::new(), Vec::new());
            self.model.residuals(&mut room, row, self.x.as_slice(), |residual, derivative| {
                r.push(residual);
                u.push(l.tr_mul(&DVector::from_fn(p, |k, _| derivative(k))));
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
    }
}
