//! Measurements of a machine whose errors are known: for tests, for teaching, for planning.

use rand::{Rng, RngExt};
use rand_distr::Normal;

use super::{Failure, Measurement, Model, Observation, Room, Unknown, touched};
use abbe_analysis::sampling::{draw, stream};
use abbe_core::displacement;
use abbe_core::{Class, Distribution};

/// What an instrument and chance add to the errors of the machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chance {
    /// One standard deviation of a coordinate, and of an angle of a pose.
    pub noise: super::Uncertainty,
    /// Which share of the rows is grossly wrong.
    pub outliers: f64,
    /// By how much: up to this in each coordinate.
    pub gross: f64,
    /// Whether the random sources of the spec are drawn, anew in every row.
    pub random_sources: bool,
    /// Where the random numbers begin.
    pub seed: u64,
}

/// Keeps these numbers apart from those of configurations that were drawn from the same seed.
const APART: u64 = 0x6d65_6173_7572_6564;

/// What would be seen at the configurations of `list`, on the exact chain with the known sources of `model`.
///
/// Where readings are [touched](super::Reading::touched), the joints are those at which the real machine touches, by as much as
/// the instrument's uncertainty off; joints that are the same in all rows stay.
///
/// Observation i follows from the seed and i alone. What was measured says which targets are seen, or that poses are.
pub fn simulate(model: &Model, list: &[Observation], chance: &Chance) -> Result<Vec<Observation>, Failure> {
    let mut simulated = Simulated::new(model, list, chance);
    list.iter().enumerate().map(|(i, asked)| simulated.row(i, asked)).collect()
}

/// The same row by row: for lists that are too long to be there twice.
pub struct Simulated<'a> {
    model: Model<'a>,
    /// The random sources that are drawn.
    random: Vec<Distribution>,
    /// The joints that are not the same in all rows.
    moved: Vec<usize>,
    chance: Chance,
    room: Room,
}

impl<'a> Simulated<'a> {
    /// Of these rows, and no others.
    pub fn new(model: &Model<'a>, list: &[Observation], chance: &Chance) -> Self {
        let sources = model.manipulator.description().sources.iter().enumerate();
        let (unknowns, random) = sources
            .filter_map(|(i, source)| match source.class {
                Class::Random(distribution) if chance.random_sources => {
                    Some((Unknown::Magnitude(i), distribution))
                }
                _ => None,
            })
            .unzip();
        let model = model.with(unknowns);
        let first = list.first().map_or(&[][..], |row| &row.q);
        let moved = (0..first.len()).filter(|j| list.iter().any(|row| row.q[*j] != first[*j])).collect();
        Self { room: model.room(), model, random, moved, chance: *chance }
    }

    /// What would be seen at row `i` of them.
    pub fn row(&mut self, i: usize, asked: &Observation) -> Result<Observation, Failure> {
        let Self { model, random, moved, chance, room } = self;
        let mut numbers = stream(chance.seed ^ APART, i);
        let x: Vec<f64> = random.iter().map(|distribution| draw(*distribution, &mut numbers)).collect();
        let asked = &touching(model, asked, &x, moved, chance, &mut numbers)?;
        let pose = model.pose(room, asked, &x)?;
        let readings = model.values(room, asked, &x)?;
        let gross = numbers.random::<f64>() < chance.outliers;
        let mut wrong = || if gross { numbers.random_range(-chance.gross..=chance.gross) } else { 0.0 };
        let shift = [wrong(), wrong(), wrong()];
        let mut noise = |sigma: f64| Normal::new(0.0, sigma).map_or(0.0, |normal| numbers.sample(normal));
        let measured = match &asked.measured {
            Measurement::Points(points) => {
                let targets = points.iter().zip(&model.targets).enumerate().map(|(j, (point, target))| {
                    let at = pose.apply(*target);
                    // One target of a row is taken for another thing.
                    let shift = if j == 0 { shift } else { [0.0; 3] };
                    let measured = core::array::from_fn(|k| at[k] + shift[k] + noise(chance.noise.length));
                    point.map(|_| measured)
                });
                Measurement::Points(targets.collect())
            }
            Measurement::Pose(_) => {
                let turn = [0; 3].map(|_| noise(chance.noise.angle));
                let mut seen = pose.then(&displacement(&[0.0, 0.0, 0.0, turn[0], turn[1], turn[2]]));
                seen.0[3] = core::array::from_fn(|k| pose.0[3][k] + shift[k] + noise(chance.noise.length));
                Measurement::Pose(Box::new(seen))
            }
            Measurement::Readings(asked) => {
                let factor = chance.noise.length / model.uncertainty.length;
                let numbers = asked.iter().zip(&model.readings).zip(&readings).enumerate();
                let measured = numbers.map(|(i, ((asked, reading), value))| {
                    let far = if i == 0 && !reading.gauge.is_angle() { shift[0] } else { 0.0 };
                    let value = value + far + noise(reading.uncertainty * factor);
                    asked.map(|_| if reading.touched { 0.0 } else { value })
                });
                Measurement::Readings(measured.collect())
            }
        };
        Ok(Observation { measured, ..asked.clone() })
    }
}

/// The same observation, where the real machine touches what it is to touch.
fn touching(
    model: &Model,
    asked: &Observation,
    x: &[f64],
    moved: &[usize],
    chance: &Chance,
    numbers: &mut impl Rng,
) -> Result<Observation, Failure> {
    let Measurement::Readings(readings) = &asked.measured else { return Ok(asked.clone()) };
    let factor = chance.noise.length / model.uncertainty.length;
    let mut noise = |sigma: f64| Normal::new(0.0, sigma).map_or(0.0, |normal| numbers.sample(normal));
    let wanted = readings.iter().zip(&model.readings).map(|(asked, reading)| {
        asked.filter(|_| reading.touched).map(|_| noise(reading.uncertainty * factor))
    });
    let wanted: Vec<Option<f64>> = wanted.collect();
    if wanted.iter().all(Option::is_none) {
        return Ok(asked.clone());
    }
    let q = touched(model, asked, x, &wanted, moved)?.ok_or(Failure::Untouched { line: asked.line })?;
    Ok(Observation { q: q.into(), ..asked.clone() })
}
