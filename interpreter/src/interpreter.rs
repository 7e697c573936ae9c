//! A spec as a [`Manipulator`].

use std::sync::Arc;

use abbe::lanes::{Path, Tiles};
use abbe::{Description, Error, Manipulator, Pose, Quantity, checks};
use abbe_codegen::chain::{EffectNode, Model};
use abbe_codegen::program::FunctionKind;
use abbe_codegen::spec::{Orientation, Spec};

use crate::lanes::{Batch, Block};
use crate::tape::Tape;

/// How many numbers a pose has.
const POSE: usize = 12;

/// A manipulator that is run from its spec, without a compiler.
#[derive(Clone, Debug)]
pub struct Interpreter {
    spec: Arc<Spec>,
    description: Description,
    euler: bool,
    transforms: Tape,
    pose: Tape,
    error_jacobian: Tape,
    joint_jacobian: Tape,
    parameter_jacobian: Tape,
    effects: Tape,
    generalized_errors: Tape,
    /// In the order of [`Path::ALL`].
    batches: [Tape; Path::ALL.len()],
}

impl Interpreter {
    /// Prepares the programs of a spec, which it keeps.
    pub fn new(spec: impl Into<Arc<Spec>>) -> Self {
        let spec = spec.into();
        let model = Model::new(&spec);
        let counts = [spec.variables.len(), spec.parameters.len(), spec.inputs.len()];
        let tape = |kind: FunctionKind| {
            let errors = match kind {
                FunctionKind::Displacement | FunctionKind::Covariance => 6 * spec.frames.len(),
                _ => 0,
            };
            let [variables, parameters, inputs] = counts;
            Tape::new(&kind.program(&model), [variables, parameters, inputs, errors])
        };
        Self {
            description: spec.describe(model.effects.iter().map(EffectNode::effect)),
            euler: spec.orientation == Orientation::EulerYzx,
            transforms: tape(FunctionKind::Transforms),
            pose: tape(FunctionKind::Pose),
            error_jacobian: tape(FunctionKind::ErrorJacobian),
            joint_jacobian: tape(FunctionKind::JointJacobian),
            parameter_jacobian: tape(FunctionKind::ParameterJacobian),
            effects: tape(FunctionKind::Effects),
            generalized_errors: tape(FunctionKind::GeneralizedErrors),
            batches: Path::ALL.map(|path| tape(kind(path))),
            spec,
        }
    }

    /// The spec that it runs.
    pub fn spec(&self) -> &Arc<Spec> {
        &self.spec
    }

    /// Checks the arguments of one configuration.
    fn check(&self, q: &[f64], s: &[f64], u: &[f64]) -> Result<(), Error> {
        let description = &self.description;
        for (quantity, values, expected) in [
            (Quantity::Variables, q, description.variables.len()),
            (Quantity::Parameters, s, description.parameters.len()),
            (Quantity::Inputs, u, description.inputs.len()),
        ] {
            count(quantity, expected, values.len())?;
            checks::finite(quantity, values)?;
        }
        checks::inputs(&description.inputs, u)
    }

    /// The inputs at their default values, for what does not depend on them.
    fn nominal_inputs(&self) -> Vec<f64> {
        self.description.inputs.iter().map(|input| input.nominal).collect()
    }

    /// Runs a tape at one configuration.
    fn run(&self, tape: &Tape, q: &[f64], s: &[f64], u: &[f64]) -> Result<Vec<f64>, Error> {
        self.check(q, s, u)?;
        let mut rows = vec![[0.0]; tape.slots];
        let mut block = Block::new(tape, &mut rows);
        for (slot, value) in q.iter().chain(s).chain(u).enumerate() {
            block.set(slot, 0, *value);
        }
        block.run(tape);
        Ok(tape.outputs.iter().map(|slot| block.value(*slot, 0)).collect())
    }

    fn jacobian(&self, tape: &Tape, q: &[f64], s: &[f64], columns: &mut [[f64; 6]]) -> Result<Pose, Error> {
        let margin = usize::from(self.euler);
        count(Quantity::Jacobian, (tape.outputs.len() - POSE - margin) / 6, columns.len())?;
        let values = self.run(tape, q, s, &self.nominal_inputs())?;
        self.finish_jacobian(values.into_iter(), columns)
    }

