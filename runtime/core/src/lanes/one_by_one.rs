//! Batches for a manipulator without code for lanes: one configuration after the other.

use super::{Batches, Tiles, check};
use crate::twist::twist;
use crate::{
    Description, Error, Function, Manipulator, Pose, Result, distinct, drawn_pose, euler_margin,
    repeatable_magnitudes,
};

/// Wrapper that gives any manipulator batches: each configuration is evaluated by the methods of
/// [`Manipulator`].
///
/// A configuration whose result is not finite or not defined has NaN results. Where Euler rows are
/// singular, rows 1–3 of the functions of `J_e` are defined.
#[derive(Clone, Copy, Debug, Default)]
pub struct OneByOne<M>(pub M);

impl<M: Manipulator> Manipulator for OneByOne<M> {
    fn description(&self) -> &Description {
        self.0.description()
    }

    fn evaluate(&self, function: Function, arguments: &[&[f64]], results: &mut [&mut [f64]]) -> Result<()> {
        self.0.evaluate(function, arguments, results)
    }
}

impl<M: Manipulator> Batches for OneByOne<M> {
    fn batch(&self, function: Function, arguments: &Tiles, results: &mut Tiles) -> Result<()> {
        one_by_one(&self.0, function, arguments, results)
    }
}

/// Fills the results of a function, one configuration after the other.
pub fn one_by_one(
    manipulator: &(impl Manipulator + ?Sized),
    function: Function,
    arguments: &Tiles,
    results: &mut Tiles,
) -> Result<()> {
    let description = manipulator.description();
    check(function, description, arguments, results)?;
    let mut given = vec![0.0; arguments.rows()];
    for configuration in 0..arguments.count() {
        arguments.copy_rows(0..arguments.rows(), configuration, &mut given);
        let mut rest = given.as_slice();
        let mut arrays = function.signature().arguments.iter().map(|array| {
            let (values, others) = rest.split_at(array.len(description));
            rest = others;
            values
        });
        let [q, s, third, magnitudes] = core::array::from_fn(|_| arrays.next().unwrap_or_default());
        let values = Configuration { manipulator, description, q, s }.values(function, third, magnitudes);
        let values = values.unwrap_or_else(|_| vec![f64::NAN; results.rows()]);
        for (row, value) in values.into_iter().enumerate() {
            results.set_value(row, configuration, value);
        }
    }
    results.pad();
    Ok(())
}

/// Manipulator at one configuration.
struct Configuration<'a, M: ?Sized> {
    manipulator: &'a M,
    description: &'a Description,
    q: &'a [f64],
    s: &'a [f64],
}

