//! Geodesic acceleration of Levenberg-Marquardt steps.
//!
//! Weakly determined unknowns make a long, curved valley of the cost, in which a step along the
//! tangent climbs the side, so that damping shortens the steps. Transtrum and Sethna, *Improvements
//! to the Levenberg-Marquardt algorithm for nonlinear least-squares minimization*, 2012, add the
//! second derivative of the residuals along the step δ:
//!
//! ```text
//! r″ = 2 ((r(x + hδ) − r(x))/h − J δ)/h,      (JᵀJ + λ D²) a = −Jᵀ r″,      x + δ + ½ a
//! ```

use nalgebra::DVector;

use super::blocks::by_blocks;
use super::solver::Solver;
use super::{Failure, Observation};

/// Relative length `h` of the difference step.
const AHEAD: f64 = 0.1;

/// Largest length of `a` relative to the step.
const BEND: f64 = 0.75;

impl Solver<'_> {
    /// Returns `δ + ½ a`, or δ if `a` is too long.
    pub(super) fn accelerated(&self, step: &DVector<f64>, damping: f64) -> Result<DVector<f64>, Failure> {
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
