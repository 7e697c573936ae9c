//! Measured errors compared with the prediction by the sources of the spec.
//!
//! Test of the residuals against the stated uncertainty.

use abbe::Class;
use abbe::identify::{
    Chance, EvaluatedModel, Failure, Figures, Fit, Model, Observation, Options, Unknown, deviation_beyond,
    f_beyond, fit, simulate,
};
use nalgebra::{Matrix3, Vector3};
use serde::Serialize;

use super::errors::{Errors, at_single_target, pose};
use crate::data::Map;
use crate::identify::{Setup, unknown_sources};

/// Agreement of measurement and prediction. Lengths are in the length unit.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Explained {
    /// Mean norm of the errors minus the repeatable sources, over all measured points.
    pub left_mean: f64,
    /// Root mean square of these norms.
    pub left_rms: f64,
    /// 95th percentile of these norms.
    pub left_p95: f64,
    /// Maximum of these norms.
    pub left_max: f64,
    /// Share of the sum of squares explained by the repeatable sources; negative if they increase
    /// it.
    pub share: f64,
    /// Share of the rows within the 95 % prediction region of the spec: random sources drawn anew
    /// in each row, and the noise of the instrument.
    ///
    /// None for readings, or if the map states no uncertainty.
    pub inside: Option<f64>,
    /// 99 % interval of that share of the points for a machine as specified, with as many rows.
    pub likely: Option<[f64; 2]>,
    /// Number of repeatable sources.
    pub repeatable: usize,
    /// Number of random sources.
    pub random: usize,
}

/// Content of the prediction region.
const CONTENT: f64 = 0.95;
/// Number of simulated rows; the content is then within ±0.3 % (two standard deviations).
const SIMULATED: usize = 20_000;

pub(super) fn explained(setup: &Setup, rows: &[Observation]) -> Result<Explained, Failure> {
    let random = unknown_sources(setup);
    let region = PredictionRegion { setup, random: &random };
    let boundary = region.boundary(rows)?;
    let (mut before, mut left, mut inside) = (0.0, Vec::new(), 0);
    let (model, errors) = (region.model(), Errors::new(setup));
    let mut model = model.at(&vec![0.0; random.len()]);
    let (mut real, mut ideal) = (setup.real.at(&[]), setup.ideal.at(&[]));
    for row in rows {
        let (_, point) = errors.at(row)?.unwrap_or_default();
        inside += usize::from(region.distance(&mut model, row, point)? <= boundary);
        // At each target, where the measurement was made.
        left.extend(real.distances(row)?);
        before += ideal.distances(row)?.iter().map(|v| v * v).sum::<f64>();
    }
    let share = 1.0 - left.iter().map(|v| v * v).sum::<f64>() / before.max(f64::MIN_POSITIVE);
    let figures = Figures::from_norms(left);
    Ok(Explained {
        inside: Some(inside as f64 / rows.len().max(1) as f64),
        likely: Some(likely(rows.len())),
        ..Explained::new(setup, &figures, share, random.len())
    })
}

impl Explained {
    fn new(setup: &Setup, figures: &Figures, share: f64, random: usize) -> Self {
        Self {
            left_mean: figures.mean,
            left_rms: figures.rms,
            left_p95: figures.p95,
            left_max: figures.max,
            share,
            inside: None,
            likely: None,
            repeatable: setup.real.repeatable().len(),
            random,
        }
    }

    /// Compares readings; figures cover lengths alone, and `share` weights all readings by their
    /// uncertainty.
    pub(super) fn of_readings(setup: &Setup, rows: &[Observation], share: f64) -> Result<Self, Failure> {
        let figures = setup.real.figures(rows, &[])?;
        let random = setup.description.sources.iter().filter(|source| source.class != Class::Repeatable);
        Ok(Self::new(setup, &figures, share, random.count()))
    }
}

/// Prediction region of the residual of a row.
struct PredictionRegion<'a> {
    setup: &'a Setup<'a>,
    /// Random sources with the variance of their magnitudes.
    random: &'a [(usize, f64)],
}

