//! Samples of joint variables and inputs, evenly spread or random.

use core::ops::Range;

use rand::{Rng, RngExt};

use super::axis::in_range;
use super::{Configuration, Workspace};
use crate::ReachError;
use crate::sampling::{self, stream};
use abbe_core::lanes::Tiles;
use abbe_core::{Error, Manipulator, Quantity};

/// Where the numbers of samples come from.
#[derive(Clone, Copy, Debug)]
enum Spread {
    /// The Halton sequence.
    Even,
    /// Random numbers: a stream for everything that moves and [`STREAM`] configurations.
    Random { seed: u64 },
}

/// Samples of some variables and inputs; see [`joint_samples`] and [`random_joint_samples`].
#[derive(Clone, Debug)]
pub struct JointSamples {
    home: Configuration,
    moved: Vec<Moved>,
    count: usize,
    spread: Spread,
}

/// What moves.
#[derive(Clone, Copy, Debug)]
struct Moved {
    what: What,
    range: [f64; 2],
    /// Of its radical inverse.
    base: usize,
}

/// A variable or an input, by its index.
#[derive(Clone, Copy, Debug)]
enum What {
    Variable(usize),
    Input(usize),
}

/// `count` samples of the joints in `moved`, spread evenly within their limits; the others stay at home.
///
/// Parameters and inputs are nominal; [`JointSamples::inputs`] moves these. [`Error::Count`] if `moved` names a variable that there is not.
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
    let moved = moved.iter().enumerate().map(|(dimension, &i)| Moved {
        what: What::Variable(i),
        range: sampling::joint_range(&description.variables[i], arm),
        base: sampling::prime(dimension),
    });
    let moved = moved.collect();
    Ok(JointSamples { home, moved, count, spread })
}

impl Workspace for JointSamples {
    fn len(&self) -> usize {
        self.count
    }

    fn home(&self) -> &Configuration {
        &self.home
    }

    fn fill(&self, index: usize, configuration: &mut Configuration) -> Result<(), ReachError> {
        configuration.copy_from(&self.home);
        match self.spread {
            Spread::Even => {
                for &Moved { what, range: [lower, upper], base } in &self.moved {
                    let share = sampling::radical_inverse(index + 1, base);
                    *what.value(configuration) = lower + (upper - lower) * share;
                }
            }
            Spread::Random { seed } => {
                for (random, moved) in self.streams(seed, index / STREAM).iter_mut().zip(&self.moved) {
                    (0..index % STREAM).for_each(|_| _ = random.next_u64());
                    *moved.what.value(configuration) = between(moved.range, random);
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
        let moved = self.moved.iter().map(|moved| self.row(moved.what)).collect::<Vec<_>>();
        for first in range.clone().step_by(STREAM) {
            let mut streams = self.streams(seed, first / STREAM);
            let count = STREAM.min(range.end - first);
            rows.set_each(&moved, first - range.start, count, |which| {
                between(self.moved[which].range, &mut streams[which])
            });
        }
        true
    }
}

impl What {
    /// Its value in a configuration.
    fn value(self, configuration: &mut Configuration) -> &mut f64 {
        match self {
            Self::Variable(i) => &mut configuration.q[i],
            Self::Input(i) => &mut configuration.u[i],
        }
    }
}

impl JointSamples {
    /// Moves these inputs too, each within its range.
    ///
    /// [`Error::Count`] if there is no such input, [`Error::NotFinite`] if its range has no end.
    pub fn inputs(mut self, manipulator: &dyn Manipulator, inputs: &[usize]) -> Result<Self, Error> {
        let description = manipulator.description();
        in_range(inputs.iter().copied(), Quantity::Inputs, description.inputs.len())?;
        for &i in inputs {
            let range = description.inputs[i].range;
            if !range.iter().all(|end| end.is_finite()) {
                return Err(Error::NotFinite { quantity: Quantity::Inputs, index: i });
            }
            let base = sampling::prime(self.moved.len());
            self.moved.push(Moved { what: What::Input(i), range, base });
        }
        Ok(self)
    }

    /// The row of what moves, among q, s, u.
    fn row(&self, what: What) -> usize {
        match what {
            What::Variable(i) => i,
            What::Input(i) => self.home.q.len() + self.home.s.len() + i,
        }
    }

    /// The streams of everything that is moved, for so many configurations: made side by side they do not wait
    /// for each other.
    fn streams(&self, seed: u64, block: usize) -> Vec<impl Rng> {
        let moved = self.moved.len();
        (0..moved).map(|which| stream(seed, block * moved + which)).collect()
    }
}

/// How many configurations take the numbers of a variable from one stream, one after the other.
pub(crate) const STREAM: usize = 64;

/// A random number within limits.
#[inline]
fn between([lower, upper]: [f64; 2], random: &mut impl Rng) -> f64 {
    lower + (upper - lower) * random.random::<f64>()
}