impl<M: Manipulator + ?Sized> Configuration<'_, M> {
    /// Returns the results of a function, the margin last. `third` is the third argument: u, ε,
    /// variances, or a pose.
    fn values(&self, function: Function, third: &[f64], magnitudes: &[f64]) -> Result<Vec<f64>> {
        let Self { manipulator, description, q, s } = *self;
        let mut values = match function {
            Function::ErrorJacobian => {
                let (pose, columns) = self.error_jacobian()?;
                [flat(&[pose]), columns.concat()].concat()
            }
            Function::ErrorJacobianDistinct => self.distinct()?,
            Function::Displacement => self.displacement(third)?.to_vec(),
            Function::Covariance => self.covariance(third)?.concat(),
            Function::PredictedDisplacement => {
                self.displacement(&self.evaluated(Function::GeneralizedErrors, third)?)?.to_vec()
            }
            Function::SourceDisplacements => self.source_displacements(third)?.concat(),
            Function::RealPose => flat(&[self.real_pose(third)?]),
            Function::DrawnPose => flat(&[drawn_pose(self.manipulator, q, s, third, magnitudes)?]),
            Function::DisplacedPose => {
                let errors: Vec<[f64; 6]> =
                    third.chunks_exact(6).map(|six| core::array::from_fn(|i| six[i])).collect();
                flat(&[manipulator.displaced_pose(q, s, &errors)?])
            }
            Function::CompensatorStep => {
                let mut columns = vec![[0.0; 6]; q.len()];
                let pose = manipulator.joint_jacobian(q, s, &mut columns)?;
                let twists = columns.iter().flat_map(|column| twist(description.orientation, &pose, column));
                flat(&[self.real_pose(third)?]).into_iter().chain(twists).collect()
            }
            Function::Transforms
            | Function::Pose
            | Function::JointJacobian
            | Function::ParameterJacobian
            | Function::Effects
            | Function::GeneralizedErrors
            | Function::Passive
            | Function::LegForces
            | Function::Inverse => self.evaluated(function, third)?,
        };
        if function.signature().has_margin(description.orientation) {
            values.push(euler_margin(description.orientation, &manipulator.pose(q, s)?));
        }
        Ok(values)
    }

    /// Returns the results of a function without the margin. Manipulators need not have functions
    /// without results.
    fn evaluated(&self, function: Function, third: &[f64]) -> Result<Vec<f64>> {
        let signature = function.signature();
        let arrays = signature.results.iter();
        let mut values: Vec<Vec<f64>> = arrays.map(|array| vec![0.0; array.len(self.description)]).collect();
        let mut results: Vec<&mut [f64]> = values.iter_mut().map(Vec::as_mut_slice).collect();
        if results.iter().any(|result| !result.is_empty()) {
            let given = &[self.q, self.s, third][..signature.arguments.len()];
            self.manipulator.evaluate(function, given, &mut results)?;
        }
        Ok(values.concat())
    }

    /// Returns the pose and `J_e`. Singular Euler rows are NaN.
    fn error_jacobian(&self) -> Result<(Pose, Vec<[f64; 6]>)> {
        let mut columns = vec![[f64::NAN; 6]; 6 * self.description.frames.len()];
        match self.manipulator.error_jacobian(self.q, self.s, &mut columns) {
            Err(Error::EulerSingularity { .. }) => {
                columns.iter_mut().for_each(|column| column[3..].fill(f64::NAN));
                Ok((self.manipulator.pose(self.q, self.s)?, columns))
            }
            pose => Ok((pose?, columns)),
        }
    }

    /// Returns the pose, then the distinct numbers of each frame in the order of
    /// [`distinct::number`].
    fn distinct(&self) -> Result<Vec<f64>> {
        let (pose, columns) = self.error_jacobian()?;
        let mut values = flat(&[pose]);
        if !self.description.is_chain() {
            values.extend(columns.iter().flatten());
            return Ok(values);
        }
        for frame in columns.chunks_exact(6) {
            values.extend(frame.iter().flat_map(|column| &column[..3]));
            if distinct::vectors(self.description.orientation) > 6 {
                values.extend(frame[3..].iter().flat_map(|column| &column[3..]));
            }
        }
        Ok(values)
    }

    /// Returns `J_e ε`.
    fn displacement(&self, errors: &[f64]) -> Result<[f64; 6]> {
        let (_, columns) = self.error_jacobian()?;
        let parts = columns.iter().zip(errors).map(|(column, error)| column.map(|entry| entry * error));
        Ok(parts.fold([0.0; 6], |sum, part| core::array::from_fn(|row| sum[row] + part[row])))
    }

    /// Returns `J_e diag(σ²) J_eᵀ`.
    fn covariance(&self, variances: &[f64]) -> Result<[[f64; 6]; 6]> {
        let (_, columns) = self.error_jacobian()?;
        let mut covariance = [[0.0; 6]; 6];
        for (column, variance) in columns.iter().zip(variances) {
            for (j, sums) in covariance.iter_mut().enumerate() {
                *sums = core::array::from_fn(|i| sums[i] + column[i] * variance * column[j]);
            }
        }
        Ok(covariance)
    }

    fn source_displacements(&self, u: &[f64]) -> Result<Vec<[f64; 6]>> {
        let ((_, columns), effects) = (self.error_jacobian()?, self.evaluated(Function::Effects, u)?);
        let mut displacements = vec![[0.0; 6]; self.description.sources.len()];
        for (effect, value) in self.description.effects.iter().zip(effects) {
            let column = &columns[6 * effect.frame + effect.component.index()];
            let sum = &mut displacements[effect.source];
            *sum = core::array::from_fn(|row| sum[row] + column[row] * value);
        }
        Ok(displacements)
    }

    fn real_pose(&self, u: &[f64]) -> Result<Pose> {
        drawn_pose(self.manipulator, self.q, self.s, u, &repeatable_magnitudes(self.description))
    }
}

fn flat(poses: &[Pose]) -> Vec<f64> {
    poses.iter().flat_map(|pose| pose.0.concat()).collect()
}
