//! Samples of joint variables and inputs, quasi-random or random.

use core::ops::Range;

use rand::{Rng, RngExt};

use super::Workspace;
use crate::Configuration;
use crate::ReachError;
use crate::configuration::in_range;
use crate::sampling::{self, RadicalInverses, stream};
use abbe_core::lanes::{Kernel, Register, Tiles};
use abbe_core::{Error, Manipulator, Quantity};

/// Source of the sample values.
#[derive(Clone, Copy, Debug)]
enum Spread {
    /// Halton sequence.
    Even,
    /// Random numbers: one stream per sampled quantity and [`STREAM`] configurations.
    Random { seed: u64 },
}

/// Workspace of samples of some variables and inputs; see [`joint_samples`] and
/// [`random_joint_samples`].
#[derive(Clone, Debug)]
pub struct JointSamples {
    home: Configuration,
    moved: Vec<SampledQuantity>,
    count: usize,
    spread: Spread,
}

/// Sampled quantity.
#[derive(Clone, Debug)]
struct SampledQuantity {
    coordinate: Coordinate,
    range: [f64; 2],
    /// Terms of the Halton sequence in its dimension.
    shares: RadicalInverses,
}

/// Variable or input, by its index.
#[derive(Clone, Copy, Debug)]
enum Coordinate {
    Variable(usize),
    Input(usize),
}

/// Creates a workspace of `count` samples of the joints in `moved`, spread evenly within their
/// limits. The other joints stay at home.
///
/// Parameters and inputs are nominal; [`JointSamples::inputs`] varies the inputs. Returns
/// [`Error::Count`] if `moved` contains an invalid index.
pub fn joint_samples(
    manipulator: &dyn Manipulator,
    moved: &[usize],
    count: usize,
) -> Result<JointSamples, Error> {
    samples(manipulator, moved, count, Spread::Even)
}

/// Creates a workspace of random samples, otherwise as [`joint_samples`]. Configuration `i` depends
/// on the seed and `i` alone.
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
    let moved = moved.iter().enumerate().map(|(dimension, &i)| SampledQuantity {
        coordinate: Coordinate::Variable(i),
        range: sampling::joint_range(&description.variables[i], arm),
        shares: RadicalInverses::new(sampling::prime(dimension)),
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
                for SampledQuantity { coordinate, range: [lower, upper], shares } in &self.moved {
                    let mut share = [0.0];
                    shares.fill(index + 1, &mut share);
                    *coordinate.value(configuration) = lower + (upper - lower) * share[0];
                }
            }
            Spread::Random { seed } => {
                for (random, moved) in self.streams(seed, index / STREAM).iter_mut().zip(&self.moved) {
                    (0..index % STREAM).for_each(|_| _ = random.next_u64());
                    *moved.coordinate.value(configuration) = between(moved.range, random);
                }
            }
        }
        Ok(())
    }

    fn fill_rows(&self, range: Range<usize>, rows: &mut Tiles) -> bool {
        let moved = self.moved.iter().map(|moved| self.row(moved.coordinate)).collect::<Vec<_>>();
        match self.spread {
            Spread::Even => {
                let set = rows.instruction_set();
                set.run(Even { moved: &self.moved, chosen: &moved, first: range.start + 1, rows });
            }
            Spread::Random { .. } if !range.start.is_multiple_of(STREAM) => return false,
            Spread::Random { seed } => {
                for first in range.clone().step_by(STREAM) {
                    let mut streams = self.streams(seed, first / STREAM);
                    let count = STREAM.min(range.end - first);
                    rows.set_each(&moved, first - range.start, count, |which| {
                        between(self.moved[which].range, &mut streams[which])
                    });
                }
            }
        }
        true
    }
}

impl Coordinate {
    /// Returns its value in a configuration.
    fn value(self, configuration: &mut Configuration) -> &mut f64 {
        match self {
            Self::Variable(i) => &mut configuration.q[i],
            Self::Input(i) => &mut configuration.u[i],
        }
    }
}

impl JointSamples {
    /// Samples these inputs too, each within its range.
    ///
    /// Returns [`Error::Count`] if there is no such input, [`Error::NotFinite`] if its range is
    /// unbounded.
    pub fn inputs(mut self, manipulator: &dyn Manipulator, inputs: &[usize]) -> Result<Self, Error> {
        let description = manipulator.description();
        in_range(inputs.iter().copied(), Quantity::Inputs, description.inputs.len())?;
        for &i in inputs {
            let range = description.inputs[i].range;
            if !range.iter().all(|end| end.is_finite()) {
                return Err(Error::NotFinite { quantity: Quantity::Inputs, index: i });
            }
            let shares = RadicalInverses::new(sampling::prime(self.moved.len()));
            self.moved.push(SampledQuantity { coordinate: Coordinate::Input(i), range, shares });
        }
        Ok(self)
    }

    /// Returns the row of a sampled quantity among q, s, u.
    fn row(&self, coordinate: Coordinate) -> usize {
        match coordinate {
            Coordinate::Variable(i) => i,
            Coordinate::Input(i) => self.home.q.len() + self.home.s.len() + i,
        }
    }

    /// Returns the streams of all sampled quantities for a block. Interleaving them hides the
    /// latency of the generators.
    fn streams(&self, seed: u64, block: usize) -> Vec<impl Rng> {
        let moved = self.moved.len();
        (0..moved).map(|which| stream(seed, block * moved + which)).collect()
    }
}

/// Writes terms of the Halton sequence to rows, from number `first` on.
struct Even<'a> {
    moved: &'a [SampledQuantity],
    /// Row of each quantity.
    chosen: &'a [usize],
    first: usize,
    rows: &'a mut Tiles,
}

impl Kernel for Even<'_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Register>(self) {
        let mut values = [0.0; STREAM];
        for (SampledQuantity { range: [lower, upper], shares, .. }, row) in self.moved.iter().zip(self.chosen)
        {
            for first in (0..self.rows.count()).step_by(STREAM) {
                let values = &mut values[..STREAM.min(self.rows.count() - first)];
                shares.fill(self.first + first, values);
                values.iter_mut().for_each(|value| *value = lower + (upper - lower) * *value);
                self.rows.set_row(*row, first, values);
            }
        }
    }
}

/// Number of configurations whose values of a variable come from one stream.
pub const STREAM: usize = 64;

/// Returns a random number within limits.
#[inline]
fn between([lower, upper]: [f64; 2], random: &mut impl Rng) -> f64 {
    lower + (upper - lower) * random.random::<f64>()
}
