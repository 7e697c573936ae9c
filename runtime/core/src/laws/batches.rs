//! Batches equal single configurations, on every instruction set.

use super::{Discrepancy, Failure, Subject};
use crate::function::{Array, Count};
use crate::lanes::{Batches, InstructionSet, Sweepable, Tiles, one_by_one};
use crate::{Description, Error, Function, Manipulator, Quantity, distinct, sampling};

/// Compares every function evaluated in batches with the methods for one configuration, on every
/// instruction set of this machine. Lengths are relative to the arm length.
pub fn batches(manipulator: &dyn Batches, samples: usize) -> Result<Discrepancy, Failure> {
    evaluations(manipulator, &Function::ALL, samples, &|function, arguments, results| {
        manipulator.batch(function, arguments, results)
    })
}

/// Compares the two functions that sweeps need, as [`batches`] does.
pub fn sweeps(manipulator: &dyn Sweepable, samples: usize) -> Result<Discrepancy, Failure> {
    let functions = [Function::Pose, Function::SourceDisplacements];
    evaluations(manipulator, &functions, samples, &|function, arguments, results| match function {
        Function::Pose => manipulator.poses(arguments, results),
        _ => manipulator.source_displacements(arguments, results),
    })
}

/// Evaluation of a function for the configurations of a table.
pub type Batch<'a> = dyn Fn(Function, &Tiles, &mut Tiles) -> Result<(), Error> + 'a;

/// Compares functions evaluated by `batch` with the methods for one configuration, as [`batches`]
/// does.
pub fn evaluations(
    manipulator: &dyn Manipulator,
    functions: &[Function],
    samples: usize,
    batch: &Batch,
) -> Result<Discrepancy, Failure> {
    let subject = Subject::new(manipulator)?;
    let description = manipulator.description();
    let (samples, skipped) = subject.samples(samples)?;
    let mut discrepancy = Discrepancy { compared: samples.len(), skipped, ..Default::default() };
    for function in functions {
        let signature = function.signature();
        let scales: Vec<f64> =
            signature.results.iter().flat_map(|array| scales(array, &subject)).chain([1.0]).collect();
        let mut expected: Option<Tiles> = None;
        for set in InstructionSet::all() {
            let mut arguments = Tiles::new(set, signature.arguments_len(description), samples.len());
            for (i, sample) in samples.iter().enumerate() {
                let given = signature.arguments.iter().flat_map(|array| -> Vec<f64> {
                    match array.quantity {
                        Quantity::Variables => sample.given.q.clone(),
                        Quantity::Parameters => sample.given.s.clone(),
                        Quantity::Inputs => sample.given.u.clone(),
                        Quantity::Magnitudes => (0..array.len(description))
                            .map(|k| 2.0 * sampling::halton(i + 1, k % 30) - 1.0)
                            .collect(),
                        // Errors or variances: small values.
                        _ => (0..array.len(description))
                            .map(|k| 1e-3 * sampling::halton(i + 1, k % 30))
                            .collect(),
                    }
                });
                given.enumerate().for_each(|(row, value)| arguments.set_value(row, i, value));
            }
            arguments.pad();
            let mut results = Tiles::new(set, signature.results_len(description), samples.len());
            let at_first = |error| Failure::Evaluation { at: samples[0].given.clone(), error };
            if expected.is_none() {
                one_by_one(manipulator, *function, &arguments, &mut results).map_err(at_first)?;
                expected = Some(results.clone());
            }
            batch(*function, &arguments, &mut results).map_err(at_first)?;
            let Some(expected) = &expected else { continue };
            for (i, sample) in samples.iter().enumerate() {
                for (row, scale) in (0..results.rows()).zip(&scales) {
                    let (found, expected) = (results.get(row, i), expected.get(row, i));
                    if !found.is_finite() {
                        return Err(Failure::NotFinite { method: function.name(), at: sample.given.clone() });
                    }
                    discrepancy.add((found - expected).abs() / scale.max(expected.abs()), &sample.given);
                }
            }
        }
    }
    Ok(discrepancy)
}

/// Returns the scale of each row of a result: the arm length for lengths, 1 for angles.
fn scales(array: &Array, subject: &Subject) -> Vec<f64> {
    let description = subject.manipulator.description();
    let arm = subject.arm;
    let column = [arm, arm, arm, 1.0, 1.0, 1.0];
    let unit = match *array.shape {
        [.., Count::Exactly(4), Count::Exactly(3)] => [[1.0; 9].as_slice(), &[arm; 3]].concat(),
        [Count::Frames, Count::Distinct, Count::Exactly(3)] => distinct_scales(description, arm),
        [Count::Exactly(6), Count::Exactly(6)] => column.iter().flat_map(|a| column.map(|b| a * b)).collect(),
        [.., Count::Exactly(6)] => column.to_vec(),
        [Count::Effects] => {
            let unit = |effect: &crate::Effect| column[effect.component.index()];
            description.effects.iter().map(unit).collect()
        }
        _ => vec![1.0],
    };
    unit.into_iter().cycle().take(array.len(description)).collect()
}

/// Returns the scales of the distinct numbers of a frame.
fn distinct_scales(description: &Description, arm: f64) -> Vec<f64> {
    match distinct::vectors_of(description) {
        // Rows 1–3 and rows 4–6 of each column: three translations, then three rotations.
        distinct::VECTORS_OF_TREE => {
            [[[1.0; 3], [1.0 / arm; 3]].concat().repeat(3), [[arm; 3], [1.0; 3]].concat().repeat(3)].concat()
        }
        vectors => [[1.0; 9], [arm; 9], [1.0; 9]].concat()[..3 * vectors].to_vec(),
    }
}
