//! Distribution of the error at one configuration: of the machine as built, or compensated.
//!
//! Correction of repeatable errors and tolerances by compensation.

use abbe_core::{Class, Description};
use abbe_kinematics::sampling::{norm, stream};
use rand::{Rng, RngExt};
use rand_distr::StandardNormal;

use super::errors_at::{ErrorsAt, RandomError, covariance, is_normal};
use crate::normal::{NormalVector, ONE_SIDED_95, PROBABILITY_ERROR};
use crate::parts::{longest, outer_sum};
use crate::{Measurand, in_order, worst_case};

/// Coverage probability of an expanded uncertainty.
pub const COVERAGE: f64 = 0.95;
/// Number of draws for errors that are not normal.
pub const DRAWS: usize = 200_000;
/// Number of draws per stream of random numbers.
const BLOCK: usize = 8192;

/// Probability that the norm of the error is within a limit at one configuration, to first order:
/// the repeatable sources are fixed, the random ones vary.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Compliance {
    /// Probability.
    pub probability: f64,
    /// Error of the probability: a bound for an integral, the standard error `√(p (1 − p)/N)` for
    /// draws.
    pub error: f64,
    /// Number of draws. `None` for an integral.
    pub draws: Option<usize>,
}

/// Distribution of the position error or of rows 4–6 at one configuration, to first order: the sum
/// of a fixed error, residuals of known norms, and random errors.
#[derive(Clone, Debug)]
pub struct ErrorDistribution {
    pub(super) bias: [f64; 3],
    /// Fixed errors of single sources, whose sum is the bias.
    fixed: Vec<(usize, [f64; 3])>,
    /// Residuals of known direction, whose signs are unknown and independent, by source.
    pub(super) signed: Vec<(usize, [f64; 3])>,
    /// Norms of residuals of unknown directions; by source, or of all together.
    pub(super) undirected: Vec<(Option<usize>, f64)>,
    pub(super) random: Vec<RandomError>,
}

/// Largest error over all signs at one configuration.
#[derive(Clone, Debug, PartialEq)]
pub struct WorstCase {
    /// Norm; normal errors are at 3σ.
    pub norm: f64,
    /// Share of each source with a nonzero effect in the norm, along the direction of the largest
    /// error; negative for a source that counteracts the others. A residual of all sources
    /// together has no share.
    pub shares: Vec<(usize, f64)>,
}

impl ErrorDistribution {
    /// Returns the distribution of a fixed error and random ones.
    pub(super) fn new(bias: [f64; 3], random: Vec<RandomError>) -> Self {
        Self { bias, fixed: Vec::new(), signed: Vec::new(), undirected: Vec::new(), random }
    }

    /// Returns the distribution for a machine, given ΔX of each source as in
    /// [`Row::sources`](crate::Row::sources). Without a correction the repeatable sources keep
    /// their values. A residual that is a length says nothing of rows 4–6: there the errors count
    /// as not compensated.
    pub fn at(
        description: &Description,
        sources: &[[f64; 6]],
        measurand: Measurand,
        correction: Option<Correction>,
    ) -> Self {
        let mut all = Self::new([0.0; 3], super::errors_at::random(description, sources, measurand));
        let is_position = measurand == Measurand::Position;
        let together = correction.and_then(|correction| correction.together);
        if let Some(norm) = together.filter(|_| is_position) {
            all.undirected.push((None, norm));
            all.random.retain(|one| !description.sources[one.source].class.can_be_compensated());
            return all;
        }
        for (k, (source, error)) in description.sources.iter().zip(sources).enumerate() {
            if !source.class.can_be_compensated() || description.whole(k) != k {
                continue;
            }
            let error = measurand.rows(error);
            let residual = correction.filter(|_| together.is_none());
            let residual = residual.and_then(|correction| correction.residuals.get(k).copied().flatten());
            match (residual, source.class) {
                // Only where the source has an error.
                (Some(Residual::Bound(bound)), _) if is_position => {
                    let acts = error != [0.0; 3] || all.random.iter().any(|one| one.source == k);
                    all.random.retain(|one| one.source != k);
                    all.undirected.extend(acts.then_some((Some(k), bound)));
                }
                (Some(Residual::Share(share)), Class::Repeatable) if share < 1.0 => {
                    all.signed.push((k, error.map(|row| share * row)));
                }
                (_, Class::Repeatable) => {
                    all.bias = core::array::from_fn(|i| all.bias[i] + error[i]);
                    all.fixed.push((k, error));
                }
                (Some(Residual::Share(share)), _) => {
                    all.random.iter_mut().filter(|one| one.source == k).for_each(|one| one.scale(share));
                }
                _ => {}
            }
        }
        all.random.retain(RandomError::is_there);
        all.signed.retain(|(_, error)| *error != [0.0; 3]);
        all
    }

