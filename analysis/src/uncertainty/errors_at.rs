//! Errors of every source at one configuration.

use rand::{Rng, RngExt};
use rand_distr::StudentT;

use crate::parts::{longest, outer_sum};
use crate::{Configuration, Measurand, Unevaluated, sweep};
use abbe_core::{Class, Description, Distribution, Error, lanes::Sweepable};
use abbe_kinematics::one;
use abbe_kinematics::sampling::{draw_parts, norm};

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
    sweep(manipulator, &one(configuration), &mut |row| sources.extend_from_slice(row.sources))
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
    let mut random: Vec<RandomError> = Vec::new();
    for (source, (one, bound)) in sources {
        let Some(distribution) = one.class.distribution() else { continue };
        let magnitude = measurand.rows(bound).map(|b| b / distribution.bound());
        if let Distribution::Ball { part: part @ 1.., .. } = distribution {
            let whole = description.whole(source);
            let ball = random.iter_mut().find(|other| other.source == whole);
            ball.expect("the first part of a ball is before the others").parts[usize::from(part)] = magnitude;
            continue;
        }
        random.push(RandomError {
            source,
            distribution,
            degrees_of_freedom: one.degrees_of_freedom,
            is_calibration: one.is_calibration(),
            is_of_machine: one.class.can_be_compensated() || one.is_calibration(),
            parts: [magnitude, [0.0; 3], [0.0; 3]],
        });
    }
    random.retain(RandomError::is_there);
    random
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
    /// ΔX for an error equal to its magnitude, of which the three rows are fully correlated; those
    /// of all parts of a ball or disc, otherwise of one.
    pub(super) parts: [[f64; 3]; 3],
}

impl RandomError {
    /// Returns whether its standard deviation was estimated from few measurements.
    pub(super) fn is_estimated(&self) -> bool {
        self.degrees_of_freedom.is_finite()
    }

    /// Returns whether it has a nonzero effect.
    pub(super) fn is_there(&self) -> bool {
        self.parts != [[0.0; 3]; 3]
    }

    /// Returns whether it has several parts, and no direction of its own.
    pub(super) fn has_parts(&self) -> bool {
        matches!(self.distribution, Distribution::Ball { .. })
    }

    /// Returns the largest norm of ΔX at its bound.
    pub(super) fn bound(&self) -> f64 {
        match self.has_parts() {
            true => longest(outer_sum(self.parts.into_iter())),
            false => self.distribution.bound() * norm(self.parts[0]),
        }
    }

    /// Draws its size, of each part. An error with an estimated standard deviation has Student's
    /// t-distribution (JCGM 101, 6.4.9).
    pub(super) fn draw(&self, random: &mut impl Rng) -> [f64; 3] {
        match StudentT::new(self.degrees_of_freedom) {
            Ok(student) if self.is_estimated() => [random.sample(student), 0.0, 0.0],
            _ => draw_parts(self.distribution, random),
        }
    }

    /// Returns ΔX for the sizes of its parts.
    pub(super) fn at(&self, sizes: [f64; 3]) -> [f64; 3] {
        core::array::from_fn(|row| (0..3).map(|part| sizes[part] * self.parts[part][row]).sum())
    }

    /// Scales it.
    pub(super) fn scale(&mut self, share: f64) {
        self.parts = self.parts.map(|part| part.map(|row| share * row));
    }

    /// Iterates over the standard uncertainties along the rows of each part, with the sign of ΔX.
    pub(super) fn standard_parts(&self) -> impl Iterator<Item = [f64; 3]> {
        self.parts.into_iter().map(|part| part.map(|row| row / self.distribution.divisor()))
    }

    /// Returns the standard uncertainties along the rows.
    pub(super) fn standard(&self) -> [f64; 3] {
        let matrix = outer_sum(self.standard_parts());
        [0, 1, 2].map(|i| matrix[i][i].sqrt())
    }
}

/// Returns whether the sum of the errors is a normal vector: all are normal with known standard
/// deviations.
pub(super) fn is_normal(random: &[RandomError]) -> bool {
    random.iter().all(|error| error.distribution == Distribution::Normal && !error.is_estimated())
}

/// Returns `Σ_k u_k u_kᵀ`.
pub(super) fn covariance(random: &[RandomError]) -> [[f64; 3]; 3] {
    outer_sum(random.iter().flat_map(RandomError::standard_parts))
}
