//! Determines how well readings define the scale of a machine.
//!
//! If all lengths of a machine and of its fixtures grow by a share s, every reading grows by s
//! times its gauge value: contacts stay in contact, and an unknown zero absorbs whatever is the
//! same in all rows. Prismatic joints have known travel and so define the scale.

use abbe::VariableKind;
use abbe::identify::{Failure, Measurement, Model, Observation, SizeInformation};

use crate::number::digits;

/// Computes the smallest possible standard deviation of the scale, as a share, with all other
/// unknowns known; infinite if the readings do not define it.
///
/// `moved` are the joints that move in these rows.
fn scale_uncertainty(ideal: &Model, rows: &[Observation], moved: &[usize]) -> Result<f64, Failure> {
    // A board has a known size.
    if ideal.camera.is_some() {
        return Ok(0.0);
    }
    let variables = &ideal.manipulator.description().variables;
    if moved.iter().any(|j| variables[*j].kind == VariableKind::Prismatic) {
        return Ok(0.0);
    }
    let mut scratch = ideal.scratch();
    let mut all: Vec<Vec<f64>> = vec![Vec::new(); ideal.observables.len()];
    for row in rows {
        let Measurement::Readings(read) = &row.measured else { continue };
        let values = ideal.values(&mut scratch, row, &[])?;
        for (i, value) in values.into_iter().enumerate().filter(|(i, _)| read[*i].is_some()) {
            all[i].push(value - ideal.observables[i].zero);
        }
    }
    let mut information = 0.0;
    for (values, observable) in all.iter().zip(&ideal.observables).filter(|(values, _)| !values.is_empty()) {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let absorbed = match observable.kind.size {
            SizeInformation::None => continue,
            _ if observable.kind.is_touched() && !observable.zero_known => continue,
            SizeInformation::Length if observable.zero_known => 0.0,
            _ => mean,
        };
        information += values.iter().map(|v| ((v - absorbed) / observable.uncertainty).powi(2)).sum::<f64>();
    }
    Ok(1.0 / information.sqrt())
}

/// Returns a note on the scale; none without readings or with a well-defined scale.
pub(crate) fn scale_note(
    ideal: &Model,
    rows: &[Observation],
    moved: &[usize],
) -> Result<Option<String>, Failure> {
    let deviation = scale_uncertainty(ideal, rows, moved)?;
    Ok(match deviation {
        _ if ideal.observables.is_empty() || deviation == 0.0 => None,
        _ if deviation > 0.1 => Some(
            "These measurements do not determine the scale of the machine: scaling all its \
             lengths does not change them. A known length determines it: a calibrated bar, or a \
             draw-wire sensor."
                .to_owned(),
        ),
        _ => Some(format!(
            "These measurements determine the scale of the machine to {} mm per metre at best \
             (one standard deviation).",
            digits(1e3 * deviation, 2)
        )),
    })
}
