//! Samples of joint variables and inputs, quasi-random or random.

use core::ops::Range;

use rand::{Rng, RngExt};

use super::Workspace;
use crate::configuration::in_range;
use crate::sampling::{self, RadicalInverses, stream};
use crate::{Configuration, ReachError, SumLimits};
use abbe_core::lanes::{Kernel, Register, Tiles};
use abbe_core::{Error, List, Manipulator, Quantity};

/// Workspace of samples of some variables and inputs; see [`joint_samples`] and
/// [`random_joint_samples`].
#[derive(Clone, Debug)]
pub struct JointSamples {
    home: Configuration,
    moved: Vec<SampledQuantity>,
    count: usize,
    /// Seed of random samples, with one stream per sampled quantity and [`STREAM`] configurations;
    /// `None` for a Halton sequence.
    seed: Option<u64>,
    sums: SumLimits,
}

/// Sampled quantity.
#[derive(Clone, Debug)]
struct SampledQuantity {
    coordinate: Coordinate,
    range: [f64; 2],
    /// Values that an input has; empty for any in the range.
    levels: List<f64>,
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
/// A sample outside the limits of a sum of joints is replaced by a random one within them, and a
/// joint follows where a sum is fixed. Parameters and inputs are nominal;
/// [`JointSamples::inputs`] varies the inputs. Returns
/// [`Error::Count`] if `moved` contains an invalid index.
pub fn joint_samples(
    manipulator: &dyn Manipulator,
    moved: &[usize],
    count: usize,
) -> Result<JointSamples, Error> {
    samples(manipulator, moved, count, None)
}

/// Creates a workspace of random samples, otherwise as [`joint_samples`]. Configuration `i` depends
/// on the seed and `i` alone.
pub fn random_joint_samples(
    manipulator: &dyn Manipulator,
    moved: &[usize],
    count: usize,
    seed: u64,
) -> Result<JointSamples, Error> {
    samples(manipulator, moved, count, Some(seed))
}

fn samples(
    manipulator: &dyn Manipulator,
    moved: &[usize],
    count: usize,
    seed: Option<u64>,
) -> Result<JointSamples, Error> {
    let description = manipulator.description();
    in_range(moved.iter().copied(), Quantity::Variables, description.variables.len())?;
    let home = Configuration::home(description);
    let arm = sampling::arm_length(manipulator, &home.s)?;
    let sampled = moved.iter().enumerate().map(|(dimension, &i)| SampledQuantity {
        coordinate: Coordinate::Variable(i),
        range: sampling::joint_range(&description.variables[i], arm),
        levels: List::Constant(&[]),
        shares: RadicalInverses::new(sampling::prime(dimension)),
    });
    let held = (0..description.variables.len()).rev().filter(|i| !moved.contains(i));
    let order: Vec<usize> = held.chain(moved.iter().rev().copied()).collect();
    let sums = SumLimits::new(description, &order);
    let moved = sampled.collect();
    Ok(JointSamples { home, moved, count, seed, sums })
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
        match self.seed {
            None => {
                for moved in &self.moved {
                    let mut share = [0.0];
                    moved.shares.fill(index + 1, &mut share);
                    *moved.coordinate.value(configuration) = moved.at(share[0]);
                }
            }
            Some(seed) => {
                for (random, moved) in self.streams(seed, index / STREAM).iter_mut().zip(&self.moved) {
                    (0..index % STREAM).for_each(|_| _ = random.next_u64());
                    *moved.coordinate.value(configuration) = moved.at(random.random());
                }
            }
        }
        self.permitted(index, configuration)
    }

    fn fill_rows(&self, range: Range<usize>, rows: &mut Tiles) -> bool {
        if !self.sums.is_empty() {
            return false;
        }
        let moved = self.moved.iter().map(|moved| self.row(moved.coordinate)).collect::<Vec<_>>();
        match self.seed {
            None => {
                let set = rows.instruction_set();
                set.run(Even { moved: &self.moved, chosen: &moved, first: range.start + 1, rows });
            }
            Some(_) if !range.start.is_multiple_of(STREAM) => return false,
            Some(seed) => {
                for first in range.clone().step_by(STREAM) {
                    let mut streams = self.streams(seed, first / STREAM);
                    let count = STREAM.min(range.end - first);
                    rows.set_each(&moved, first - range.start, count, |which| {
                        self.moved[which].at(streams[which].random())
                    });
                }
            }
        }
        true
    }
}

impl SampledQuantity {
    /// Returns the value at a share of the range from 0 to 1, or of the levels.
    #[inline(always)]
    fn at(&self, share: f64) -> f64 {
        let [lower, upper] = self.range;
        match self.levels.len() {
            0 => lower + (upper - lower) * share,
            count => self.levels[((share * count as f64) as usize).min(count - 1)],
        }
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
    /// Samples these inputs too, each within its range, or at one of its levels.
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
            let (coordinate, levels) = (Coordinate::Input(i), description.inputs[i].levels.clone());
            self.moved.push(SampledQuantity { coordinate, range, levels, shares });
        }
        Ok(self)
    }

    /// Moves a sample within the limits of sums: draws it anew where it is outside.
    fn permitted(&self, index: usize, configuration: &mut Configuration) -> Result<(), ReachError> {
        if self.sums.is_empty() {
            return Ok(());
        }
        let mut random = stream(!self.seed.unwrap_or(0), index);
        for _ in 0..REDRAWN {
            self.sums.lead(&mut configuration.q);
            if self.sums.check(&configuration.q).is_ok() {
                break;
            }
            for moved in &self.moved {
                *moved.coordinate.value(configuration) = moved.at(random.random());
            }
        }
        self.sums.lead(&mut configuration.q);
        self.sums.check(&configuration.q)
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
        for (moved, row) in self.moved.iter().zip(self.chosen) {
            let [lower, upper] = moved.range;
            for first in (0..self.rows.count()).step_by(STREAM) {
                let values = &mut values[..STREAM.min(self.rows.count() - first)];
                moved.shares.fill(self.first + first, values);
                match moved.levels.is_empty() {
                    true => values.iter_mut().for_each(|value| *value = lower + (upper - lower) * *value),
                    false => values.iter_mut().for_each(|value| *value = moved.at(*value)),
                }
                self.rows.set_row(*row, first, values);
            }
        }
    }
}

/// Largest number of draws until a sample is within the limits of sums.
const REDRAWN: usize = 1000;

/// Number of configurations whose values of a variable come from one stream.
pub const STREAM: usize = 64;
