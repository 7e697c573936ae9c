//! The linear problem at a place: residuals and derivatives of all observations, and what is known before.

use super::residuals::Room;
use super::triangle::{Problem, Triangle};
use super::{Failure, Model, Observation};
use abbe_analysis::in_order;

/// Observations that one thread takes at a time: always the same, so that results are, too, for any number of threads.
const ROWS: usize = 512;

/// What `make` makes of every block of rows, given with the number of its first row, in their order.
pub(super) fn by_blocks<R: Sync, T: Send>(
    rows: &[R],
    make: impl Fn(usize, &[R]) -> Result<T, Failure> + Sync,
    take: impl FnMut(T),
) -> Result<(), Failure> {
    let block = |block| {
        let first = block * ROWS;
        make(first, &rows[first..rows.len().min(first + ROWS)])
    };
    in_order(rows.len().div_ceil(ROWS), block, take)
}

/// Residuals and derivatives of all observations at `x`, as a triangle; `weights` by observation, 1 if there are none.
pub(super) fn linearize(
    model: &Model,
    data: &[Observation],
    x: &[f64],
    weights: Option<&[f64]>,
) -> Result<Triangle, Failure> {
    let block = |first: usize, rows: &[Observation]| {
        let mut triangle = Triangle::new(model.unknowns.len());
        let mut room = model.room();
        for (i, observation) in rows.iter().enumerate() {
            let weight = weights.map_or(1.0, |weights| weights[first + i]);
            if weight > 0.0 {
                push(model, &mut room, observation, x, weight, &mut triangle)?;
            }
        }
        Ok(triangle)
    };
    let mut all = Triangle::new(model.unknowns.len());
    by_blocks(data, block, |part| all.merge(part))?;
    Ok(all)
}

/// The same of one observation: a step solves `J dx = −r`.
pub(super) fn push(
    model: &Model,
    room: &mut Room,
    observation: &Observation,
    x: &[f64],
    weight: f64,
    triangle: &mut Triangle,
) -> Result<(), Failure> {
    let weight = weight.sqrt();
    model.linear(room, observation, x, |residual, row| triangle.push(row, -residual, weight))
}

/// A row more for every prior: `x/σ`.
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