impl<'a> PredictionRegion<'a> {
    /// Returns the model with the magnitudes of the random sources as unknowns.
    fn model(&self) -> Model<'a> {
        let magnitudes = self.random.iter().map(|(i, _)| Unknown::Magnitude(*i)).collect();
        at_single_target(&self.setup.real).with(magnitudes)
    }

    /// Returns the Mahalanobis distance `√(eᵀ C⁻¹ e)` of a residual, with
    /// `C = Σ variance · m mᵀ + σ²` and m the displacement by a source of magnitude 1.
    fn distance(&self, at: &mut EvaluatedModel, row: &Observation, point: [f64; 3]) -> Result<f64, Failure> {
        let (ideal, moves) = at.tool(row)?;
        let rest: [f64; 3] = std::array::from_fn(|k| point[k] - ideal.position()[k]);
        let noise = self.setup.real.uncertainty.length.powi(2) / row.weight;
        let mut covariance = [[noise, 0.0, 0.0], [0.0, noise, 0.0], [0.0, 0.0, noise]];
        for (moved, (_, variance)) in moves.iter().zip(self.random) {
            for (i, row) in covariance.iter_mut().enumerate() {
                (0..3).for_each(|j| row[j] += moved[i] * moved[j] * variance);
            }
        }
        Ok(mahalanobis(covariance, rest))
    }

    /// Returns the 95th percentile of the distance for a machine as specified, from simulation of
    /// the same rows on the exact chain.
    fn boundary(&self, rows: &[Observation]) -> Result<f64, Failure> {
        let step = rows.len().div_ceil(SIMULATED).max(1);
        let list: Vec<Observation> = rows.iter().step_by(step).cloned().collect();
        let (model, ideal) = (self.model(), at_single_target(&self.setup.ideal));
        let mut random = model.at(&vec![0.0; self.random.len()]);
        let mut nominal = ideal.at(&[]);
        let mut distances = Vec::new();
        for seed in 0..(SIMULATED / list.len().max(1)).max(1) as u64 {
            let noise = self.setup.real.uncertainty;
            let chance = Chance {
                noise,
                outliers: 0.0,
                outlier_size: 0.0,
                random_sources: true,
                one_machine: false,
                seed,
            };
            for row in simulate(&self.setup.real, &list, &chance)? {
                let pose_of_ideal = nominal.pose(&row)?;
                if let Some(real) = pose(&ideal, &row, &pose_of_ideal) {
                    distances.push(self.distance(&mut random, &row, real.position())?);
                }
            }
        }
        distances.sort_by(f64::total_cmp);
        let place = (CONTENT * distances.len() as f64) as usize;
        Ok(distances.get(place).copied().unwrap_or(f64::INFINITY))
    }
}

/// Computes `√(eᵀ C⁻¹ e)`.
fn mahalanobis(covariance: [[f64; 3]; 3], error: [f64; 3]) -> f64 {
    let error = Vector3::from(error);
    let scaled = Matrix3::from(covariance).lu().solve(&error);
    scaled.map_or(f64::INFINITY, |scaled| error.dot(&scaled).max(0.0).sqrt())
}

/// Returns the 0.5 and 99.5 % quantiles of the share, from the binomial distribution.
fn likely(rows: usize) -> [f64; 2] {
    let n = rows as f64;
    if rows > 1000 {
        let half = 2.5758 * (CONTENT * (1.0 - CONTENT) / n).sqrt();
        return [CONTENT - half, CONTENT + half];
    }
    // P(X ≥ k) = I_p(k, n − k + 1), a tail of F with 2 (n − k + 1) and 2 k degrees of freedom.
    let at_least = |k: f64| {
        let rest = n - k + 1.0;
        f_beyond(k * (1.0 - CONTENT) / (rest * CONTENT), 2.0 * rest, 2.0 * k)
    };
    let largest = |tail: f64| (1..=rows).rev().map(|k| k as f64).find(|k| at_least(*k) > tail).unwrap_or(0.0);
    [0.995, 0.005].map(|tail| largest(tail) / n.max(1.0))
}

/// Test of the errors minus the repeatable sources against the uncertainty of the instrument: the
/// χ² test by which `identify` assesses its own residuals.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct ResidualTest {
    /// Factor of the stated uncertainty that explains the residuals.
    pub factor: f64,
    /// Degrees of freedom, counted as in an identification.
    pub freedom: f64,
    /// Probability of a factor at least as far from 1 by chance.
    pub p: f64,
}

impl ResidualTest {
    /// Tests the residuals of the machine as specified. `placed` is the fit of stations and
    /// fixtures to these rows, if there was one.
    ///
    /// Returns none if the map states no uncertainty, or for too few rows.
    pub(super) fn new(
        setup: &Setup,
        map: &Map,
        rows: &[Observation],
        placed: Option<&Fit>,
    ) -> Result<Option<Self>, Failure> {
        if !map.states_uncertainty() {
            return Ok(None);
        }
        let of_fit = |fit: &Fit| {
            let (factor, freedom) = (fit.sigma, fit.freedom);
            (freedom > 0.0).then(|| Self { factor, freedom, p: deviation_beyond(factor, freedom) })
        };
        if let Some(placed) = placed {
            return Ok(of_fit(placed));
        }
        // A fit without unknowns counts degrees of freedom and combines repeated visits.
        match fit(&setup.real.with(Vec::new()), rows, &Options::default()) {
            Ok(fit) => Ok(of_fit(&fit)),
            Err(Failure::TooFew { .. }) => Ok(None),
            Err(failure) => Err(failure),
        }
    }
}

#[cfg(test)]
mod tests;
