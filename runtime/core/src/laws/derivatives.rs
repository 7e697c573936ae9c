//! Jacobians equal central differences of the exact chain.
//!
//! Numerical differentiation, to verify analytic derivatives.

#[cfg(test)]
mod tests;

use super::{Discrepancy, Failure, Sample, Subject};
use crate::chain::displacement;
use crate::{Component, Description, Error, Manipulator, Pose, deviation, drawn_pose, tool_pose};

/// First step of the differences, in rad or arm lengths.
const STEP: f64 = 0.1;

/// First step of a second try, made where the long step finds another derivative. A function with
/// kinks, such as a table, has kinks that long steps skip. A wrong Jacobian disagrees with short
/// steps too.
const SHORT_STEP: f64 = 3e-5;

/// Size of a Jacobian, relative to the arm length, that is rounding errors only.
const NOISE: f64 = 1e-11;

/// Relative difference from which on short steps are tried.
const DIFFERENT: f64 = 1e-9;

/// Largest number of derivatives taken of a Jacobian by joints or parameters. Larger Jacobians are
/// compared along this many sums of columns.
const DIRECTIONS: usize = 60;

/// Compares `J_e` with `∂(X_real − X_ideal)/∂ε`: central differences of equation (6) with exact
/// rotations. Machines with loops, each evaluation of which closes them, are compared along
/// directions as in [`joint_jacobian`].
pub fn error_jacobian(manipulator: &dyn Manipulator, samples: usize) -> Result<Discrepancy, Failure> {
    let description = manipulator.description();
    let count = 6 * description.frames.len();
    let has_loops = description.has_loops();
    compare(manipulator, samples, count, |subject, sample, at, columns| {
        manipulator.error_jacobian(&at.given.q, &at.given.s, columns)?;
        let units = Component::ALL.map(|component| if component.is_rotation() { 1.0 } else { subject.arm });
        if has_loops {
            let units: Vec<f64> = units.into_iter().cycle().take(count).collect();
            let directions = directions(units.into_iter(), sample);
            return Ok(along(subject, &directions, at, columns, &vec![0.0; count], |errors| {
                subject.displaced_pose(at, errors.as_chunks().0).ok()
            }));
        }
        let factors = factors(description, &at.transforms);
        let mut expected = Vec::with_capacity(columns.len());
        for (frame, columns) in columns.chunks_exact(6).enumerate() {
            for ((component, unit), column) in Component::ALL.into_iter().zip(units).zip(columns) {
                let real = |step: f64| {
                    let mut errors = [0.0; 6];
                    errors[component.index()] = step * unit;
                    let moved = |[before, after]: [Pose; 2]| before.then(&displacement(&errors)).then(&after);
                    Some(factors[frame].map_or(at.pose, moved))
                };
                let found = column.map(|entry| entry * unit);
                expected.push((found, differences(subject, at, found, real)));
            }
        }
        Ok(expected)
    })
}

/// Returns both factors of equation (6) with one error and without loops, `F E_i R`, for every
/// frame that carries the tool: its pose F in `F_0`, and the pose R of the tool in it.
fn factors(description: &Description, transforms: &[Pose]) -> Vec<Option<[Pose; 2]>> {
    let mut factors = vec![None; description.frames.len()];
    let frames = core::iter::successors(description.tool_frame(), |frame| description.parent(*frame));
    let mut path: Vec<usize> = frames.collect();
    let mut after = transforms.last().copied().unwrap_or(Pose::IDENTITY);
    for frame in &path {
        factors[*frame] = Some([Pose::IDENTITY, after]);
        after = transforms[*frame].then(&after);
    }
    path.reverse();
    let mut before = Pose::IDENTITY;
    for frame in path {
        before = before.then(&transforms[frame]);
        factors[frame] = factors[frame].map(|[_, after]| [before, after]);
    }
    factors
}

/// Compares `J_q` with `∂X_T/∂q`: central differences of the product of the transforms.
///
/// With more than 60 joints, differences are taken along 60 directions that move several joints at
/// once. At each configuration every joint belongs to one direction.
pub fn joint_jacobian(manipulator: &dyn Manipulator, samples: usize) -> Result<Discrepancy, Failure> {
    let description = manipulator.description();
    compare(manipulator, samples, description.variables.len(), |subject, sample, at, columns| {
        manipulator.joint_jacobian(&at.given.q, &at.given.s, columns)?;
        let units = description.variables.iter().map(|variable| variable.kind.either(1.0, subject.arm));
        let tool = |transforms: Vec<Pose>| tool_pose(description, &transforms, &[]);
        Ok(along(subject, &directions(units, sample), at, columns, &at.given.q, |q| {
            subject.transforms(q, &at.given.s).ok().map(tool)
        }))
    })
}

