//! Where a machine touches: the joints at which readings have given values.

use nalgebra::{DMatrix, DVector};

use super::{Failure, Model, Observation};
use abbe_analysis::sampling;
use abbe_core::VariableKind;

/// What may be left of a reading, as a share of the arm or in rad.
const TOUCHED: f64 = 1e-11;

/// The joints, near those of an observation, at which each of the model's readings is what is wanted of it: length unit, rad.
///
/// Only joints in `moved` move, within their limits; Gauss and Newton, always the smallest step. None if that leads nowhere.
pub fn touched(
    model: &Model,
    observation: &Observation,
    x: &[f64],
    wanted: &[Option<f64>],
    moved: &[usize],
) -> Result<Option<Vec<f64>>, Failure> {
    let variables = &model.manipulator.description().variables;
    let arm = sampling::arm_length(model.manipulator, &model.s).map_err(Failure::Machine)?;
    let size = |j: &usize| if variables[*j].kind == VariableKind::Revolute { 1.0 } else { arm };
    let mut room = model.room();
    let mut place = observation.clone();
    let mut off = |place: &Observation| -> Result<DVector<f64>, Failure> {
        let values = model.values(&mut room, place, x)?;
        let readings = values.iter().zip(wanted).zip(&model.readings);
        let off = readings.filter_map(|((value, wanted), reading)| {
            Some((value - (*wanted)?) / if reading.gauge.is_angle() { 1.0 } else { arm })
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
        // Jᵀ (J Jᵀ + λ)⁻¹: a little λ where the machine is stretched out.
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
