//! Workspaces of joint variables: grids, evenly spread samples, random samples, lists.

use core::ops::Range;

use rand::{Rng, RngExt, SeedableRng};
use rand_xoshiro::{SplitMix64, Xoshiro256PlusPlus};

use super::sweep::BLOCK;
use super::workspace::{combinations, combine, in_range};
use super::{Axis, Configuration, Unreached, Workspace, sampling};
use crate::lanes::Tiles;
use crate::{Error, Manipulator, Quantity};

/// Every combination of the values of some variables; see [`joint_grid`].
#[derive(Clone, Debug)]
pub struct JointGrid {
    home: Configuration,
    axes: Vec<Axis>,
}

/// Every combination of the values of some variables, the last one fastest; the others stay at home.
///
/// Parameters are nominal. [`Error::Count`] if an axis names a variable that there is not.
pub fn joint_grid(manipulator: &dyn Manipulator, axes: &[Axis]) -> Result<JointGrid, Error> {
    let description = manipulator.description();
    let indices = axes.iter().map(|axis| axis.index);
    in_range(indices, Quantity::Variables, description.variables.len())?;
    Ok(JointGrid { home: Configuration::home(description), axes: axes.to_vec() })
}

impl Workspace for JointGrid {
    fn len(&self) -> usize {
        combinations(&self.axes)
    }

    fn home(&self) -> &Configuration {
        &self.home
    }

    fn fill(&self, index: usize, q: &mut [f64], s: &mut [f64]) -> Result<(), Unreached> {
        q.copy_from_slice(&self.home.q);
        s.copy_from_slice(&self.home.s);
        combine(index, &self.axes, q);
        Ok(())
    }
}

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

    fn fill(&self, index: usize, q: &mut [f64], s: &mut [f64]) -> Result<(), Unreached> {
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
const STREAM: usize = BLOCK;

/// A random number within limits.
#[inline]
fn between([lower, upper]: [f64; 2], random: &mut impl Rng) -> f64 {
    lower + (upper - lower) * random.random::<f64>()
}

/// Random numbers that follow from a seed and the number of the stream: xoshiro256++, whose state is the SplitMix64
/// sequence from both.
pub(crate) fn stream(seed: u64, number: usize) -> impl Rng {
    Xoshiro256PlusPlus::seed_from_u64(seed ^ SplitMix64::seed_from_u64(number as u64).next_u64())
}

/// Configurations one after the other, a path say; see [`listed`].
#[derive(Clone, Debug)]
pub struct Listed {
    home: Configuration,
    configurations: Vec<Configuration>,
    limits: Vec<[f64; 2]>,
}

/// A list of configurations; those with a variable outside its limits count as unreachable.
///
/// [`Error::Count`] if one has not as many variables or parameters as the manipulator.
pub fn listed(manipulator: &dyn Manipulator, configurations: Vec<Configuration>) -> Result<Listed, Error> {
    let description = manipulator.description();
    let home = Configuration::home(description);
    for Configuration { q, s } in &configurations {
        for (quantity, expected, found) in
            [(Quantity::Variables, home.q.len(), q.len()), (Quantity::Parameters, home.s.len(), s.len())]
        {
            if expected != found {
                return Err(Error::Count { quantity, expected, found });
            }
        }
    }
    let limits = description.variables.iter().map(|variable| variable.limits).collect();
    Ok(Listed { home, configurations, limits })
}

impl Workspace for Listed {
    fn len(&self) -> usize {
        self.configurations.len()
    }

    fn home(&self) -> &Configuration {
        &self.home
    }

    fn fill(&self, index: usize, q: &mut [f64], s: &mut [f64]) -> Result<(), Unreached> {
        let configuration = self.configurations.get(index).unwrap_or(&self.home);
        q.copy_from_slice(&configuration.q);
        s.copy_from_slice(&configuration.s);
        let outside = |(value, [lower, upper]): (&f64, &[f64; 2])| value < lower || value > upper;
        match q.iter().zip(&self.limits).position(outside) {
            Some(variable) => {
                Err(Unreached::OutsideLimits { variable, value: q[variable], limits: self.limits[variable] })
            }
            None => Ok(()),
        }
    }
}
