//! Random errors of a given distribution.

use core::f64::consts::TAU;

use rand::{Rng, RngExt};
use rand_distr::StandardNormal;

use abbe_core::{Distribution, sampling::norm};

/// Draws an error of magnitude 1: within ±1 if bounded, with a standard deviation of 1 if normal.
/// The parts of a ball or disc are drawn together; any other error has one part, and zeros.
pub fn draw_parts(distribution: Distribution, random: &mut impl Rng) -> [f64; 3] {
    let mut share = || random.random::<f64>();
    let one = match distribution {
        Distribution::Uniform => 2.0 * share() - 1.0,
        Distribution::Normal => random.sample(StandardNormal),
        // The sum of two uniform errors of half the width.
        Distribution::Triangular => share() + share() - 1.0,
        // A sine of random phase.
        Distribution::Arcsine => (TAU * share()).sin(),
        Distribution::Ball { parts, .. } => loop {
            let count = usize::from(parts);
            let point = core::array::from_fn(|i| if i < count { 2.0 * share() - 1.0 } else { 0.0 });
            if norm(point) <= 1.0 {
                return point;
            }
        },
    };
    [one, 0.0, 0.0]
}

/// Draws an error of magnitude 1, or the first part of one.
pub fn draw(distribution: Distribution, random: &mut impl Rng) -> f64 {
    draw_parts(distribution, random)[0]
}

#[cfg(test)]
mod tests;