/// Compares `∂X_T/∂s` with central differences of the product of the transforms. More than 60
/// parameters are treated as in [`joint_jacobian`].
pub fn parameter_jacobian(manipulator: &dyn Manipulator, samples: usize) -> Result<Discrepancy, Failure> {
    let description = manipulator.description();
    compare(manipulator, samples, description.parameters.len(), |subject, sample, at, columns| {
        manipulator.parameter_jacobian(&at.given.q, &at.given.s, columns)?;
        let units = description
            .parameters
            .iter()
            .map(|parameter| if parameter.unit == description.length.symbol() { subject.arm } else { 1.0 });
        let tool = |transforms: Vec<Pose>| tool_pose(description, &transforms, &[]);
        Ok(along(subject, &directions(units, sample), at, columns, &at.given.s, |s| {
            subject.transforms(&at.given.q, s).ok().map(tool)
        }))
    })
}

/// Compares the column `ΔX = J_e ε` of every source with the derivative of the exact chain by the
/// source's magnitude.
pub fn source_displacements(manipulator: &dyn Manipulator, samples: usize) -> Result<Discrepancy, Failure> {
    let description = manipulator.description();
    let sources = description.sources.len();
    compare(manipulator, samples, sources, |subject, _, at, columns| {
        let mut by_error = vec![[0.0; 6]; 6 * description.frames.len()];
        let mut effects = vec![0.0; description.effects.len()];
        manipulator.error_jacobian(&at.given.q, &at.given.s, &mut by_error)?;
        manipulator.effects(&at.given.q, &at.given.s, &at.given.u, &mut effects)?;
        columns.fill([0.0; 6]);
        // The largest error of each source, in rad or arm lengths; its inverse scales the steps to
        // order 1.
        let mut sizes = vec![0.0_f64; sources];
        for (effect, value) in description.effects.iter().zip(effects) {
            let unit = if effect.component.is_rotation() { 1.0 } else { subject.arm };
            sizes[effect.source] = sizes[effect.source].max(value.abs() / unit);
            let column = by_error[6 * effect.frame + effect.component.index()];
            for (sum, entry) in columns[effect.source].iter_mut().zip(column) {
                *sum += entry * value;
            }
        }
        let expected = sizes.iter().enumerate().map(|(source, size)| {
            let unit = if *size > 0.0 { 1.0 / size } else { 1.0 };
            let real = |step: f64| {
                let mut magnitudes = vec![0.0; sources];
                magnitudes[source] = step * unit;
                drawn_pose(manipulator, &at.given.q, &at.given.s, &at.given.u, &magnitudes).ok()
            };
            let found = columns[source].map(|entry| entry * unit);
            (found, differences(subject, at, found, real))
        });
        Ok(expected.collect())
    })
}

/// Direction in which several values change together: index and weight of each.
struct Direction(Vec<(usize, f64)>);

impl Direction {
    /// Returns the values after a step in this direction.
    fn from(&self, values: &[f64], step: f64) -> Vec<f64> {
        let mut moved = values.to_vec();
        self.0.iter().for_each(|(i, share)| moved[*i] += step * share);
        moved
    }

    /// Returns the derivative in this direction from the partial derivatives `columns`.
    fn sum(&self, columns: &[[f64; 6]]) -> [f64; 6] {
        let mut sum = [0.0; 6];
        for (i, share) in &self.0 {
            sum.iter_mut().zip(columns[*i]).for_each(|(sum, entry)| *sum += share * entry);
        }
        sum
    }
}

/// Returns one direction per value, scaled by its unit. More than [`DIRECTIONS`] values are
/// grouped, differently in each sample, so that each value is in one direction. No step is longer
/// than that of a single value.
fn directions(units: impl ExactSizeIterator<Item = f64>, sample: usize) -> Vec<Direction> {
    let count = units.len().min(DIRECTIONS);
    let together = units.len().div_ceil(count.max(1)) as f64;
    let mut directions: Vec<Direction> = (0..count).map(|_| Direction(Vec::new())).collect();
    for (i, unit) in units.enumerate() {
        let round = i / count;
        let sign = if (round * (sample + 1) + i).is_multiple_of(2) { 1.0 } else { -1.0 };
        let sign = if round == 0 { 1.0 } else { sign };
        directions[(i + round * sample) % count].0.push((i, sign * unit / together.sqrt()));
    }
    directions
}

/// Returns the derivatives of a pose from `values` on along directions.
fn along(
    subject: &Subject,
    directions: &[Direction],
    at: &Sample,
    columns: &[[f64; 6]],
    values: &[f64],
    pose: impl Fn(&[f64]) -> Option<Pose>,
) -> Expected {
    let derivatives = directions.iter().map(|direction| {
        let found = direction.sum(columns);
        (found, differences(subject, at, found, |step| pose(&direction.from(values, step))))
    });
    derivatives.collect()
}

