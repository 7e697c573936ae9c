//! Random numbers in streams: the same on every run, machine and number of threads.

use rand::{Rng, SeedableRng};
use rand_xoshiro::{SplitMix64, Xoshiro256PlusPlus};

/// Random numbers that follow from a seed and the number of the stream: xoshiro256++, whose state is the SplitMix64
/// sequence from both.
pub fn stream(seed: u64, number: usize) -> impl Rng {
    Xoshiro256PlusPlus::seed_from_u64(seed ^ SplitMix64::seed_from_u64(number as u64).next_u64())
}