    /// Returns whether the error is a normal vector, so that its coverage is an integral.
    pub fn is_normal(&self) -> bool {
        is_normal(&self.random) && self.signed.is_empty() && self.undirected.is_empty()
    }

    /// Returns `‖bias‖ + √(Σ ρ²)` with the norms ρ of the residuals.
    pub fn repeatable_radius(&self) -> f64 {
        norm(self.bias) + root_sum_of_squares(self.residuals())
    }

    /// Returns `‖bias‖ + √(Σ ρ²) + √(Σ b²)` with the bounds b of the random sources, as the paper
    /// adds them.
    pub fn radius(&self) -> f64 {
        self.repeatable_radius() + root_sum_of_squares(self.bounds().map(|(_, bound)| bound))
    }

    /// Returns the largest error over all signs, `max ‖bias + Σ ± ρ + Σ ± b‖`, with residuals of
    /// unknown direction, balls, and the calibration at their largest norms in its direction.
    pub fn worst_case(&self) -> WorstCase {
        let random = self.random.iter().filter(|one| !one.is_calibration && !one.has_parts());
        let random = random.map(|one| (one.source, one.at([one.distribution.bound(), 0.0, 0.0])));
        let unknown: Vec<(usize, [f64; 3])> = random.chain(self.signed.iter().copied()).collect();
        let vectors: Vec<[f64; 3]> = unknown.iter().map(|(_, vector)| *vector).collect();
        let longest = worst_case(self.bias, &vectors);
        let with_parts =
            self.random.iter().filter(|one| one.has_parts()).map(|one| (Some(one.source), one.bound()));
        let with_parts: Vec<(Option<usize>, f64)> = with_parts.chain(self.calibration()).collect();
        let undirected = || self.undirected.iter().copied().chain(with_parts.iter().copied());
        let norm = norm(longest) + undirected().map(|(_, norm)| norm).sum::<f64>();
        let along = |v: [f64; 3]| (0..3).map(|i| longest[i] * v[i]).sum::<f64>() / self::norm(longest) / norm;
        let fixed = self.fixed.iter().map(|(source, v)| (*source, along(*v)));
        let unknown = unknown.iter().map(|(source, v)| (*source, along(*v).abs()));
        let others = undirected().filter_map(|(source, length)| Some((source?, length / norm)));
        let shares = fixed.chain(unknown).chain(others);
        WorstCase { norm, shares: shares.filter(|(_, share)| share.is_finite()).collect() }
    }

    /// Returns the first source of the calibration, and its largest norm.
    fn calibration(&self) -> Option<(Option<usize>, f64)> {
        let parts = || self.random.iter().filter(|one| one.is_calibration);
        let at_bound = parts().map(|one| one.at([one.distribution.bound(), 0.0, 0.0]));
        Some((Some(parts().next()?.source), longest(outer_sum(at_bound))))
    }

