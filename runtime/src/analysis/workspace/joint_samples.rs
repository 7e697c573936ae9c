//! Samples of joint variables, evenly spread or random.

use core::ops::Range;

use rand::{Rng, RngExt};

use super::axis::in_range;
use super::{Configuration, Workspace};
use crate::analysis::ReachError;
use crate::analysis::sampling::{self, stream};
use crate::lanes::Tiles;
use crate::{Error, Manipulator, Quantity};

/// Where the numbers of samples come from.
#[derive(Clone, Copy, Debug)]
enum Spread {
    /// The Halton sequence.
    Even,
    /// Random numbers: a stream for every variable and [`STREAM`] configurations.
    Random { seed: u64 },
}

/// Samples of some variables; see [`joint_samples`] and [`random_joint_samples`].
#[derive(Clone, Debug)]
pub struct JointSamples {
    home: Configuration,
    /// A moved variable, its range, and the base of its radical inverse.
    moved: Vec<(usize, [f64; 2], usize)>,
    count: usize,
    spread: Spread,
}

/// `count` samples of the joints in `moved`, spread evenly within their limits; the others stay at home.
///
/// Parameters are nominal. [`Error::Count`] if `moved` names a variable that there is not.
pub fn joint_samples(
    manipulator: &dyn Manipulator,
    moved: &[usize],
    count: usize,
) -> Result<JointSamples, Error> {
    samples(manipulator, moved, count, Spread::Even)
}

/// As [`joint_samples`], but random: configuration `i` follows from the seed and `i` alone.
pub fn random_joint_samples(
    manipulator: &dyn Manipulator,
    moved: &[usize],
    count: usize,
    seed: u64,
) -> Result<JointSamples, Error> {
    samples(manipulator, moved, count, Spread::Random { seed })
}

fn samples(
    manipulator: &dyn Manipulator,
    moved: &[usize],
    count: usize,
    spread: Spread,
) -> Result<JointSamples, Error> {
    let description = manipulator.description();
    in_range(moved.iter().copied(), Quantity::Variables, description.variables.len())?;
    let home = Configuration::home(description);
    let arm = sampling::arm_length(manipulator, &home.s)?;
    let range = |(dimension, &i): (usize, &usize)| {
        (i, sampling::joint_range(&description.variables[i], arm), sampling::prime(dimension))
    };
    let moved = moved.iter().enumerate().map(range).collect();
    Ok(JointSamples { home, moved, count, spread })
}

impl Workspace for JointSamples {
    fn len(&self) -> usize {
        self.count
    }

    fn home(&self) -> &Configuration {
        &self.home
    }

    fn fill(&self, index: usize, q: &mut [f64], s: &mut [f64]) -> Result<(), ReachError> {
        q.copy_from_slice(&self.home.q);
        s.copy_from_slice(&self.home.s);
        match self.spread {
            Spread::Even => {
                for &(i, [lower, upper], base) in &self.moved {
                    q[i] = lower + (upper - lower) * sampling::radical_inverse(index + 1, base);
                }
            }
            Spread::Random { seed } => {
                for (random, &(i, range, _)) in self.streams(seed, index / STREAM).iter_mut().zip(&self.moved)
                {
                    (0..index % STREAM).for_each(|_| _ = random.next_u64());
                    q[i] = between(range, random);
                }
            }
        }
        Ok(())
    }

    fn fill_rows(&self, range: Range<usize>, rows: &mut Tiles) -> bool {
        let Spread::Random { seed } = self.spread else { return false };
        if !range.start.is_multiple_of(STREAM) {
            return false;
        }
        let moved = self.moved.iter().map(|moved| moved.0).collect::<Vec<_>>();
        for first in range.clone().step_by(STREAM) {
            let mut streams = self.streams(seed, first / STREAM);
            let count = STREAM.min(range.end - first);
            rows.set_each(&moved, first - range.start, count, |which| {
                between(self.moved[which].1, &mut streams[which])
            });
        }
        true
    }
}

impl JointSamples {
    /// The streams of all variables that are moved, for so many configurations: made side by side they do not wait
    /// for each other.
    fn streams(&self, seed: u64, block: usize) -> Vec<impl Rng> {
        let moved = self.moved.len();
        (0..moved).map(|which| stream(seed, block * moved + which)).collect()
    }
}

/// How many configurations take the numbers of a variable from one stream, one after the other.
pub(in crate::analysis) const STREAM: usize = 64;

/// A random number within limits.
#[inline]
fn between([lower, upper]: [f64; 2], random: &mut impl Rng) -> f64 {
    lower + (upper - lower) * random.random::<f64>()
}
