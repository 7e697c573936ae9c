//! Yield: the share of machines that keep a tolerance at all configurations.

use std::collections::{BTreeMap, BTreeSet};

use rand::{Rng, RngExt};
use rand_distr::StandardNormal;

use super::error_distribution::{ErrorDistribution, sum_of};
use super::errors_at::RandomError;
use crate::sweep::in_order;
use abbe_kinematics::sampling::{norm, stream};

/// Number of machines that are drawn.
const MACHINES: usize = 10_000;
/// Number of machines per stream of random numbers.
const BLOCK: usize = 256;
/// Number of draws of the random errors at a configuration, and of those that decide in most cases.
const DRAWS: usize = 20_000;
const FIRST: usize = 1000;
/// Distance of a share of the first draws from the required one, in standard deviations, at which
/// they decide.
const CLEAR: f64 = 5.0;
/// Largest number of configurations at which the random errors of one machine are drawn.
const CHECKED: usize = 4;
/// Quantile of the two-sided confidence interval of 95 %.
const TWO_SIDED_95: f64 = 1.959_963_984_540_054;

/// Share of the machines that keep their tolerances.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Yield {
    /// Number of machines drawn.
    pub machines: usize,
    /// Number of configurations at which they must keep the tolerances.
    pub configurations: usize,
    /// Share of them that keep all tolerances at all configurations.
    pub share: f64,
    /// Confidence interval of 95 % for the share of all machines.
    pub interval: [f64; 2],
}

/// Machines of which each has one value of every tolerance, and of every residual and error of its
/// calibration, at some configurations.
#[derive(Clone, Debug)]
pub struct Machines {
    probability: f64,
    places: Vec<Place>,
    /// Errors with one value in each machine by source; `None` for a sign.
    of_machine: BTreeMap<usize, Option<RandomError>>,
    /// Places of residuals of unknown direction: one after their source, 0 for all together.
    directed: BTreeSet<usize>,
}

/// Errors at a configuration that may exceed the tolerance.
#[derive(Clone, Debug)]
struct Place {
    limit: f64,
    error: ErrorDistribution,
    /// Errors that vary in one machine, and their largest sum.
    random: Vec<RandomError>,
    largest: f64,
}

/// Values of one machine: multiples of its unknown errors by source, and directions by place.
struct Machine {
    values: Vec<[f64; 3]>,
    directions: Vec<[f64; 3]>,
}

impl Machines {
    /// Creates machines that must keep their tolerances with a probability, at no configurations.
    pub fn new(probability: f64) -> Self {
        Self { probability, places: Vec::new(), of_machine: BTreeMap::new(), directed: BTreeSet::new() }
    }

    /// Adds a configuration: its errors and their largest permitted norm.
    pub fn add(&mut self, error: ErrorDistribution, limit: f64) {
        if error.is_bounded() && error.simple_bound() <= limit {
            return;
        }
        let (of_machine, random): (Vec<RandomError>, Vec<_>) =
            error.random.iter().copied().partition(|one| one.is_of_machine);
        self.of_machine.extend(of_machine.into_iter().map(|one| (one.source, Some(one))));
        self.of_machine.extend(error.signed.iter().map(|(source, _)| (*source, None)));
        self.directed.extend(error.undirected.iter().map(|(source, _)| place_of(*source)));
        let bounded = random.iter().all(|one| one.distribution.is_bounded());
        let largest = if bounded { random.iter().map(RandomError::bound).sum() } else { f64::INFINITY };
        self.places.push(Place { limit, error, random, largest });
    }

