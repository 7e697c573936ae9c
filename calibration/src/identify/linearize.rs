//! Linearization of the residuals of all observations, with priors: rows in blocks of a fixed size,
//! one per thread.

use nalgebra::{DMatrix, DVector};

use super::{EvaluatedModel, Model, Observation, Problem, Result, Triangle};
use abbe_analysis::in_order;

/// Accumulates residuals and derivatives of all observations and known distances at `x`, with
/// optional weights for each observation.
pub(super) fn linearize(
    model: &Model,
    data: &[Observation],
    x: &[f64],
    weights: Option<&[f64]>,
) -> Result<Triangle> {
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
    pub(super) fn push(&mut self, row: &Observation, weight: f64, to: &mut Triangle) -> Result<()> {
        let weight = weight.sqrt();
        self.linear(row, |residual, derivatives| to.push(derivatives, -residual, weight))
    }
}

/// Appends the rows of the known distances.
pub(super) fn push_distances(model: &Model, x: &[f64], triangle: &mut Triangle) {
    model.distance_rows(x, |residual, row| triangle.push(row, -residual, 1.0));
}

/// Appends the rows `W x` of the prior.
pub(super) fn with_priors(mut triangle: Triangle, prior: &DMatrix<f64>, x: &[f64]) -> Problem {
    for (row, value) in prior.transpose().column_iter().zip((prior * DVector::from_column_slice(x)).iter()) {
        triangle.push(row.as_slice(), -value, 1.0);
    }
    Problem::from_triangle(triangle.finish())
}

/// Number of rows in a block: fixed, so that results do not depend on the number of threads.
const ROWS: usize = 512;

/// Computes `make(first, rows)` for each block in parallel, with the index of its first row, and
/// takes the results in order.
pub(super) fn by_blocks<R: Sync, T: Send>(
    rows: &[R],
    make: impl Fn(usize, &[R]) -> Result<T> + Sync,
    take: impl FnMut(T),
) -> Result<()> {
    let block = |block| {
        let first = block * ROWS;
        make(first, &rows[first..rows.len().min(first + ROWS)])
    };
    in_order(rows.len().div_ceil(ROWS), block, take)
}
