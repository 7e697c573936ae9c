//! Errors of every source at one configuration.

use rand::{Rng, RngExt};
use rand_distr::StudentT;

use crate::sweep::sweep;
use crate::{Configuration, Measurand, Unevaluated};
use abbe_core::lanes::Sweepable;
use abbe_core::{Class, Description, Distribution, Error};
use abbe_kinematics::One;
use abbe_kinematics::sampling::{draw, norm};

/// Errors of every source at one configuration, to first order.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorsAt<'a> {
    /// Description of the manipulator.
    pub description: &'a Description,
    /// ΔX of each source; the bound for a random one, as in [`Row::sources`](crate::Row::sources).
    pub sources: Vec<[f64; 6]>,
    /// Values of the effects; magnitudes for random ones.
    pub effects: Vec<f64>,
}

/// Evaluates the sources at a configuration. Errors as for [`sweep`].
pub fn errors_at<'a>(
    manipulator: &'a dyn Sweepable,
    configuration: &Configuration,
) -> Result<ErrorsAt<'a>, Error> {
    let description = manipulator.description();
    let mut sources = Vec::new();
    sweep(manipulator, &One(configuration), &mut |row| sources.extend_from_slice(row.sources))
        .map_err(|Unevaluated { error, .. }| error)?;
    let mut effects = vec![0.0; description.effects.len()];
    manipulator.effects(&configuration.q, &configuration.s, &configuration.u, &mut effects)?;
    Ok(ErrorsAt { description, sources, effects })
}

impl ErrorsAt<'_> {
    /// Returns the sum of the repeatable sources.
    pub fn bias(&self, measurand: Measurand) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (source, error) in self.description.sources.iter().zip(&self.sources) {
            if source.class == Class::Repeatable {
                let error = measurand.rows(error);
                sum = core::array::from_fn(|i| sum[i] + error[i]);
            }
        }
        sum
    }

    /// Returns the random sources with a nonzero effect.
    pub(super) fn random(&self, measurand: Measurand) -> Vec<RandomError> {
        random(self.description, &self.sources, measurand)
    }
}

/// Returns the random sources with a nonzero effect, given ΔX of each source at its bound.
pub(super) fn random(
    description: &Description,
    sources: &[[f64; 6]],
    measurand: Measurand,
) -> Vec<RandomError> {
    let sources = description.sources.iter().zip(sources).enumerate();
    let random = sources.filter_map(|(source, (one, bound))| {
        let distribution = one.class.distribution()?;
        let magnitude = measurand.rows(bound).map(|b| b / distribution.bound());
        (magnitude != [0.0; 3]).then_some(RandomError {
            source,
            distribution,
            degrees_of_freedom: one.degrees_of_freedom,
            is_calibration: one.is_calibration(),
            is_of_machine: one.class.can_be_compensated() || one.is_calibration(),
            magnitude,
        })
    });
    random.collect()
}

/// Random source at a configuration.
#[derive(Clone, Copy, Debug)]
pub(super) struct RandomError {
    pub(super) source: usize,
    pub(super) distribution: Distribution,
    /// Degrees of freedom of its standard deviation. Infinite if that is known.
    pub(super) degrees_of_freedom: f64,
    /// Marks a part of the uncertainty of a calibration.
    pub(super) is_calibration: bool,
    /// Marks an error with one value in each machine: a tolerance, or that of a calibration.
    pub(super) is_of_machine: bool,
    /// ΔX for an error equal to its magnitude. The three rows are fully correlated.
    pub(super) magnitude: [f64; 3],
}

impl RandomError {
    /// Returns whether its standard deviation was estimated from few measurements.
    pub(super) fn is_estimated(&self) -> bool {
        self.degrees_of_freedom.is_finite()
    }

    /// Returns the norm of ΔX at its bound.
    pub(super) fn bound(&self) -> f64 {
        self.distribution.bound() * norm(self.magnitude)
    }

    /// Draws its size. An error with an estimated standard deviation has Student's t-distribution
    /// (JCGM 101, 6.4.9).
    pub(super) fn draw(&self, random: &mut impl Rng) -> f64 {
        match StudentT::new(self.degrees_of_freedom) {
            Ok(student) if self.is_estimated() => random.sample(student),
            _ => draw(self.distribution, random),
        }
    }

    /// Returns the standard uncertainties along the rows, with the sign of ΔX.
    pub(super) fn standard(&self) -> [f64; 3] {
        self.magnitude.map(|a| a / self.distribution.divisor())
    }
}

/// Returns whether the sum of the errors is a normal vector: all are normal with known standard
/// deviations.
pub(super) fn is_normal(random: &[RandomError]) -> bool {
    random.iter().all(|error| error.distribution == Distribution::Normal && !error.is_estimated())
}

/// Returns `Σ_k u_k u_kᵀ`.
pub(super) fn covariance(random: &[RandomError]) -> [[f64; 3]; 3] {
    let mut sum = [[0.0; 3]; 3];
    for u in random.iter().map(RandomError::standard) {
        sum = core::array::from_fn(|i| core::array::from_fn(|j| sum[i][j] + u[i] * u[j]));
    }
    sum
}
