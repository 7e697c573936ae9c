//! A spec as a [`Manipulator`].

use abbe::{Description, Error, Manipulator, Pose, Quantity, checks};
use abbe_codegen::chain::Model;
use abbe_codegen::program::FunctionKind;
use abbe_codegen::spec::{Orientation, Spec};

use crate::describe::Described;
use crate::lanes::{Block, LANES};
use crate::tape::Tape;

/// How many numbers a pose has.
const POSE: usize = 12;

/// A manipulator that is run from its spec, without a compiler.
#[derive(Clone, Debug)]
pub struct Interpreter<'s> {
    described: Described<'s>,
    euler: bool,
    transforms: Tape,
    pose: Tape,
    error_jacobian: Tape,
    joint_jacobian: Tape,
    parameter_jacobian: Tape,
    effects: Tape,
    generalized_errors: Tape,
}

impl<'s> Interpreter<'s> {
    /// Prepares the programs of a spec.
    pub fn new(spec: &'s Spec) -> Self {
        let model = Model::new(spec);
        let symbols = [spec.variables.len(), spec.parameters.len(), spec.inputs.len()];
        let tape = |kind: FunctionKind| Tape::new(&kind.program(&model), symbols);
        Self {
            described: Described::new(spec, &model),
            euler: spec.orientation == Orientation::EulerYzx,
            transforms: tape(FunctionKind::Transforms),
            pose: tape(FunctionKind::Pose),
            error_jacobian: tape(FunctionKind::ErrorJacobian),
            joint_jacobian: tape(FunctionKind::JointJacobian),
            parameter_jacobian: tape(FunctionKind::ParameterJacobian),
            effects: tape(FunctionKind::Effects),
            generalized_errors: tape(FunctionKind::GeneralizedErrors),
        }
    }

    /// Checks the arguments of one configuration.
    fn check(&self, q: &[f64], s: &[f64], u: &[f64]) -> Result<(), Error> {
        let description = self.described.description();
        for (quantity, values, expected) in [
            (Quantity::Variables, q, description.variables.len()),
            (Quantity::Parameters, s, description.parameters.len()),
            (Quantity::Inputs, u, description.inputs.len()),
        ] {
            count(quantity, expected, values.len())?;
            checks::finite(quantity, values)?;
        }
        checks::inputs(description.inputs, u)
    }

    /// The inputs at their default values, for what does not depend on them.
    fn nominal_inputs(&self) -> Vec<f64> {
        self.described.description().inputs.iter().map(|input| input.nominal).collect()
    }

    /// Runs a tape at one configuration.
    fn run(&self, tape: &Tape, q: &[f64], s: &[f64], u: &[f64]) -> Result<Vec<f64>, Error> {
        self.check(q, s, u)?;
        let mut block = Block::<1>::new(tape);
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

impl Manipulator for Interpreter<'_> {
    fn description(&self) -> Description<'_> {
        self.described.description()
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

    fn error_models(
        &self,
        q: &[f64],
        s: &[f64],
        u: &[f64],
        poses: &mut [Pose],
        columns: &mut [[f64; 6]],
        effects: &mut [f64],
    ) -> Result<(), (usize, Error)> {
        let description = self.description();
        let counts = [description.variables.len(), description.parameters.len(), description.inputs.len()];
        let (column_count, effect_count) = (6 * description.frames.len(), description.effects.len());
        let configurations = poses.len();
        let at_none = |error| (0, error);
        let [variables, parameters, inputs] = counts;
        count(Quantity::Variables, variables * configurations, q.len()).map_err(at_none)?;
        count(Quantity::Parameters, parameters * configurations, s.len()).map_err(at_none)?;
        count(Quantity::Inputs, inputs * configurations, u.len()).map_err(at_none)?;
        count(Quantity::Jacobian, column_count * configurations, columns.len()).map_err(at_none)?;
        count(Quantity::Errors, effect_count * configurations, effects.len()).map_err(at_none)?;

        let row = |i: usize, width: usize| i * width..(i + 1) * width;
        let tapes = [&self.error_jacobian, &self.effects];
        let mut blocks = tapes.map(Block::<LANES>::new);
        for first in (0..configurations).step_by(LANES) {
            let lanes = LANES.min(configurations - first);
            for lane in 0..lanes {
                let i = first + lane;
                let (q, s, u) = (&q[row(i, variables)], &s[row(i, parameters)], &u[row(i, inputs)]);
                self.check(q, s, u).map_err(|error| (i, error))?;
                for (slot, value) in q.iter().chain(s).chain(u).enumerate() {
                    blocks.iter_mut().for_each(|block| block.set(slot, lane, *value));
                }
            }
            for (block, tape) in blocks.iter_mut().zip(tapes) {
                block.run(tape);
            }
            let [jacobian, errors] = &blocks;
            for lane in 0..lanes {
                let i = first + lane;
                let columns = &mut columns[row(i, column_count)];
                let outputs = self.error_jacobian.outputs.iter().map(|slot| jacobian.value(*slot, lane));
                poses[i] = self.finish_jacobian(outputs, columns).map_err(|error| (i, error))?;
                let effects = &mut effects[row(i, effect_count)];
                for (effect, slot) in effects.iter_mut().zip(&self.effects.outputs) {
                    *effect = errors.value(*slot, lane);
                }
                checks::finite(Quantity::Errors, effects).map_err(|error| (i, error))?;
            }
        }
        Ok(())
    }
}

fn count(quantity: Quantity, expected: usize, found: usize) -> Result<(), Error> {
    if expected == found { Ok(()) } else { Err(Error::Count { quantity, expected, found }) }
}

fn pose_of(values: &[f64]) -> Pose {
    Pose(std::array::from_fn(|column| std::array::from_fn(|row| values[3 * column + row])))
}