    /// Returns the share of the machines that keep the tolerance with the required probability at
    /// each of the configurations that were added. The draws depend on the seed alone.
    pub fn yielded(&self, configurations: usize, seed: u64) -> Yield {
        let mut open = Vec::with_capacity(MACHINES);
        let Ok(()) = in_order(
            MACHINES.div_ceil(BLOCK),
            |block| {
                let mut numbers = stream(seed, block);
                let machines = block * BLOCK..MACHINES.min((block + 1) * BLOCK);
                let open = machines.map(|_| self.open(&self.draw(&mut numbers)));
                Ok::<_, core::convert::Infallible>(open.collect::<Vec<_>>())
            },
            |more| open.extend(more),
        );
        let drawn: BTreeSet<usize> = open.iter().flatten().flatten().map(|(place, _)| *place).collect();
        let drawn: BTreeMap<usize, Vec<[f64; 3]>> =
            drawn.into_iter().map(|place| (place, self.places[place].drawn(seed))).collect();
        let keeps = |(place, fixed): &(usize, [f64; 3])| {
            let limit = self.places[*place].limit;
            let within = |draws: &[[f64; 3]]| {
                let within = |random: &&[f64; 3]| norm(sum_of(*fixed, [**random])) <= limit;
                draws.iter().filter(within).count() as f64 / draws.len() as f64 - self.probability
            };
            let deviation = (self.probability * (1.0 - self.probability) / FIRST as f64).sqrt();
            let first = within(&drawn[place][..FIRST]);
            (if first.abs() > CLEAR * deviation { first } else { within(&drawn[place]) }) >= 0.0
        };
        let kept = open.iter().flatten().filter(|open| open.iter().all(keeps)).count();
        // The score interval of Wilson.
        let (count, share) = (MACHINES as f64, kept as f64 / MACHINES as f64);
        let square = TWO_SIDED_95 * TWO_SIDED_95 / count;
        let middle = (share + square / 2.0) / (1.0 + square);
        let half = (square * share * (1.0 - share) + square * square / 4.0).sqrt() / (1.0 + square);
        let interval = [(middle - half).max(0.0), (middle + half).min(1.0)];
        Yield { machines: MACHINES, configurations, share, interval }
    }

    /// Draws the values of a machine.
    fn draw(&self, numbers: &mut impl Rng) -> Machine {
        let count = |largest: Option<&usize>| largest.map_or(0, |largest| largest + 1);
        let mut values = vec![[0.0; 3]; count(self.of_machine.keys().last())];
        for (source, one) in &self.of_machine {
            values[*source] = match one {
                Some(one) => one.draw(numbers),
                None if numbers.random::<bool>() => [1.0; 3],
                None => [-1.0; 3],
            };
        }
        let mut directions = vec![[0.0; 3]; count(self.directed.last())];
        for place in &self.directed {
            let direction: [f64; 3] = core::array::from_fn(|_| numbers.sample(StandardNormal));
            directions[*place] = direction.map(|row| row / norm(direction));
        }
        Machine { values, directions }
    }

    /// Returns the configurations at which draws must decide about a machine, those most likely to
    /// exceed the tolerance, each with the fixed error there; `None` if one certainly exceeds it.
    fn open(&self, machine: &Machine) -> Option<Vec<(usize, [f64; 3])>> {
        let mut open: Vec<(f64, usize, [f64; 3])> = Vec::new();
        for (index, place) in self.places.iter().enumerate() {
            let fixed = place.fixed(machine);
            let error = norm(fixed);
            // Errors with a symmetric distribution are as often on either side of a plane.
            if error > place.limit && (self.probability > 0.5 || place.random.is_empty()) {
                return None;
            }
            if error + place.largest > place.limit {
                let [_, deviations] =
                    ErrorDistribution::new(fixed, place.random.clone()).approximate(place.limit);
                open.push((deviations, index, fixed));
            }
        }
        open.sort_by(|a, b| a.0.total_cmp(&b.0));
        open.truncate(CHECKED);
        Some(open.into_iter().map(|(_, index, fixed)| (index, fixed)).collect())
    }
}

impl Place {
    /// Returns the fixed error of a machine.
    fn fixed(&self, machine: &Machine) -> [f64; 3] {
        let of_machine = self.error.random.iter().filter(|one| one.is_of_machine);
        let values = of_machine.map(|one| one.at(machine.values[one.source]));
        let signed = self.error.signed.iter();
        let values = values.chain(signed.map(|(source, v)| v.map(|row| machine.values[*source][0] * row)));
        let directions = self.error.undirected.iter();
        let directions =
            directions.map(|(source, length)| machine.directions[place_of(*source)].map(|row| length * row));
        sum_of(self.error.bias, values.chain(directions))
    }

    /// Draws the errors that vary in one machine.
    fn drawn(&self, seed: u64) -> Vec<[f64; 3]> {
        let mut numbers = stream(seed, usize::MAX);
        let draw = |_| {
            let random = self.random.iter().map(|one| one.at(one.draw(&mut numbers)));
            sum_of([0.0; 3], random)
        };
        (0..DRAWS).map(draw).collect()
    }
}

fn place_of(source: Option<usize>) -> usize {
    source.map_or(0, |source| source + 1)
}
