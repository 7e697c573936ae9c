//! Random errors of a given distribution.

use core::f64::consts::TAU;

use rand::{Rng, RngExt};
use rand_distr::StandardNormal;

use abbe_core::Distribution;

/// Draws an error of magnitude 1: within ±1 if bounded, with a standard deviation of 1 if normal.
pub fn draw(distribution: Distribution, random: &mut impl Rng) -> f64 {
    let mut share = || random.random::<f64>();
    match distribution {
        Distribution::Uniform => 2.0 * share() - 1.0,
        Distribution::Normal => random.sample(StandardNormal),
        // The sum of two uniform errors of half the width.
        Distribution::Triangular => share() + share() - 1.0,
        // A sine of random phase.
        Distribution::Arcsine => (TAU * share()).sin(),
    }
}

#[cfg(test)]
mod tests;
