//! Monte Carlo simulation at one configuration, on the exact chain with exact rotations.

use super::Quantile;
use crate::{
    Configuration, Ellipsoid, ErrorParts, Measurand, Sweepable, Unevaluated, covariance, in_order, sweep,
};
use abbe_core::{Error, Pose, deviation, drawn_pose, repeatable_magnitudes};
use abbe_kinematics::one;
use abbe_kinematics::sampling::{norm, stream};

/// Number of draws per stream of random numbers and per block.
const DRAWS: usize = 4096;

/// Result of a simulation at one configuration. Repeatable sources are fixed; each random source
/// has one random magnitude for all its effects. Position errors are in `F_0` and in the length
/// unit.
///
/// With the feature `serde` it serializes as in the report of `abbe analyze`, where both places
/// share the number of draws.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MonteCarlo {
    /// Number of draws.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub draws: usize,
    /// The 50, 95 and 99 % quantiles of the norm of the total error.
    pub quantiles: [Quantile; 3],
    /// Largest norm of a draw.
    pub largest: f64,
    /// Mean error: the repeatable sources, and second-order effects of random rotations.
    pub mean: [f64; 3],
    /// Covariance of the draws, in the squared length unit.
    pub covariance: [[f64; 3]; 3],
    /// Standard error of each entry of the covariance, `√(Var(d_i d_j) / N)`, in the
    /// squared length unit.
    #[cfg_attr(feature = "serde", serde(rename = "covariance_standard_error"))]
    pub standard_error: [[f64; 3]; 3],
    /// Covariance to first order, `J_e Σ J_eᵀ`, in the squared length unit.
    #[cfg_attr(feature = "serde", serde(rename = "first_order_covariance"))]
    pub first_order: [[f64; 3]; 3],
    /// Share of the draws within the first-order 95 % ellipsoid about the error without random
    /// sources, 0.95 only for normal sources. `None` if the ellipsoid is flat.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub inside_ellipsoid: Option<f64>,
}

/// Draws all sources at a configuration, `draws` times. The result depends on the seed, not on the
/// number of threads.
///
/// Uses eight bytes of memory per draw. Errors as for [`sweep`] and [`drawn_pose`].
pub fn monte_carlo(
    manipulator: &dyn Sweepable,
    configuration: &Configuration,
    draws: usize,
    seed: u64,
) -> Result<MonteCarlo, Error> {
    let description = manipulator.description();
    let mut first_order = [[0.0; 3]; 3];
    let mut ideal = Pose::IDENTITY;
    sweep(manipulator, &one(configuration), &mut |row| {
        first_order = covariance(&description.sources, row.sources, Measurand::Position);
        ideal = row.pose;
    })
    .map_err(|Unevaluated { error, .. }| error)?;
    let error = |magnitudes: &[f64]| {
        let Configuration { q, s, u } = configuration;
        let real = drawn_pose(manipulator, q, s, u, magnitudes)?;
        Ok::<_, Error>(Measurand::Position.rows(&deviation(description.orientation, &ideal, &real)))
    };
    let without_random = error(&repeatable_magnitudes(description))?;
    let parts = ErrorParts::new(description);
    let ellipsoid = Ellipsoid::new(first_order, 0);
    let flat = ellipsoid.rank() < 3;
    let mut sums = Sums::default();
    let mut norms = Vec::with_capacity(draws);
    in_order(
        draws.div_ceil(DRAWS),
        |block| {
            let mut random = stream(seed, block);
            let mut magnitudes = vec![1.0; description.sources.len()];
            let (mut sums, mut norms) = (Sums::default(), Vec::with_capacity(DRAWS));
            for _ in block * DRAWS..draws.min((block + 1) * DRAWS) {
                for (k, source) in description.sources.iter().enumerate() {
                    let Some(distribution) = source.class.distribution() else { continue };
                    parts.draw(k, distribution, &mut random, |part, drawn| magnitudes[part] = drawn);
                }
                let error = error(&magnitudes)?;
                norms.push(norm(error));
                let d = core::array::from_fn(|i| error[i] - without_random[i]);
                sums.add(d, inside(&ellipsoid, d));
            }
            Ok::<_, Error>((sums, norms))
        },
        |(more, drawn)| {
            sums.merge(&more);
            norms.extend(drawn);
        },
    )?;
    norms.sort_unstable_by(f64::total_cmp);
    let (mean, covariance, standard_error) = sums.moments();
    Ok(MonteCarlo {
        draws,
        quantiles: [0.5, 0.95, 0.99].map(|probability| Quantile::from_sorted(&norms, probability)),
        largest: norms.last().copied().unwrap_or_default(),
        // Adding 0 avoids −0.
        mean: core::array::from_fn(|i| without_random[i] + mean[i] + 0.0),
        covariance,
        standard_error,
        first_order,
        inside_ellipsoid: (!flat && draws > 0).then(|| sums.inside as f64 / draws as f64),
    })
}

/// Returns whether `Σ_i (a_i · d / l_i)² ≤ 1` with the semi-axes l and their directions a.
fn inside(Ellipsoid { semi_axes, principal, .. }: &Ellipsoid, d: [f64; 3]) -> bool {
    let along = principal.components(d);
    along.iter().zip(semi_axes).map(|(along, length)| (along / length).powi(2)).sum::<f64>() <= 1.0
}

/// Sums over draws d, over their products, and over the squares of these.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    count: usize,
    inside: usize,
    d: [f64; 3],
    products: [[f64; 3]; 3],
    squares: [[f64; 3]; 3],
}

impl Sums {
    fn add(&mut self, d: [f64; 3], inside: bool) {
        self.count += 1;
        self.inside += usize::from(inside);
        for i in 0..3 {
            self.d[i] += d[i];
            for j in 0..3 {
                let product = d[i] * d[j];
                self.products[i][j] += product;
                self.squares[i][j] += product * product;
            }
        }
    }

    fn merge(&mut self, other: &Self) {
        self.count += other.count;
        self.inside += other.inside;
        for i in 0..3 {
            self.d[i] += other.d[i];
            for j in 0..3 {
                self.products[i][j] += other.products[i][j];
                self.squares[i][j] += other.squares[i][j];
            }
        }
    }

    /// Returns the mean, the covariance `Cov = E[d dᵀ] − m mᵀ`, and its standard errors.
    fn moments(&self) -> ([f64; 3], [[f64; 3]; 3], [[f64; 3]; 3]) {
        let count = self.count.max(1) as f64;
        let mean = self.d.map(|sum| sum / count);
        let matrix = |entry: &dyn Fn(usize, usize) -> f64| {
            // Adding 0 avoids −0.
            core::array::from_fn(|i| core::array::from_fn(|j| entry(i, j) + 0.0))
        };
        let covariance = matrix(&|i, j| {
            let entry = self.products[i][j] / count - mean[i] * mean[j];
            // Rounding must not make a variance negative.
            if i == j { entry.max(0.0) } else { entry }
        });
        let error = matrix(&|i, j| {
            let variance = self.squares[i][j] / count - (self.products[i][j] / count).powi(2);
            (variance.max(0.0) / count).sqrt()
        });
        (mean, covariance, error)
    }
}