    /// Returns the share of each source with a nonzero effect in the [`radius`](Self::radius), to
    /// first order in its size; negative for a source that counteracts the others.
    pub fn shares(&self) -> Vec<(usize, f64)> {
        let radius = self.radius();
        let along = |v: [f64; 3]| (0..3).map(|i| self.bias[i] * v[i]).sum::<f64>() / norm(self.bias) / radius;
        let fixed = self.fixed.iter().map(|(source, v)| (*source, along(*v)));
        let of = |whole: f64, norm: f64| norm * norm / whole / radius;
        let left = root_sum_of_squares(self.residuals());
        let signed = self.signed.iter().map(|(source, v)| (*source, of(left, norm(*v))));
        let undirected = self.undirected.iter();
        let undirected = undirected.filter_map(|(source, norm)| Some(((*source)?, of(left, *norm))));
        let bounds = root_sum_of_squares(self.bounds().map(|(_, bound)| bound));
        let random = self.bounds().map(|(source, bound)| (source, of(bounds, bound)));
        let shares = fixed.chain(signed).chain(undirected).chain(random);
        shares.filter(|(_, share)| share.is_finite()).collect()
    }

    /// Returns `‖bias‖ + Σ ρ + Σ ‖b‖`, an upper bound of the worst case.
    pub fn simple_bound(&self) -> f64 {
        norm(self.bias) + self.residuals().sum::<f64>() + self.bounds().map(|(_, bound)| bound).sum::<f64>()
    }

    /// Returns whether no source is unbounded.
    pub fn is_bounded(&self) -> bool {
        self.random.iter().all(|one| one.distribution.is_bounded())
    }

    /// Returns an approximation of the norm that is exceeded with a probability of 5 %, and of the
    /// number of standard deviations by which a limit exceeds the median.
    ///
    /// The squared norm of an error with mean b and covariance C has the mean `κ_1 = |b|² + tr C`
    /// and the variance `κ_2 = 2 tr C² + 4 bᵀ C b`. Its root is nearly normal, with the mean `√(κ_1
    /// − κ_2/(4 κ_1))` and the standard deviation `√κ_2 / (2 √κ_1)`.
    pub fn approximate(&self, limit: f64) -> [f64; 2] {
        let (b, c) = (self.bias, self.covariance());
        let sum = |f: &dyn Fn(usize, usize) -> f64| (0..9).map(|k| f(k / 3, k % 3)).sum::<f64>();
        let mean = b.iter().map(|row| row * row).sum::<f64>() + c[0][0] + c[1][1] + c[2][2];
        let variance = 2.0 * sum(&|i, j| c[i][j] * c[i][j]) + 4.0 * sum(&|i, j| b[i] * c[i][j] * b[j]);
        if mean == 0.0 {
            return [0.0, f64::INFINITY];
        }
        let middle = (mean - variance / (4.0 * mean)).max(0.0).sqrt();
        let deviation = variance.max(0.0).sqrt() / (2.0 * mean.sqrt());
        [middle + ONE_SIDED_95 * deviation, (limit - middle) / deviation.max(1e-12 * limit)]
    }

    /// Returns the probability that the norm is within a limit as if the error were normal with
    /// this mean and covariance.
    pub fn normal_within(&self, limit: f64) -> f64 {
        NormalVector::new(self.bias, self.covariance()).within(limit)
    }

    /// Returns the probability that the norm is within a limit, and the norm that contains the
    /// error with a probability of 95 %. If all errors are normal these are integrals. Otherwise
    /// they come from [`DRAWS`] draws, which depend on the seed alone; residuals are drawn with
    /// their full norm.
    pub fn coverage(&self, limit: f64, seed: u64) -> (Compliance, f64) {
        if self.is_normal() {
            let normal = NormalVector::new(self.bias, self.covariance());
            let error = if self.random.is_empty() { 0.0 } else { PROBABILITY_ERROR };
            let compliance = Compliance { probability: normal.within(limit), error, draws: None };
            return (compliance, normal.quantile(COVERAGE));
        }
        let mut norms = Vec::with_capacity(DRAWS);
        let Ok(()) = in_order(
            DRAWS.div_ceil(BLOCK),
            |block| {
                let mut numbers = stream(seed, block);
                let draws = block * BLOCK..DRAWS.min((block + 1) * BLOCK);
                Ok::<_, core::convert::Infallible>(
                    draws.map(|_| norm(self.draw(&mut numbers))).collect::<Vec<f64>>(),
                )
            },
            |more| norms.extend(more),
        );
        let within = norms.iter().filter(|norm| **norm <= limit).count();
        let probability = within as f64 / DRAWS as f64;
        let error = (probability * (1.0 - probability) / DRAWS as f64).sqrt();
        let rank = (COVERAGE * DRAWS as f64).ceil() as usize - 1;
        let (_, quantile, _) = norms.select_nth_unstable_by(rank, f64::total_cmp);
        (Compliance { probability, error, draws: Some(DRAWS) }, *quantile)
    }