/// Returns the derivative of a pose, lengths in arm lengths. If long and short steps disagree,
/// returns the derivative nearer to `column`.
fn differences(
    subject: &Subject,
    at: &Sample,
    column: [f64; 6],
    pose: impl Fn(f64) -> Option<Pose>,
) -> Option<[f64; 6]> {
    let orientation = subject.manipulator.description().orientation;
    let by = |step: f64| {
        derivative(step * at.margin, |step| {
            pose(step).map(|pose| subject.scaled(deviation(orientation, &at.pose, &pose)))
        })
    };
    let column = subject.scaled(column);
    let distance =
        |found: &[f64; 6]| column.iter().zip(found).fold(0.0, |most, (a, b)| larger(most, (a - b).abs()));
    let long = by(STEP);
    let size = column.iter().fold(0.0, |size: f64, entry| size.max(entry.abs()));
    match long {
        Some(found) if distance(&found) <= DIFFERENT * size => long,
        _ => match (long, by(SHORT_STEP)) {
            (Some(long), Some(short)) if distance(&long) < distance(&short) => Some(long),
            (long, short) => short.or(long),
        },
    }
}

/// Derivatives from the Jacobian, and by differences where those exist.
type Expected = Vec<([f64; 6], Option<[f64; 6]>)>;

/// Compares the pairs of derivatives that `evaluate` returns at each sample. `evaluate` receives
/// `count` columns as scratch space.
fn compare(
    manipulator: &dyn Manipulator,
    samples: usize,
    count: usize,
    evaluate: impl Fn(&Subject, usize, &Sample, &mut [[f64; 6]]) -> Result<Expected, Error>,
) -> Result<Discrepancy, Failure> {
    let subject = Subject::new(manipulator)?;
    let (samples, skipped) = subject.samples(samples)?;
    let mut discrepancy = Discrepancy { compared: samples.len(), skipped, ..Discrepancy::default() };
    let mut columns = vec![[0.0; 6]; count];
    for (sample, at) in samples.iter().enumerate() {
        let compared = evaluate(&subject, sample, at, &mut columns)
            .map_err(|error| Failure::Evaluation { at: at.given.clone(), error })?;
        let (mut difference, mut largest) = (0.0, 0.0);
        for (found, expected) in compared {
            let expected = expected.unwrap_or([f64::NAN; 6]);
            for (found, expected) in subject.scaled(found).iter().zip(expected) {
                largest = f64::max(largest, expected.abs());
                difference = larger(difference, (found - expected).abs());
            }
        }
        // An empty or zero Jacobian has no scale of its own: 1 is the order of all others. That of
        // a tool that loops hold is zero but for rounding.
        discrepancy.add(difference / if largest > NOISE { largest } else { 1.0 }, &at.given);
    }
    Ok(discrepancy)
}

/// Returns the larger of two numbers, or NaN if one is NaN.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b <= a { a } else { b }
}

/// Number of steps, each half the one before.
const LEVELS: i32 = 10;

/// Returns the derivative of `f` at 0 by Ridders' method: central differences at `step`,
/// `step / 2`, … extrapolated to a step of zero until rounding errors dominate.
///
/// `f` and its argument should be of order 1. `f` returns `None` where it is undefined; such steps
/// are skipped as too long. Returns `None` if `f` is undefined at all steps.
pub(super) fn derivative(step: f64, f: impl Fn(f64) -> Option<[f64; 6]>) -> Option<[f64; 6]> {
    let mut coarser: Vec<[f64; 6]> = Vec::new();
    let (mut best, mut uncertainty) = (None, f64::INFINITY);
    for level in 0..LEVELS {
        let h = step / f64::from(1 << level);
        let (Some(after), Some(before)) = (f(h), f(-h)) else {
            coarser.clear();
            continue;
        };
        let mut finer = vec![zip(after, before, |after, before| (after - before) / (2.0 * h))];
        let mut power = 1.0;
        for (k, coarse) in coarser.iter().enumerate() {
            // The error of column k falls with h^(2k+2).
            power *= 4.0;
            let fine = finer[k];
            let better = zip(fine, *coarse, |fine, coarse| fine + (fine - coarse) / (power - 1.0));
            let change = largest_change(better, fine).max(largest_change(better, *coarse));
            if change <= uncertainty {
                (best, uncertainty) = (Some(better), change);
            }
            finer.push(better);
        }
        let diverging = match (finer.last(), coarser.last()) {
            (Some(fine), Some(coarse)) => largest_change(*fine, *coarse) > 2.0 * uncertainty,
            _ => false,
        };
        if uncertainty < 1e-13 || diverging && level > 3 {
            break;
        }
        coarser = finer;
    }
    best
}

fn zip(a: [f64; 6], b: [f64; 6], f: impl Fn(f64, f64) -> f64) -> [f64; 6] {
    core::array::from_fn(|i| f(a[i], b[i]))
}

fn largest_change(a: [f64; 6], b: [f64; 6]) -> f64 {
    zip(a, b, |a, b| (a - b).abs()).into_iter().fold(0.0, f64::max)
}
