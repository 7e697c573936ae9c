//! A batch of a manipulator that has no code for lanes: configuration after configuration.

use super::{Path, Tiles};
use crate::{Description, Error, Manipulator, Orientation, Pose};

/// What [`Manipulator::batch`] is by default. What is not finite, or not defined, becomes NaN.
pub(crate) fn one_by_one(
    manipulator: &(impl Manipulator + ?Sized),
    path: Path,
    arguments: &Tiles,
    results: &mut Tiles,
) -> Result<(), Error> {
    let description = manipulator.description();
    path.check(description, arguments, results)?;
    let mut given = vec![0.0; arguments.rows()];
    for configuration in 0..arguments.count() {
        arguments.copy_rows(0..arguments.rows(), configuration, &mut given);
        let values = values(manipulator, description, path, &given);
        let values = values.unwrap_or_else(|_| vec![f64::NAN; results.rows()]);
        for (row, value) in values.into_iter().enumerate() {
            results.set_value(row, configuration, value);
        }
    }
    results.pad();
    Ok(())
}

fn values(
    manipulator: &(impl Manipulator + ?Sized),
    description: &Description,
    path: Path,
    given: &[f64],
) -> Result<Vec<f64>, Error> {
    let Description { variables, parameters, inputs, frames, sources, effects, .. } = description;
    let (q, rest) = given.split_at(variables.len());
    let (s, rest) = rest.split_at(parameters.len());
    let (u, errors) = rest.split_at(inputs.len());
    let euler = description.orientation == Orientation::EulerYzx;
    if path == Path::Pose {
        return Ok(manipulator.pose(q, s)?.0.concat());
    }
    let mut columns = vec![[0.0; 6]; 6 * frames.len()];
    let pose = manipulator.error_jacobian(q, s, &mut columns)?;
    let margin = |mut values: Vec<f64>| {
        values.extend(euler.then(|| cosine(&pose)));
        values
    };
    let sum = |errors: &[f64]| {
        let parts = columns.iter().zip(errors).map(|(column, error)| column.map(|entry| entry * error));
        parts.fold([0.0; 6], |sum, part| core::array::from_fn(|row| sum[row] + part[row]))
    };
    let repeatable = || -> Result<Vec<f64>, Error> {
        let mut errors = vec![[0.0; 6]; frames.len()];
        manipulator.generalized_errors(q, s, u, &mut errors)?;
        Ok(errors.concat())
    };
    Ok(match path {
        Path::Pose => pose.0.concat(),
        Path::ErrorJacobian => margin([pose.0.concat(), columns.concat()].concat()),
        Path::DistinctErrorJacobian => {
            let mut values = pose.0.concat();
            for frame in columns.chunks_exact(6) {
                values.extend(frame.iter().flat_map(|column| &column[..3]));
                if euler {
                    values.extend(frame[3..].iter().flat_map(|column| &column[3..]));
                }
            }
            margin(values)
        }
        Path::Displacement => margin(sum(errors).to_vec()),
        Path::PredictedDisplacement => margin(sum(&repeatable()?).to_vec()),
        Path::SourceDisplacements => {
            let mut values = vec![0.0; effects.len()];
            manipulator.effects(q, s, u, &mut values)?;
            let mut displacements = vec![[0.0; 6]; sources.len()];
            for (effect, value) in effects.iter().zip(values) {
                let column = &columns[6 * effect.frame + effect.component.index()];
                let sum = &mut displacements[effect.source];
                *sum = core::array::from_fn(|row| sum[row] + column[row] * value);
            }
            margin(displacements.concat())
        }
        Path::Covariance => {
            let mut covariance = [[0.0; 6]; 6];
            for (column, variance) in columns.iter().zip(errors) {
                for (j, of) in covariance.iter_mut().enumerate() {
                    *of = core::array::from_fn(|i| of[i] + column[i] * variance * column[j]);
                }
            }
            margin(covariance.concat())
        }
    })
}

/// `cos ρ = √(r11² + r31²)`.
fn cosine(pose: &Pose) -> f64 {
    let [x, _, z] = pose.0[0];
    x.hypot(z)
}
