//! A spec as a [`Manipulator`].

use std::sync::{Arc, OnceLock};

use abbe::analysis::Sweepable;
use abbe::lanes::{self, Batches, Tiles};
use abbe::{Description, Error, Function, Manipulator, Pose, Quantity, checks};
use abbe_codegen::chain::{EffectNode, Model};
use abbe_codegen::program::FunctionKind;
use abbe_codegen::spec::Spec;

use crate::lanes::{Batch, Block};
use crate::tape::Tape;

/// How many numbers a pose has.
const POSE: usize = 12;

/// A manipulator that is run from its spec, without a compiler.
#[derive(Clone, Debug)]
pub struct Interpreter {
    spec: Arc<Spec>,
    description: Description,
    model: Arc<Model>,
    /// In the order of [`Function::ALL`]; made when they are first asked for.
    tapes: [OnceLock<Tape>; Function::ALL.len()],
}

impl Interpreter {
    /// Prepares a spec, which it keeps.
    pub fn new(spec: impl Into<Arc<Spec>>) -> Self {
        let spec = spec.into();
        let model = Model::new(&spec);
        let description = spec.describe(model.effects.iter().map(EffectNode::effect));
        let tapes = [const { OnceLock::new() }; Function::ALL.len()];
        Self { spec, description, model: Arc::new(model), tapes }
    }

    /// The spec that it runs.
    pub fn spec(&self) -> &Arc<Spec> {
        &self.spec
    }

    /// The program of a function, ready to run.
    fn tape(&self, function: Function) -> &Tape {
        self.tapes[function as usize].get_or_init(|| {
            let numbers = |quantity: Quantity| {
                let arrays = function.signature().arguments.iter();
                arrays
                    .filter(|array| array.quantity == quantity)
                    .map(|array| array.len(&self.description))
                    .sum()
            };
            let symbols = [Quantity::Variables, Quantity::Parameters, Quantity::Inputs, Quantity::Errors];
            Tape::new(&FunctionKind::ALL[function as usize].program(&self.model), symbols.map(numbers))
        })
    }

    /// The results of a function at one configuration, one after the other, finite and not singular.
    fn run(&self, function: Function, arguments: &[&[f64]]) -> Result<Vec<f64>, Error> {
        let signature = function.signature();
        for (array, values) in signature.arguments.iter().zip(arguments) {
            count(array.quantity, array.len(&self.description), values.len())?;
            checks::finite(array.quantity, values)?;
        }
        if let [_, _, u] = arguments {
            checks::inputs(&self.description.inputs, u)?;
        }
        let tape = self.tape(function);
        let mut rows = vec![[0.0]; tape.slots];
        let mut block = Block::new(tape, &mut rows);
        for (slot, value) in arguments.iter().copied().flatten().enumerate() {
            block.set(slot, 0, *value);
        }
        block.run(tape);
        let values: Vec<f64> = tape.outputs.iter().map(|slot| block.value(*slot, 0)).collect();
        let mut rest = values.as_slice();
        if signature.has_margin(self.description.orientation)
            && let Some((margin, results)) = values.split_last()
        {
            checks::margin(*margin)?;
            rest = results;
        }
        for array in signature.results {
            let (result, others) = rest.split_at(array.len(&self.description));
            checks::finite(array.quantity, result)?;
            rest = others;
        }
        Ok(values)
    }

    fn jacobian(
        &self,
        function: Function,
        expected: usize,
        q: &[f64],
        s: &[f64],
        columns: &mut [[f64; 6]],
    ) -> Result<Pose, Error> {
        count(Quantity::Jacobian, expected, columns.len())?;
        let values = self.run(function, &[q, s])?;
        let (pose, rest) = values.split_at(POSE);
        columns.as_flattened_mut().copy_from_slice(&rest[..6 * expected]);
        Ok(pose_of(pose))
    }
}

impl Manipulator for Interpreter {
    fn description(&self) -> &Description {
        &self.description
    }

    fn transforms(&self, q: &[f64], s: &[f64], transforms: &mut [Pose]) -> Result<(), Error> {
        count(Quantity::Pose, self.description.frames.len() + 1, transforms.len())?;
        let values = self.run(Function::Transforms, &[q, s])?;
        for (transform, values) in transforms.iter_mut().zip(values.chunks_exact(POSE)) {
            *transform = pose_of(values);
        }
        Ok(())
    }

    fn pose(&self, q: &[f64], s: &[f64]) -> Result<Pose, Error> {
        Ok(pose_of(&self.run(Function::Pose, &[q, s])?))
    }

    fn error_jacobian(&self, q: &[f64], s: &[f64], columns: &mut [[f64; 6]]) -> Result<Pose, Error> {
        self.jacobian(Function::ErrorJacobian, 6 * self.description.frames.len(), q, s, columns)
    }

    fn joint_jacobian(&self, q: &[f64], s: &[f64], columns: &mut [[f64; 6]]) -> Result<Pose, Error> {
        self.jacobian(Function::JointJacobian, self.description.variables.len(), q, s, columns)
    }

    fn parameter_jacobian(&self, q: &[f64], s: &[f64], columns: &mut [[f64; 6]]) -> Result<Pose, Error> {
        self.jacobian(Function::ParameterJacobian, self.description.parameters.len(), q, s, columns)
    }

    fn effects(&self, q: &[f64], s: &[f64], u: &[f64], effects: &mut [f64]) -> Result<(), Error> {
        count(Quantity::Errors, self.description.effects.len(), effects.len())?;
        effects.copy_from_slice(&self.run(Function::Effects, &[q, s, u])?);
        Ok(())
    }

    fn generalized_errors(
        &self,
        q: &[f64],
        s: &[f64],
        u: &[f64],
        errors: &mut [[f64; 6]],
    ) -> Result<(), Error> {
        count(Quantity::Errors, self.description.frames.len(), errors.len())?;
        errors.as_flattened_mut().copy_from_slice(&self.run(Function::GeneralizedErrors, &[q, s, u])?);
        Ok(())
    }
}

impl Batches for Interpreter {
    fn batch(&self, function: Function, arguments: &Tiles, results: &mut Tiles) -> Result<(), Error> {
        lanes::check(function, &self.description, arguments, results)?;
        arguments.instruction_set().run(Batch { tape: self.tape(function), arguments, results });
        Ok(())
    }
}

impl Sweepable for Interpreter {
    fn poses(&self, arguments: &Tiles, poses: &mut Tiles) -> Result<(), Error> {
        self.batch(Function::Pose, arguments, poses)
    }

    fn source_displacements(&self, arguments: &Tiles, displacements: &mut Tiles) -> Result<(), Error> {
        self.batch(Function::SourceDisplacements, arguments, displacements)
    }
}

fn count(quantity: Quantity, expected: usize, found: usize) -> Result<(), Error> {
    if expected == found { Ok(()) } else { Err(Error::Count { quantity, expected, found }) }
}

fn pose_of(values: &[f64]) -> Pose {
    Pose(std::array::from_fn(|column| std::array::from_fn(|row| values[3 * column + row])))
}
