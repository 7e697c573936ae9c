//! Determines how well readings define the scale of a machine.
//!
//! If all lengths of a machine and of its fixtures grow by a share s, every reading grows by s
//! times its gauge value: contacts stay in contact, and an unknown zero absorbs whatever is the
//! same in all rows. Prismatic joints have known travel, and known distances between fixtures are
//! lengths, so that both define the scale.

use abbe::identify::{
    Failure, Measurement, Model, Observable, Observation, ReferenceLength, SizeInformation, Unknown, groups,
};
use abbe::{Component, Error, Pose, VariableKind, analysis::sampling};

use abbe_study::number::digits;

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
    let mut at = ideal.at(&[]);
    let mut all: Vec<Vec<f64>> = vec![Vec::new(); ideal.observables.len()];
    for row in rows {
        let Measurement::Readings(read) = &row.measured else { continue };
        for (i, value) in at.values(row)?.into_iter().enumerate().filter(|(i, _)| read[*i].is_some()) {
            all[i].push(value - ideal.observables[i].zero);
        }
    }
    let mut information = 0.0;
    for (values, observable) in all.iter().zip(&ideal.observables).filter(|(values, _)| !values.is_empty()) {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let absorbed = match observable.kind.size {
            SizeInformation::None => continue,
            _ if observable.is_blind_to_size() => continue,
            SizeInformation::Length if observable.zero_known => 0.0,
            _ => mean,
        };
        information += values.iter().map(|v| ((v - absorbed) / observable.uncertainty).powi(2)).sum::<f64>();
    }
    information += ideal.known_distances.iter().map(|d| (d.length / d.uncertainty).powi(2)).sum::<f64>();
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
        _ if deviation > 0.1 => {
            let sentence = "These measurements do not determine the scale of the machine: scaling all its \
                            lengths does not change them, so the nominal one counts. A known length \
                            determines it: a calibrated bar, or a draw-wire sensor.";
            Some(sentence.to_owned())
        }
        _ => Some(format!(
            "These measurements determine the scale of the machine to {} mm per metre at best \
             (one standard deviation).",
            digits(1e3 * deviation, 2)
        )),
    })
}

/// Returns the largest length of the chain whose error is equivalent to no other; none if slides,
/// known distances or all readings determine the size of the machine, or without such a length.
///
/// Errors up to the first joint that moves are left out: they act as a displacement of the
/// fixtures.
pub(super) fn reference_length(
    ideal: &Model,
    q: &[f64],
    moved: &[usize],
) -> Result<Option<ReferenceLength>, Error> {
    let description = ideal.manipulator.description();
    let has_slides = moved.iter().any(|j| description.variables[*j].kind == VariableKind::Prismatic);
    // The frames of a chain follow each other.
    let is_determined = !description.is_chain() || has_slides || !ideal.known_distances.is_empty();
    if is_determined || !ideal.observables.iter().any(Observable::is_blind_to_size) {
        return Ok(None);
    }
    let moves = |frame: &abbe::Frame| frame.variable.is_some_and(|variable| moved.contains(&variable));
    let Some(first) = description.frames.iter().position(moves) else { return Ok(None) };
    let equivalent = groups(&ideal.with(ideal.constants(false)), q, moved, false)?;
    let is_own = |error: Unknown| {
        let has = |named: &[(Unknown, f64)]| named.iter().any(|(one, _)| *one == error);
        !equivalent.iter().any(|group| has(&group.these) || has(&group.act_as))
    };
    let mut transforms = vec![Pose::IDENTITY; description.frames.len() + 1];
    ideal.manipulator.transforms(q, &sampling::nominal_parameters(description), &mut transforms)?;
    let lengths = (first + 1..description.frames.len()).flat_map(|frame| {
        // An error of a frame is along its own axes: Rᵀ p.
        let [x, y, z, position] = transforms[frame].0;
        let along = |axis: [f64; 3]| (0..3).map(|i| axis[i] * position[i]).sum::<f64>();
        let components = [Component::X, Component::Y, Component::Z].into_iter().zip([x, y, z].map(along));
        components.map(move |(component, length)| ReferenceLength {
            error: Unknown::Error(frame, component),
            length,
        })
    });
    let own = lengths.filter(|one| is_own(one.error) && one.length != 0.0);
    Ok(own.max_by(|a, b| a.length.abs().total_cmp(&b.length.abs())))
}