    fn draw(&self, numbers: &mut impl Rng) -> [f64; 3] {
        let mut error = self.bias;
        for one in &self.random {
            error = sum_of(error, [one.at(one.draw(numbers))]);
        }
        for (_, residual) in &self.signed {
            let sign = if numbers.random::<bool>() { 1.0 } else { -1.0 };
            error = core::array::from_fn(|i| error[i] + sign * residual[i]);
        }
        for (_, length) in &self.undirected {
            let direction: [f64; 3] = core::array::from_fn(|_| numbers.sample(StandardNormal));
            let scale = length / norm(direction);
            error = core::array::from_fn(|i| error[i] + scale * direction[i]);
        }
        error
    }

    /// Returns the covariance: `Σ u uᵀ` of the random errors, `r rᵀ` of a residual with unknown
    /// sign, and `ρ²/3` along each axis of one with unknown direction.
    fn covariance(&self) -> [[f64; 3]; 3] {
        let mut sum = covariance(&self.random);
        let isotropic = self.undirected.iter().map(|(_, norm)| norm * norm).sum::<f64>() / 3.0;
        for (i, row) in sum.iter_mut().enumerate() {
            row[i] += isotropic;
            for (j, entry) in row.iter_mut().enumerate() {
                *entry += self.signed.iter().map(|(_, r)| r[i] * r[j]).sum::<f64>();
            }
        }
        sum
    }

    fn residuals(&self) -> impl Iterator<Item = f64> {
        let undirected = self.undirected.iter().map(|(_, norm)| *norm);
        self.signed.iter().map(|(_, error)| norm(*error)).chain(undirected)
    }

    /// Iterates over the sources of random errors and their largest norms, with a calibration as
    /// one.
    fn bounds(&self) -> impl Iterator<Item = (usize, f64)> {
        let others = self.random.iter().filter(|one| !one.is_calibration);
        let calibration = self.calibration().and_then(|(source, norm)| Some((source?, norm)));
        others.map(|one| (one.source, one.bound())).chain(calibration)
    }
}

fn root_sum_of_squares(norms: impl Iterator<Item = f64>) -> f64 {
    norms.map(|norm| norm * norm).sum::<f64>().sqrt()
}

impl ErrorsAt<'_> {
    /// Returns the distribution of the error, with the repeatable sources at their values or
    /// corrected.
    pub fn distribution(&self, measurand: Measurand, correction: Option<Correction>) -> ErrorDistribution {
        ErrorDistribution::at(self.description, &self.sources, measurand, correction)
    }
}

/// Returns the sum of a vector and others.
pub(super) fn sum_of(first: [f64; 3], others: impl IntoIterator<Item = [f64; 3]>) -> [f64; 3] {
    others.into_iter().fold(first, |sum, v| core::array::from_fn(|i| sum[i] + v[i]))
}

/// Error that remains of a repeatable source or a tolerance after compensation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Residual {
    /// Share of its error: `f ‖r_k(q)‖` with unknown sign, or `f` times the value of a tolerance.
    Share(f64),
    /// Error of at most this norm, in the length unit, wherever the source has an error.
    Bound(f64),
}

/// Correction of the repeatable errors and tolerances by compensation.
#[derive(Clone, Copy, Debug)]
pub struct Correction<'a> {
    /// Residual of each source; those of random ones mean nothing. A share of 1 is not compensated:
    /// the error keeps its value and sign.
    pub residuals: &'a [Option<Residual>],
    /// Norm of the position error that remains of all repeatable sources and tolerances together,
    /// in the length unit, in place of their residuals.
    pub together: Option<f64>,
}
