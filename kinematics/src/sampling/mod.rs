//! Deterministic sample points and random errors: the same on every run and every machine.

mod draw;

pub use abbe_core::sampling::*;
pub use draw::{draw, draw_parts};

use rand::{Rng, SeedableRng};
use rand_xoshiro::{SplitMix64, Xoshiro256PlusPlus};

/// Returns the random numbers of a seed and a stream number: xoshiro256++, whose state is the
/// SplitMix64 sequence of both.
pub fn stream(seed: u64, number: usize) -> impl Rng {
    Xoshiro256PlusPlus::seed_from_u64(seed ^ SplitMix64::seed_from_u64(number as u64).next_u64())
}
