//! Two robots written by hand, for tests of the laws.

mod pps;
mod puma;

use abbe_core::{Error, Function, Manipulator, Pose, chain};

pub(crate) use pps::Pps;
pub(crate) use puma::Puma;

/// Jacobian of a robot: fills its columns and returns the pose.
type Jacobian = fn(&[f64], &[f64], &mut [[f64; 6]]) -> Result<Pose, Error>;

/// Local transforms `A_1 … A_6` and the tool.
type Transforms = fn(&[f64], &[f64]) -> Result<[Pose; 7], Error>;
/// Effects of the sources at q, s and u.
type Effects = fn(&[f64], &[f64], &[f64], &mut [f64]) -> Result<(), Error>;

/// Functions of a robot with six frames.
struct ByHand {
    transforms: Transforms,
    error_jacobian: Jacobian,
    joint_jacobian: Jacobian,
    parameter_jacobian: Jacobian,
    effects: Effects,
}

impl ByHand {
    /// Evaluates a function of a robot, which gives its description.
    fn evaluate(
        &self,
        robot: &dyn Manipulator,
        function: Function,
        arguments: &[&[f64]],
        results: &mut [&mut [f64]],
    ) -> Result<(), Error> {
        let pose = match (function, arguments, &mut *results) {
            (Function::Transforms, &[q, s], [into]) => {
                let poses = (self.transforms)(q, s)?;
                into.copy_from_slice(&poses.map(|pose| pose.0.concat()).concat());
                return Ok(());
            }
            (Function::Pose, &[q, s], _) => chain(&(self.transforms)(q, s)?),
            (Function::ErrorJacobian, &[q, s], [_, columns]) => {
                (self.error_jacobian)(q, s, columns.as_chunks_mut().0)?
            }
            (Function::JointJacobian, &[q, s], [_, columns]) => {
                (self.joint_jacobian)(q, s, columns.as_chunks_mut().0)?
            }
            (Function::ParameterJacobian, &[q, s], [_, columns]) => {
                (self.parameter_jacobian)(q, s, columns.as_chunks_mut().0)?
            }
            (Function::Effects, &[q, s, u], [into]) => return (self.effects)(q, s, u, into),
            (Function::GeneralizedErrors, &[q, s, u], [into]) => {
                let mut values = vec![0.0; robot.description().effects.len()];
                (self.effects)(q, s, u, &mut values)?;
                robot.description().generalized_errors(&values, into.as_chunks_mut().0);
                return Ok(());
            }
            _ => return Err(Error::NoFunction(function)),
        };
        results[0].copy_from_slice(pose.0.as_flattened());
        Ok(())
    }
}
