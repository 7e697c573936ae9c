//! Linearization of the residuals of all observations, with priors.

use super::blocks::by_blocks;
use super::evaluated_model::EvaluatedModel;
use super::triangle::{Problem, Triangle};
use super::{Failure, Model, Observation};

/// Accumulates residuals and derivatives of all observations and known distances at `x`, with
/// optional weights for each observation.
pub(super) fn linearize(
    model: &Model,
    data: &[Observation],
    x: &[f64],
    weights: Option<&[f64]>,
) -> Result<Triangle, Failure> {
    let block = |first: usize, rows: &[Observation]| {
        let mut triangle = Triangle::new(model.unknowns.len());
        let mut at = model.at(x);
        for (i, observation) in rows.iter().enumerate() {
            let weight = weights.map_or(1.0, |weights| weights[first + i]);
            if weight > 0.0 {
                at.push(observation, weight, &mut triangle)?;
            }
        }
        Ok(triangle)
    };
    let mut all = Triangle::new(model.unknowns.len());
    by_blocks(data, block, |part| all.merge(part))?;
    push_distances(model, x, &mut all);
    Ok(all)
}

impl EvaluatedModel<'_> {
    /// Appends the rows of one observation: a step solves `J dx = −r`.
    pub(super) fn push(&mut self, row: &Observation, weight: f64, to: &mut Triangle) -> Result<(), Failure> {
        let weight = weight.sqrt();
        self.linear(row, |residual, derivatives| to.push(derivatives, -residual, weight))
    }
}

/// Appends the rows of the known distances.
pub(super) fn push_distances(model: &Model, x: &[f64], triangle: &mut Triangle) {
    model.distance_rows(x, |residual, row| triangle.push(row, -residual, 1.0));
}

/// Appends a row `x/σ` for each prior.
pub(super) fn with_priors(mut triangle: Triangle, priors: &[Option<f64>], x: &[f64]) -> Problem {
    let p = x.len();
    for (k, prior) in priors.iter().enumerate() {
        if let Some(sigma) = prior {
            let row: Vec<f64> = (0..p).map(|j| f64::from(u8::from(j == k))).collect();
            triangle.push(&row, -x[k], 1.0 / sigma);
        }
    }
    Problem::from_triangle(&triangle.finish(), &(0..p).collect::<Vec<_>>())
}
