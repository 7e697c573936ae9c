//! K-fold cross-validation: position errors of data that were not used in the fit.

use std::collections::HashMap;

use nalgebra::{DMatrix, DVector};

use super::{
    Configurations, Distances, Fit, Model, Observation, Problem, REJECTED, Result, Triangle, push_distances,
    with_priors,
};
use abbe_analysis::in_order;
use abbe_analysis::sampling::{halton, range_of};

/// Assignment of observations to folds.
#[derive(Clone, Debug, PartialEq)]
pub struct Folds {
    /// Number of folds.
    pub count: usize,
    /// Fold of each observation.
    pub fold: Vec<u32>,
}

impl Folds {
    /// Distributes configurations evenly over `count` folds, in a fixed pseudorandom order.
    ///
    /// Neighbouring configurations are separated; all visits of a configuration share a fold. The
    /// result is reproducible.
    pub fn new(data: &[Observation], count: usize) -> Self {
        let Configurations { count: configurations, number } = Configurations::new(data);
        let count = count.clamp(2, configurations.max(2));
        let mut order: Vec<u32> = (0..configurations as u32).collect();
        let key = |i: u32| (halton(i as usize + 1, 1) * 1e3).fract();
        order.sort_unstable_by(|a, b| key(*a).total_cmp(&key(*b)).then(a.cmp(b)));
        let mut fold = vec![0; configurations];
        order.iter().enumerate().for_each(|(place, i)| fold[*i as usize] = (place % count) as u32);
        let mut number = number;
        number.iter_mut().for_each(|number| *number = fold[*number as usize]);
        Self { count, fold: number }
    }

    /// Divides the configurations into `count` regions of joint space with about equally many each:
    /// the part with the most configurations is halved at the median of the joint that varies most,
    /// in shares of its variation over all rows, until there are enough.
    pub fn by_region(data: &[Observation], count: usize) -> Self {
        let Configurations { count: configurations, number } = Configurations::new(data);
        let mut places: Vec<&[f64]> = vec![&[]; configurations];
        number.iter().zip(data).for_each(|(number, row)| places[*number as usize] = &row.q);
        let whole: Vec<usize> = (0..configurations).collect();
        let joints = places.first().map_or(0, |place| place.len());
        let spread = |part: &[usize], joint: usize| {
            let [least, most] = range_of(part.iter().map(|i| places[*i][joint]));
            most - least
        };
        let all: Vec<f64> = (0..joints).map(|joint| spread(&whole, joint).max(f64::MIN_POSITIVE)).collect();
        let mut parts = vec![whole];
        while parts.len() < count {
            let largest = (0..parts.len()).max_by_key(|i| (parts[*i].len(), usize::MAX - i)).unwrap_or(0);
            let mut part = parts.swap_remove(largest);
            if part.len() < 2 {
                parts.push(part);
                break;
            }
            let share = |joint: &usize| spread(&part, *joint) / all[*joint];
            let joint = (0..joints).max_by(|a, b| share(a).total_cmp(&share(b)).then(b.cmp(a)));
            let key = |i: usize| joint.map_or(0.0, |joint| places[i][joint]);
            part.sort_by(|a, b| key(*a).total_cmp(&key(*b)).then(a.cmp(b)));
            let rest = part.split_off(part.len() / 2);
            parts.extend([part, rest]);
        }
        let mut fold = vec![0; configurations];
        for (i, part) in parts.iter().enumerate() {
            part.iter().for_each(|configuration| fold[*configuration] = i as u32);
        }
        Self { count: parts.len(), fold: number.into_iter().map(|number| fold[number as usize]).collect() }
    }

    /// Returns distances of rows of these folds with the folds as the independent samples, in place
    /// of configurations.
    pub fn distances_by_fold(&self, data: &[Observation], distances: Distances) -> Distances {
        let rows = data.iter().zip(&self.fold).map(|(row, fold)| (row.configuration, *fold));
        let fold: HashMap<u32, u32> = rows.collect();
        distances.renumbered(|one| fold.get(&one).copied().unwrap_or(one))
    }

    /// Divides the configurations into `count` runs, in the order in which they first occur.
    pub fn by_order(data: &[Observation], count: usize) -> Self {
        let Configurations { count: configurations, number } = Configurations::new(data);
        let count = count.clamp(1, configurations.max(1));
        let fold = |number: u32| (number as usize * count / configurations.max(1)) as u32;
        Self { count, fold: number.into_iter().map(fold).collect() }
    }
}

/// Computes the triangle of each fold at `x`.
fn triangles(
    model: &Model,
    data: &[Observation],
    x: &[f64],
    weights: &[f64],
    folds: &Folds,
) -> Result<Vec<Triangle>> {
    let one = |fold: usize| {
        let mut triangle = Triangle::new(model.unknowns.len());
        let mut at = model.at(x);
        for (i, observation) in
            data.iter().enumerate().filter(|(i, _)| folds.fold[*i] as usize == fold && weights[*i] > 0.0)
        {
            at.push(observation, weights[i], &mut triangle)?;
        }
        Ok(triangle)
    };
    let mut triangles = Vec::new();
    in_order(folds.count, one, |triangle| triangles.push(triangle))?;
    Ok(triangles)
}

/// Returns the position errors of each fold under the fit of all others, on the exact model,
/// without rejected rows.
///
/// Each fit is one Gauss-Newton step from the converged fit of all data; its error is of second
/// order in a small difference.
pub fn cross_validate(model: &Model, data: &[Observation], fit: &Fit, folds: &Folds) -> Result<Distances> {
    let (kept, x) = fit.of_kept(model);
    let parts = triangles(&kept, data, &x, &fit.weights, folds)?;
    let solve = |left_out: usize| {
        let step = others(&kept, &parts, left_out, &fit.prior, &x)
            .solve(0.0)
            .unwrap_or_else(|| DVector::zeros(x.len()));
        x.iter().zip(step.iter()).map(|(x, step)| x + step).collect::<Vec<f64>>()
    };
    let solutions: Vec<Vec<f64>> = (0..folds.count).map(solve).collect();
    kept.distances_where(data, |i| {
        (fit.weights[i] >= REJECTED).then(|| &solutions[folds.fold[i] as usize][..])
    })
}

/// Returns the triangle of all folds but one, with the known distances, which belong to none.
fn others(model: &Model, parts: &[Triangle], left_out: usize, prior: &DMatrix<f64>, x: &[f64]) -> Problem {
    let rest = parts.iter().enumerate().filter(|(fold, _)| *fold != left_out);
    let mut all = Triangle::new(x.len());
    rest.for_each(|(_, part)| all.merge(part.clone()));
    push_distances(model, x, &mut all);
    with_priors(all, prior, x)
}