    /// Takes apart and checks a pose, the columns of a Jacobian and the margin, if there is one.
    fn finish_jacobian(
        &self,
        mut values: impl Iterator<Item = f64>,
        columns: &mut [[f64; 6]],
    ) -> Result<Pose, Error> {
        let mut pose = Pose::IDENTITY;
        for (entry, value) in pose.0.as_flattened_mut().iter_mut().zip(&mut values) {
            *entry = value;
        }
        for (entry, value) in columns.as_flattened_mut().iter_mut().zip(&mut values) {
            *entry = value;
        }
        checks::margin(values.next().unwrap_or(1.0))?;
        checks::finite(Quantity::Pose, pose.0.as_flattened())?;
        checks::finite(Quantity::Jacobian, columns.as_flattened())?;
        Ok(pose)
    }
}

impl Manipulator for Interpreter {
    fn description(&self) -> &Description {
        &self.description
    }

    fn transforms(&self, q: &[f64], s: &[f64], transforms: &mut [Pose]) -> Result<(), Error> {
        count(Quantity::Pose, self.transforms.outputs.len() / POSE, transforms.len())?;
        let values = self.run(&self.transforms, q, s, &self.nominal_inputs())?;
        checks::finite(Quantity::Pose, &values)?;
        for (transform, values) in transforms.iter_mut().zip(values.chunks_exact(POSE)) {
            *transform = pose_of(values);
        }
        Ok(())
    }

    fn pose(&self, q: &[f64], s: &[f64]) -> Result<Pose, Error> {
        let values = self.run(&self.pose, q, s, &self.nominal_inputs())?;
        checks::finite(Quantity::Pose, &values)?;
        Ok(pose_of(&values))
    }

    fn error_jacobian(&self, q: &[f64], s: &[f64], columns: &mut [[f64; 6]]) -> Result<Pose, Error> {
        self.jacobian(&self.error_jacobian, q, s, columns)
    }

    fn joint_jacobian(&self, q: &[f64], s: &[f64], columns: &mut [[f64; 6]]) -> Result<Pose, Error> {
        self.jacobian(&self.joint_jacobian, q, s, columns)
    }

    fn parameter_jacobian(&self, q: &[f64], s: &[f64], columns: &mut [[f64; 6]]) -> Result<Pose, Error> {
        self.jacobian(&self.parameter_jacobian, q, s, columns)
    }

    fn effects(&self, q: &[f64], s: &[f64], u: &[f64], effects: &mut [f64]) -> Result<(), Error> {
        count(Quantity::Errors, self.effects.outputs.len(), effects.len())?;
        let values = self.run(&self.effects, q, s, u)?;
        checks::finite(Quantity::Errors, &values)?;
        effects.copy_from_slice(&values);
        Ok(())
    }

    fn generalized_errors(
        &self,
        q: &[f64],
        s: &[f64],
        u: &[f64],
        errors: &mut [[f64; 6]],
    ) -> Result<(), Error> {
        count(Quantity::Errors, self.generalized_errors.outputs.len() / 6, errors.len())?;
        let values = self.run(&self.generalized_errors, q, s, u)?;
        checks::finite(Quantity::Errors, &values)?;
        errors.as_flattened_mut().copy_from_slice(&values);
        Ok(())
    }

    fn batch(&self, path: Path, arguments: &Tiles, results: &mut Tiles) -> Result<(), Error> {
        path.check(self.description(), arguments, results)?;
        let tape = &self.batches[path as usize];
        arguments.instruction_set().run(Batch { tape, arguments, results });
        Ok(())
    }
}

/// The program of a batch function.
fn kind(path: Path) -> FunctionKind {
    match path {
        Path::Pose => FunctionKind::Pose,
        Path::ErrorJacobian => FunctionKind::ErrorJacobian,
        Path::DistinctErrorJacobian => FunctionKind::ErrorJacobianDistinct,
        Path::Displacement => FunctionKind::Displacement,
        Path::PredictedDisplacement => FunctionKind::PredictedDisplacement,
        Path::SourceDisplacements => FunctionKind::SourceDisplacements,
        Path::Covariance => FunctionKind::Covariance,
    }
}

fn count(quantity: Quantity, expected: usize, found: usize) -> Result<(), Error> {
    if expected == found { Ok(()) } else { Err(Error::Count { quantity, expected, found }) }
}

fn pose_of(values: &[f64]) -> Pose {
    Pose(std::array::from_fn(|column| std::array::from_fn(|row| values[3 * column + row])))
}
