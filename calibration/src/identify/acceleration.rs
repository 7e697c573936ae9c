//! Steps that follow a bent valley: geodesic acceleration.
//!
//! What data hardly tell is a long valley of the cost; where it bends, a step along its tangent climbs its side, and damping
//! makes steps short. Transtrum and Sethna, *Improvements to the Levenberg-Marquardt algorithm for nonlinear least-squares
//! minimization*, 2012: with the second derivative of the residuals along the step δ,
//!
//! ```text
//! r″ = 2 ((r(x + hδ) − r(x))/h − J δ)/h,      (JᵀJ + λ D²) a = −Jᵀ r″,      x + δ + ½ a
//! ```

use nalgebra::DVector;

use super::linearize::by_blocks;
use super::solver::Solver;
use super::{Failure, Observation};

/// `h`.
const AHEAD: f64 = 0.1;

/// How long `a` may be, as a share of the step.
const BEND: f64 = 0.75;

impl Solver<'_> {
    /// `δ + ½ a`; δ alone if `a` is too long to be trusted.
    pub(super) fn accelerated(&self, step: DVector<f64>, damping: f64) -> Result<DVector<f64>, Failure> {
        let there = &self.x + &step * AHEAD;
        let block = |first: usize, rows: &[Observation]| {
            let mut room = self.model.room();
            let (mut sum, mut ahead) = (DVector::zeros(step.len()), Vec::new());
            for i in (first..first + rows.len()).filter(|i| self.weights[*i] > 0.0) {
                ahead.clear();
                self.model.residuals(&mut room, &self.data[i], there.as_slice(), |r| ahead.push(r))?;
                let mut ahead = ahead.iter();
                self.linear(&mut room, i, |residual, row| {
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
        let Some(half) = self.problem.solve_normal(&(bend * -0.5), damping) else { return Ok(step) };
        let scale = self.scale();
        let length = |step: &DVector<f64>| step.component_mul(&scale).norm();
        Ok(if 2.0 * length(&half) <= BEND * length(&step) { step + half } else { step })
    }
}
