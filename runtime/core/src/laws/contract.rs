//! The promises of the trait besides derivatives: one pose, finite outputs, guarded inputs.

use super::{Configuration, Discrepancy, Failure, Sample, Subject};
use crate::{Error, Manipulator, Pose};

/// Compares the pose, from every method that returns it, with the product of the transforms.
pub fn pose(manipulator: &dyn Manipulator, samples: usize) -> Result<Discrepancy, Failure> {
    let subject = Subject::new(manipulator)?;
    let (samples, skipped) = subject.samples(samples)?;
    let mut discrepancy = Discrepancy { compared: samples.len(), skipped, ..Default::default() };
    for at in &samples {
        for pose in Outputs::at(&subject, at)?.poses {
            discrepancy.add(difference(&subject, &pose, &at.pose), &at.given);
        }
    }
    Ok(discrepancy)
}

/// Compares the poses of all solutions of `inverse`, from another configuration, with the pose that
/// they are for. At least one exists. Compares nothing for loops, whose solutions may belong to
/// another assembly mode, and without a closed form.
pub fn inverse(manipulator: &dyn Manipulator, samples: usize) -> Result<Discrepancy, Failure> {
    let subject = Subject::new(manipulator)?;
    let description = manipulator.description();
    let (rows, joints) = (description.solutions, description.variables.len());
    if rows == 0 || description.has_loops() {
        return Ok(Discrepancy::default());
    }
    let (samples, skipped) = subject.samples(samples)?;
    let mut discrepancy = Discrepancy { compared: samples.len(), skipped, ..Default::default() };
    let (mut solutions, mut found) = (vec![0.0; rows * joints], vec![0.0; rows]);
    for (at, other) in samples.iter().zip(samples.iter().skip(1).chain(&samples)) {
        let failed = |error| Failure::Evaluation { at: at.given.clone(), error };
        let Configuration { s, .. } = &at.given;
        manipulator.inverse(&other.given.q, s, &at.pose, &mut solutions, &mut found).map_err(failed)?;
        let reached = solutions.chunks_exact(joints).zip(&found).filter(|(_, found)| **found > 0.0);
        let mut count = 0;
        for (row, _) in reached {
            let pose = manipulator.pose(row, s).map_err(failed)?;
            discrepancy.add(difference(&subject, &pose, &at.pose), &at.given);
            count += 1;
        }
        if count == 0 {
            discrepancy.add(f64::INFINITY, &at.given);
        }
    }
    Ok(discrepancy)
}

/// Checks that every output is finite, that ε is the sum of the repeatable effects, and that NaN
/// and slices of the wrong length are refused. The discrepancy is that of ε.
pub fn contract(manipulator: &dyn Manipulator, samples: usize) -> Result<Discrepancy, Failure> {
    let subject = Subject::new(manipulator)?;
    let (samples, skipped) = subject.samples(samples)?;
    let mut discrepancy = Discrepancy { compared: samples.len(), skipped, ..Default::default() };
    for at in &samples {
        guarded(&subject, at)?;
        let single = Outputs::at(&subject, at)?;
        let [errors, sums] = single.errors.each_ref().map(|errors| errors.as_flattened());
        for (error, sum) in errors.iter().zip(sums) {
            discrepancy.add((error - sum).abs() / sum.abs().max(1.0), &at.given);
        }
    }
    Ok(discrepancy)
}

/// Results of the methods at one configuration, all of them finite.
struct Outputs {
    /// Poses from `pose`, `error_jacobian`, `joint_jacobian` and `parameter_jacobian`.
    poses: [Pose; 4],
    /// ε from `generalized_errors`, and as the sum of the repeatable effects.
    errors: [Vec<[f64; 6]>; 2],
}

impl Outputs {
    fn at(subject: &Subject, at: &Sample) -> Result<Self, Failure> {
        let manipulator = subject.manipulator;
        let Configuration { q, s, u } = &at.given;
        let description = manipulator.description();
        let mut columns = vec![[0.0; 6]; 6 * description.frames.len()];
        let mut joint_columns = vec![[0.0; 6]; description.variables.len()];
        let mut parameter_columns = vec![[0.0; 6]; description.parameters.len()];
        let mut effects = vec![0.0; description.effects.len()];
        let mut errors = [vec![[0.0; 6]; description.frames.len()], vec![[0.0; 6]; description.frames.len()]];
        let mut evaluate = || -> Result<[Pose; 4], Error> {
            manipulator.effects(q, s, u, &mut effects)?;
            manipulator.generalized_errors(q, s, u, &mut errors[0])?;
            Ok([
                manipulator.pose(q, s)?,
                manipulator.error_jacobian(q, s, &mut columns)?,
                manipulator.joint_jacobian(q, s, &mut joint_columns)?,
                manipulator.parameter_jacobian(q, s, &mut parameter_columns)?,
            ])
        };
        let poses = evaluate().map_err(|error| Failure::Evaluation { at: at.given.clone(), error })?;
        description.generalized_errors(&effects, &mut errors[1]);

        for (method, values) in [
            ("pose", poses.each_ref().map(|pose| pose.0).as_flattened().as_flattened()),
            ("error_jacobian", columns.as_flattened()),
            ("joint_jacobian", joint_columns.as_flattened()),
            ("parameter_jacobian", parameter_columns.as_flattened()),
            ("effects", &effects),
            ("generalized_errors", errors[0].as_flattened()),
        ] {
            if values.iter().any(|value| !value.is_finite()) {
                return Err(Failure::NotFinite { method, at: at.given.clone() });
            }
        }
        Ok(Self { poses, errors })
    }
}

/// Returns the largest difference between two poses, lengths relative to the arm length.
fn difference(subject: &Subject, a: &Pose, b: &Pose) -> f64 {
    let scale = |i: usize| if i < 9 { 1.0 } else { subject.arm };
    let entries = a.0.as_flattened().iter().zip(b.0.as_flattened()).enumerate();
    let differences = entries.map(|(i, (a, b))| (a - b).abs() / scale(i));
    differences.fold(0.0, |largest, d| if d.is_nan() { f64::INFINITY } else { largest.max(d) })
}

/// Checks that `pose`, `error_jacobian` and `effects` refuse NaN and slices that are too long.
fn guarded(subject: &Subject, at: &Sample) -> Result<(), Failure> {
    let manipulator = subject.manipulator;
    let Configuration { q, s, u } = &at.given;
    let description = manipulator.description();
    let mut columns = vec![[0.0; 6]; 6 * description.frames.len()];
    let mut effects = vec![0.0; description.effects.len()];
    let mut check = |input, q: &[f64]| {
        for (method, accepted) in [
            ("pose", manipulator.pose(q, s).is_ok()),
            ("error_jacobian", manipulator.error_jacobian(q, s, &mut columns).is_ok()),
            ("effects", manipulator.effects(q, s, u, &mut effects).is_ok()),
        ] {
            if accepted {
                return Err(Failure::Unguarded { method, input });
            }
        }
        Ok(())
    };
    check("one joint variable too many", &[q.as_slice(), &[0.0]].concat())?;
    for i in 0..q.len() {
        let mut q = q.clone();
        q[i] = f64::NAN;
        check("NaN as a joint variable", &q)?;
    }
    Ok(())
}
