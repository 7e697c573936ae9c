//! Inverse kinematics of readings: joints at which observables have given values.

use nalgebra::{DMatrix, DVector};

use super::{Failure, Model, Observation};
use abbe_core::VariableKind;

/// Largest remaining difference, as a share of the arm or in rad.
const TOUCHED: f64 = 1e-11;

/// Solves for the joints at which each observable of the model has its wanted value; length unit,
/// rad.
///
/// Starts at the joints of an observation and changes those in `moved`, within their limits, by
/// Gauss-Newton steps of least norm. Returns none without convergence.
pub fn joints_at_values(
    model: &Model,
    observation: &Observation,
    x: &[f64],
    wanted: &[Option<f64>],
    moved: &[usize],
) -> Result<Option<Vec<f64>>, Failure> {
    let variables = &model.manipulator.description().variables;
    let arm = model.arm_length()?;
    let size = |j: &usize| if variables[*j].kind == VariableKind::Revolute { 1.0 } else { arm };
    let mut at = model.at(x);
    let mut place = observation.clone();
    let mut off = |place: &Observation| -> Result<DVector<f64>, Failure> {
        let values = at.values(place)?;
        let readings = values.iter().zip(wanted).zip(&model.observables);
        let off = readings.filter_map(|((value, wanted), reading)| {
            Some((value - (*wanted)?) / if reading.kind.is_angle { 1.0 } else { arm })
        });
        Ok(DVector::from_vec(off.collect()))
    };
    for _ in 0..60 {
        let here = off(&place)?;
        if here.amax() < TOUCHED {
            return Ok(Some(place.q.to_vec()));
        }
        let mut jacobian = DMatrix::zeros(here.len(), moved.len());
        for (column, j) in moved.iter().enumerate() {
            let mut near = place.clone();
            near.q[*j] += 1e-6 * size(j);
            jacobian.set_column(column, &((off(&near)? - &here) / 1e-6));
        }
        // Jᵀ (J Jᵀ + λ)⁻¹, with a small λ for singular configurations.
        let square = &jacobian * jacobian.transpose() + DMatrix::identity(here.len(), here.len()) * 1e-9;
        let Some(inverse) = square.cholesky() else { return Ok(None) };
        let step = -jacobian.transpose() * inverse.solve(&here);
        let share = (0.3 / step.norm().max(f64::MIN_POSITIVE)).min(1.0);
        for (j, by) in moved.iter().zip(step.iter()) {
            let [lower, upper] = variables[*j].limits;
            place.q[*j] = (place.q[*j] + share * by * size(j)).clamp(lower, upper);
        }
    }
    Ok(None)
}
