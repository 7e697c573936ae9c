//! Batches say what single configurations say, on every instruction set.

use super::samples::Subject;
use super::{Discrepancy, Failure};
use crate::analysis::sampling;
use crate::lanes::{InstructionSet, Path, Tiles, one_by_one};
use crate::{Manipulator, Orientation};

/// Everything that is computed in batches against the same from the methods for one configuration, on every
/// instruction set that the machine has. Lengths in arm lengths.
pub fn batches(manipulator: &dyn Manipulator, samples: usize) -> Result<Discrepancy, Failure> {
    let subject = Subject::new(manipulator)?;
    let description = manipulator.description();
    let (samples, skipped) = subject.samples(samples)?;
    let mut discrepancy = Discrepancy { compared: samples.len(), skipped, ..Default::default() };
    for path in Path::ALL {
        let scales = scales(path, &subject);
        let mut expected: Option<Tiles> = None;
        for set in InstructionSet::all() {
            let mut arguments = Tiles::new(set, path.arguments(description), samples.len());
            for (i, at) in samples.iter().enumerate() {
                let given = at.q.iter().chain(&subject.s).chain(&subject.u).copied();
                // Errors or variances, if the function takes any.
                let errors =
                    (0..6 * description.frames.len()).map(|k| 1e-3 * sampling::halton(i + 1, k % 30));
                for (row, value) in given.chain(errors).take(arguments.rows()).enumerate() {
                    arguments.set_value(row, i, value);
                }
            }
            arguments.pad();
            let mut results = Tiles::new(set, path.results(description), samples.len());
            let at_first = |error| Failure::Evaluation { q: samples[0].q.clone(), error };
            if expected.is_none() {
                one_by_one(manipulator, path, &arguments, &mut results).map_err(at_first)?;
                expected = Some(results.clone());
            }
            manipulator.batch(path, &arguments, &mut results).map_err(at_first)?;
            let Some(expected) = &expected else { continue };
            for (i, at) in samples.iter().enumerate() {
                for (row, scale) in scales.iter().enumerate() {
                    let (found, expected) = (results.get(row, i), expected.get(row, i));
                    if !found.is_finite() {
                        return Err(Failure::NotFinite { method: path.name(), q: at.q.clone() });
                    }
                    discrepancy.add((found - expected).abs() / scale.max(expected.abs()), &at.q);
                }
            }
        }
    }
    Ok(discrepancy)
}

/// What the rows of a function are measured in.
fn scales(path: Path, subject: &Subject) -> Vec<f64> {
    let description = subject.manipulator.description();
    let (arm, frames) = (subject.arm, description.frames.len());
    let pose = [vec![1.0; 9], vec![arm; 3]].concat();
    let column = [arm, arm, arm, 1.0, 1.0, 1.0];
    let columns = |count: usize| column.repeat(count);
    let euler = usize::from(description.orientation == Orientation::EulerYzx);
    let mut scales = match path {
        Path::Pose => pose,
        Path::ErrorJacobian => [pose, columns(6 * frames)].concat(),
        Path::DistinctErrorJacobian => {
            [pose, [vec![1.0; 9], vec![arm; 9], vec![1.0; 9 * euler]].concat().repeat(frames)].concat()
        }
        Path::Displacement | Path::PredictedDisplacement => columns(1),
        Path::SourceDisplacements => columns(description.sources.len()),
        Path::Covariance => column.iter().flat_map(|a| column.map(|b| a * b)).collect(),
    };
    scales.resize(path.results(description), 1.0);
    scales
}
