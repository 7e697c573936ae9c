//! The exact chain with the errors of all sources.

use std::{vec, vec::Vec};

use crate::{Class, Description, Error, Manipulator, Pose, Quantity, checks};

/// Returns the exact pose of the tool point with the errors of every source times its magnitude,
/// equation (6).
///
/// `magnitudes` has one entry per source: 1 for a repeatable source, the drawn value for a random
/// one, 0 to leave a source out. Errors of parameters of `A_i` apply first, `A_i(q + δq, s + δs)`;
/// then errors at other points of its link in the order of the spec, `L E_M L⁻¹`; then the sum of
/// the errors of the frame itself. Errors as for [`Manipulator::effects`].
pub fn drawn_pose<M: Manipulator + ?Sized>(
    manipulator: &M,
    q: &[f64],
    s: &[f64],
    u: &[f64],
    magnitudes: &[f64],
) -> Result<Pose, Error> {
    if let Some(pose) = manipulator.drawn_pose(q, s, u, magnitudes)? {
        return Ok(pose);
    }
    let description = manipulator.description();
    checks::length(Quantity::Magnitudes, [description.sources.len(), 1], magnitudes.len())?;
    let mut effects = vec![0.0; description.effects.len()];
    let mut errors = vec![[0.0; 6]; description.frames.len()];
    manipulator.effects(q, s, u, &mut effects)?;
    for (effect, value) in description.effects.iter().zip(effects) {
        errors[effect.frame][effect.component.index()] += value * magnitudes[effect.source];
    }
    manipulator.displaced_pose(q, s, &errors)
}

/// Returns the magnitudes that select the repeatable sources: 1 for each repeatable source, 0 for
/// each random one.
pub fn repeatable_magnitudes(description: &Description) -> Vec<f64> {
    let one = |class| if class == Class::Repeatable { 1.0 } else { 0.0 };
    description.sources.iter().map(|source| one(source.class)).collect()
}
