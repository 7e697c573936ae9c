//! Whether readings tell how large a machine is.
//!
//! A machine that is larger in all its lengths by a share s, together with all that stands still, has readings larger by s times
//! their gauge: what touches still touches, and an unknown zero takes on what is the same in all rows. What joints slide is
//! known, and tells the size.

use abbe::VariableKind;
use abbe::identify::{Failure, Gauge, Measurement, Model, Observation};

use crate::number::digits;

/// How well these readings tell the scale at best: one standard deviation, as a share; infinite if not at all.
///
/// `moved` are the joints that these rows move. All other unknowns would have to be known for this.
fn scale_uncertainty(ideal: &Model, rows: &[Observation], moved: &[usize]) -> Result<f64, Failure> {
    let variables = &ideal.manipulator.description().variables;
    if moved.iter().any(|j| variables[*j].kind == VariableKind::Prismatic) {
        return Ok(0.0);
    }
    let mut room = ideal.room();
    let mut all: Vec<Vec<f64>> = vec![Vec::new(); ideal.readings.len()];
    for row in rows {
        let Measurement::Readings(read) = &row.measured else { continue };
        let values = ideal.values(&mut room, row, &[])?;
        for (i, value) in values.into_iter().enumerate().filter(|(i, _)| read[*i].is_some()) {
            all[i].push(value - ideal.readings[i].zero);
        }
    }
    let mut information = 0.0;
    for (values, reading) in all.iter().zip(&ideal.readings).filter(|(values, _)| !values.is_empty()) {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let told = match reading.gauge {
            Gauge::Lean { .. } | Gauge::Apart { .. } => continue,
            _ if reading.touched && !reading.zero_known => continue,
            Gauge::Distance { .. } | Gauge::Between { .. } | Gauge::Moved { .. } if reading.zero_known => 0.0,
            _ => mean,
        };
        information += values.iter().map(|v| ((v - told) / reading.uncertainty).powi(2)).sum::<f64>();
    }
    Ok(1.0 / information.sqrt())
}

/// What is to be said of that; nothing where there are no readings.
pub(crate) fn scale_note(
    ideal: &Model,
    rows: &[Observation],
    moved: &[usize],
) -> Result<Option<String>, Failure> {
    let deviation = scale_uncertainty(ideal, rows, moved)?;
    Ok(match deviation {
        _ if ideal.readings.is_empty() || deviation == 0.0 => None,
        _ if deviation > 0.1 => Some(
            "These readings cannot tell how large the machine is: with all its lengths larger by the same share it would \
             give the same ones. A length that is known tells it: a bar that is calibrated, or a wire that is drawn out."
                .to_owned(),
        ),
        _ => Some(format!(
            "How large the machine is, all its lengths together, these readings tell to {} mm per metre at best (one \
             standard deviation).",
            digits(1e3 * deviation, 2)
        )),
    })
}
