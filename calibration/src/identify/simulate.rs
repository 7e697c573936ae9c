//! Simulated measurements of a machine with known errors, and the inverse kinematics of readings:
//! joints at which observables have given values.

use nalgebra::{DMatrix, DVector};
use rand::{Rng, RngExt};
use rand_distr::Normal;

use super::{Failure, Measurement, Model, Observation, Result, Unknown};
use abbe_analysis::{ErrorParts, sampling::stream};
use abbe_core::{Class, VariableKind, displacement};

/// Random contributions to simulated measurements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chance {
    /// Standard deviation of a coordinate, and of an angle of a pose.
    pub noise: super::Uncertainty,
    /// Share of rows that are outliers.
    pub outliers: f64,
    /// Largest deviation of an outlier in each coordinate; the length unit.
    pub outlier_size: f64,
    /// Draw the random sources of the spec anew in each row, and its tolerances.
    pub random_sources: bool,
    /// Draw each tolerance once; otherwise each row is of another machine.
    pub one_machine: bool,
    /// Seed of the random numbers.
    pub seed: u64,
}

/// Separates these random numbers from those of configurations drawn with the same seed.
const APART: u64 = 0x6d65_6173_7572_6564;

/// Simulates the measurements at the configurations of `list`, on the exact chain with the known
/// sources of `model`.
///
/// For instruments that are [touched](super::InstrumentKind::is_touched), the joints are solved so
/// that the real machine touches up to the uncertainty of the instrument; joints that are equal in
/// all rows stay fixed. The kind of measurement in `list` selects the targets, the pose or the
/// readings. Observation i depends on the seed and i alone.
pub fn simulate(model: &Model, list: &[Observation], chance: &Chance) -> Result<Vec<Observation>> {
    let mut simulated = Simulated::new(model, list, chance);
    list.iter().enumerate().map(|(i, planned)| simulated.row(i, planned)).collect()
}

/// Simulation of one row at a time, for long lists.
pub struct Simulated<'a> {
    model: Model<'a>,
    /// Random sources and tolerances, and their classes.
    random: Vec<(usize, Class)>,
    parts: ErrorParts,
    /// Joints that are not equal in all rows.
    moved: Vec<usize>,
    chance: Chance,
}

impl<'a> Simulated<'a> {
    /// Prepares the simulation of a list of rows.
    pub fn new(model: &Model<'a>, list: &[Observation], chance: &Chance) -> Self {
        let sources = model.manipulator.description().sources.iter().enumerate();
        let (unknowns, random) = sources
            .filter_map(|(i, source)| match source.class {
                Class::Tolerance(_) | Class::Random(_) if chance.random_sources => {
                    Some((Unknown::Magnitude(i), (i, source.class)))
                }
                _ => None,
            })
            .unzip();
        let parts = ErrorParts::new(model.manipulator.description());
        let model = model.with(unknowns);
        let first = list.first().map_or(&[][..], |row| &row.q);
        let moved = (0..first.len()).filter(|j| list.iter().any(|row| row.q[*j] != first[*j])).collect();
        Self { model, random, parts, moved, chance: *chance }
    }

    /// Simulates row `i`.
    pub fn row(&mut self, i: usize, planned: &Observation) -> Result<Observation> {
        let Self { model, random, parts, moved, chance } = self;
        let mut numbers = stream(chance.seed ^ APART, i);
        // One machine has one value of each tolerance.
        let mut machine = stream(chance.seed ^ APART, usize::MAX);
        let mut x = vec![1.0; random.len()];
        for (source, class) in random.iter() {
            let of_machine = chance.one_machine && matches!(class, Class::Tolerance(_));
            let numbers = if of_machine { &mut machine } else { &mut numbers };
            let Some(distribution) = class.distribution() else { continue };
            parts.draw(*source, distribution, numbers, |part, drawn| {
                if let Some(at) = random.iter().position(|(other, _)| *other == part) {
                    x[at] = drawn;
                }
            });
        }
        let planned = &touching(model, planned, &x, moved, chance, &mut numbers)?;
        let mut at = model.at(&x);
        let pose = at.pose(planned)?;
        let readings = at.values(planned)?;
        let is_outlier = numbers.random::<f64>() < chance.outliers;
        let mut wrong = || {
            if is_outlier { numbers.random_range(-chance.outlier_size..=chance.outlier_size) } else { 0.0 }
        };
        let shift = [wrong(), wrong(), wrong()];
        let mut noise = |sigma: f64| Normal::new(0.0, sigma).map_or(0.0, |normal| numbers.sample(normal));
        let measured = match &planned.measured {
            Measurement::Points(points) => {
                let own = &model.targets[model.targets_at(planned.station as usize)];
                let targets = points.iter().zip(own).enumerate().map(|(j, (point, target))| {
                    let at = pose.apply(*target);
                    // An outlier affects one target of its row.
                    let shift = if j == 0 { shift } else { [0.0; 3] };
                    let measured = core::array::from_fn(|k| at[k] + shift[k] + noise(chance.noise.length));
                    point.map(|_| measured)
                });
                Measurement::Points(targets.collect())
            }
            Measurement::Pose(_) => {
                let turn = [0; 3].map(|_| noise(chance.noise.angle));
                let mut noisy = pose.then(&displacement(&[0.0, 0.0, 0.0, turn[0], turn[1], turn[2]]));
                noisy.0[3] = core::array::from_fn(|k| pose.0[3][k] + shift[k] + noise(chance.noise.length));
                Measurement::Pose(Box::new(noisy))
            }
            Measurement::Readings(planned) => {
                let factor = chance.noise.length / model.uncertainty.length;
                let numbers = planned.iter().zip(&model.observables).zip(&readings).enumerate();
                let measured = numbers.map(|(i, ((planned, reading), value))| {
                    let far = if i == 0 && !reading.kind.is_angle { shift[0] } else { 0.0 };
                    let value = value + far + noise(reading.uncertainty * factor);
                    planned.map(|_| if reading.kind.is_touched() { 0.0 } else { value })
                });
                Measurement::Readings(measured.collect())
            }
        };
        Ok(Observation { measured, ..planned.clone() })
    }
}

