//! Jacobians equal central differences of the exact chain.

use super::differences::derivative;
use super::samples::{Sample, Subject};
use super::{Discrepancy, Failure};
use crate::{
    Component, Error, Manipulator, Orientation, Pose, VariableKind, chain, deviation, drawn_pose, real_pose,
};

/// The first step of the differences: rad, or arm lengths.
const STEP: f64 = 0.1;

/// The same where that finds another derivative: what has kinks, such as a table, has one between them that long steps do
/// not see; one that is wrong is so for short steps too.
const SHORT_STEP: f64 = 1e-4;

/// From which difference on, relative to the larger number, short steps are tried.
const DIFFERENT: f64 = 1e-9;

/// `J_e` against `∂(X_real − X_ideal)/∂ε`: central differences of equation (6) with true rotations.
pub fn error_jacobian(manipulator: &dyn Manipulator, samples: usize) -> Result<Discrepancy, Failure> {
    let orientation = manipulator.description().orientation;
    let frames = manipulator.description().frames.len();
    compare(manipulator, samples, 6 * frames, |subject, at, columns| {
        manipulator.error_jacobian(&at.q, &subject.s, columns)?;
        let each = (0..frames).flat_map(|frame| Component::ALL.map(|component| (frame, component)));
        Ok(each
            .map(|(frame, component)| {
                let unit = if component.is_rotation() { 1.0 } else { subject.arm };
                let real = |step: f64| {
                    let mut errors = vec![[0.0; 6]; frames];
                    errors[frame][component.index()] = step * unit;
                    Some(real_pose(&at.transforms, &errors))
                };
                let found = columns[6 * frame + component.index()].map(|entry| entry * unit);
                (unit, differences(subject, orientation, at, found, real))
            })
            .collect())
    })
}

/// `J_q` against `∂X_T/∂q`: central differences of the product of the transforms.
pub fn joint_jacobian(manipulator: &dyn Manipulator, samples: usize) -> Result<Discrepancy, Failure> {
    let description = manipulator.description();
    compare(manipulator, samples, description.variables.len(), |subject, at, columns| {
        manipulator.joint_jacobian(&at.q, &subject.s, columns)?;
        let units = description.variables.iter().map(|variable| match variable.kind {
            VariableKind::Revolute => 1.0,
            VariableKind::Prismatic => subject.arm,
        });
        Ok(units
            .enumerate()
            .map(|(i, unit)| {
                let moved = |step: f64| {
                    let mut q = at.q.clone();
                    q[i] += step * unit;
                    subject.transforms(&q, &subject.s).ok().map(|transforms| chain(&transforms))
                };
                let found = columns[i].map(|entry| entry * unit);
                (unit, differences(subject, description.orientation, at, found, moved))
            })
            .collect())
    })
}

/// `∂X_T/∂s` against central differences of the product of the transforms.
pub fn parameter_jacobian(manipulator: &dyn Manipulator, samples: usize) -> Result<Discrepancy, Failure> {
    let description = manipulator.description();
    compare(manipulator, samples, description.parameters.len(), |subject, at, columns| {
        manipulator.parameter_jacobian(&at.q, &subject.s, columns)?;
        let units = description
            .parameters
            .iter()
            .map(|parameter| if parameter.unit == description.length.symbol() { subject.arm } else { 1.0 });
        Ok(units
            .enumerate()
            .map(|(i, unit)| {
                let changed = |step: f64| {
                    let mut s = subject.s.clone();
                    s[i] += step * unit;
                    subject.transforms(&at.q, &s).ok().map(|transforms| chain(&transforms))
                };
                let found = columns[i].map(|entry| entry * unit);
                (unit, differences(subject, description.orientation, at, found, changed))
            })
            .collect())
    })
}

/// `ΔX = J_e ε` of every source by itself against the derivative of the exact chain by its magnitude.
pub fn source_displacements(manipulator: &dyn Manipulator, samples: usize) -> Result<Discrepancy, Failure> {
    let description = manipulator.description();
    let sources = description.sources.len();
    compare(manipulator, samples, sources, |subject, at, columns| {
        let mut by_error = vec![[0.0; 6]; 6 * description.frames.len()];
        let mut effects = vec![0.0; description.effects.len()];
        manipulator.error_jacobian(&at.q, &subject.s, &mut by_error)?;
        manipulator.effects(&at.q, &subject.s, &subject.u, &mut effects)?;
        columns.fill([0.0; 6]);
        // The largest error of a source, in rad and arm lengths: steps make it of order 1.
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
                drawn_pose(manipulator, &at.q, &subject.s, &subject.u, &magnitudes).ok()
            };
            let found = columns[source].map(|entry| entry * unit);
            (unit, differences(subject, description.orientation, at, found, real))
        });
        Ok(expected.collect())
    })
}

/// The derivative of a pose, lengths in arm lengths; if two are found, the one that is nearer to a column.
fn differences(
    subject: &Subject,
    orientation: Orientation,
    at: &Sample,
    column: [f64; 6],
    pose: impl Fn(f64) -> Option<Pose>,
) -> Option<[f64; 6]> {
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

/// The unit of each column's argument, and the column by differences.
type Expected = Vec<(f64, Option<[f64; 6]>)>;

/// Compares the columns that `evaluate` fills with those that it returns.
fn compare(
    manipulator: &dyn Manipulator,
    samples: usize,
    count: usize,
    evaluate: impl Fn(&Subject, &Sample, &mut [[f64; 6]]) -> Result<Expected, Error>,
) -> Result<Discrepancy, Failure> {
    let subject = Subject::new(manipulator)?;
    let (samples, skipped) = subject.samples(samples)?;
    let mut discrepancy = Discrepancy { compared: samples.len(), skipped, ..Discrepancy::default() };
    let mut columns = vec![[0.0; 6]; count];
    for at in &samples {
        let expected = evaluate(&subject, at, &mut columns)
            .map_err(|error| Failure::Evaluation { q: at.q.clone(), error })?;
        let (mut difference, mut largest) = (0.0, 0.0);
        for (column, (unit, expected)) in columns.iter().zip(expected) {
            let expected = expected.unwrap_or([f64::NAN; 6]);
            for (found, expected) in subject.scaled(*column).iter().zip(expected) {
                let found = found * unit;
                largest = f64::max(largest, expected.abs());
                difference = larger(difference, (found - expected).abs());
            }
        }
        // Of an empty or zero Jacobian nothing can be relative; 1 is the order of all others.
        discrepancy.add(difference / if largest > 0.0 { largest } else { 1.0 }, &at.q);
    }
    Ok(discrepancy)
}

/// The larger of two; NaN stays.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b <= a { a } else { b }
}
