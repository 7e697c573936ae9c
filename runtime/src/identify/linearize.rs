//! The linear problem at a place: residuals and derivatives of all observations, and what is known before.

use super::residuals::Room;
use super::triangle::{Problem, Triangle};
use super::{Failure, Model, Observation};

/// Residuals and derivatives of all observations at `x`, as a triangle; `weights` by observation, 1 if there are none.
pub(super) fn linearize(
    model: &Model,
    data: &[Observation],
    x: &[f64],
    weights: Option<&[f64]>,
) -> Result<Triangle, Failure> {
    let mut triangle = Triangle::new(model.unknowns.len());
    let mut room = model.room();
    for (i, observation) in data.iter().enumerate() {
        let weight = weights.map_or(1.0, |weights| weights[i]);
        if weight > 0.0 {
            push(model, &mut room, observation, x, weight, &mut triangle)?;
        }
    }
    Ok(triangle)
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
    model.residuals(room, observation, x, |residual, derivative| {
        triangle.push((0..x.len()).map(derivative).chain([-residual]), weight);
    })
}

/// A row more for every prior: `x/σ`.
pub(super) fn with_priors(mut triangle: Triangle, priors: &[Option<f64>], x: &[f64]) -> Problem {
    let p = x.len();
    for (k, prior) in priors.iter().enumerate() {
        if let Some(sigma) = prior {
            triangle.push((0..p).map(|j| f64::from(u8::from(j == k)) / sigma).chain([-x[k] / sigma]), 1.0);
        }
    }
    Problem::from_triangle(&triangle.finish(), &(0..p).collect::<Vec<_>>())
}