/// Solves for the joints at which the real machine touches.
fn touching(
    model: &Model,
    planned: &Observation,
    x: &[f64],
    moved: &[usize],
    chance: &Chance,
    numbers: &mut impl Rng,
) -> Result<Observation> {
    let Measurement::Readings(readings) = &planned.measured else { return Ok(planned.clone()) };
    let factor = chance.noise.length / model.uncertainty.length;
    let mut noise = |sigma: f64| Normal::new(0.0, sigma).map_or(0.0, |normal| numbers.sample(normal));
    let wanted = readings.iter().zip(&model.observables).map(|(planned, reading)| {
        planned.filter(|_| reading.kind.is_touched()).map(|_| noise(reading.uncertainty * factor))
    });
    let wanted: Vec<Option<f64>> = wanted.collect();
    if wanted.iter().all(Option::is_none) {
        return Ok(planned.clone());
    }
    let q = joints_at_values(model, planned, x, &wanted, moved)?
        .ok_or(Failure::Untouched { line: planned.line })?;
    Ok(Observation { q: q.into(), ..planned.clone() })
}

/// Largest remaining difference, as a share of the arm or in rad.
const TOUCHED: f64 = 1e-11;

/// Solves for the joints at which each observable of the model has its wanted value; length unit,
/// rad.
///
/// Starts at the joints of an observation and changes those in `moved`, within their limits, by
/// Gauss-Newton steps of least norm. Returns none without convergence.
pub fn joints_at_values(
    model: &Model,
    observation: &Observation,
    x: &[f64],
    wanted: &[Option<f64>],
    moved: &[usize],
) -> Result<Option<Vec<f64>>> {
    let variables = &model.manipulator.description().variables;
    let arm = model.arm_length()?;
    let size = |j: &usize| if variables[*j].kind == VariableKind::Revolute { 1.0 } else { arm };
    let mut at = model.at(x);
    let mut place = observation.clone();
    let mut off = |place: &Observation| -> Result<DVector<f64>> {
        let values = at.values(place)?;
        let readings = values.iter().zip(wanted).zip(&model.observables);
        let off = readings.filter_map(|((value, wanted), reading)| {
            Some((value - (*wanted)?) / if reading.kind.is_angle { 1.0 } else { arm })
        });
        Ok(DVector::from_vec(off.collect()))
    };
    for _ in 0..60 {
        let here = off(&place)?;
        if here.amax() < TOUCHED {
            return Ok(Some(place.q.to_vec()));
        }
        let mut jacobian = DMatrix::zeros(here.len(), moved.len());
        for (column, j) in moved.iter().enumerate() {
            let mut near = place.clone();
            near.q[*j] += 1e-6 * size(j);
            jacobian.set_column(column, &((off(&near)? - &here) / 1e-6));
        }
        // Jᵀ (J Jᵀ + λ)⁻¹, with a small λ for singular configurations.
        let square = &jacobian * jacobian.transpose() + DMatrix::identity(here.len(), here.len()) * 1e-9;
        let Some(inverse) = square.cholesky() else { return Ok(None) };
        let step = -jacobian.transpose() * inverse.solve(&here);
        let share = (0.3 / step.norm().max(f64::MIN_POSITIVE)).min(1.0);
        for (j, by) in moved.iter().zip(step.iter()) {
            let [lower, upper] = variables[*j].limits;
            place.q[*j] = (place.q[*j] + share * by * size(j)).clamp(lower, upper);
        }
    }
    Ok(None)
}
