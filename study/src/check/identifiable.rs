//! Number of generalized errors that measurements can identify.

use abbe::Manipulator;
use abbe::analysis::{Measurement, Parts, Workspace, identifiable_in_parts, random_joint_samples};
use abbe_interpreter::Interpreter;
use abbe_spec::diagnostic::Diagnostics;
use serde::Serialize;

use crate::notes::Notes;

/// Seed of the sampled configurations.
const SEED: u64 = 1;

/// Returns the number of configurations that is enough for the rank of a chain whose longest part
/// has this many transforms.
fn configurations(longest: usize) -> usize {
    (3 * longest).max(60)
}

/// Identifiability for one kind of measurement.
#[derive(Clone, Debug, Serialize)]
pub struct Identifiable {
    /// Kind of measurement: `pose` or `point`.
    pub measurement: &'static str,
    /// Indicates that the six errors of an unknown base frame count as unknowns.
    pub base: bool,
    /// Number of identifiable combinations of errors: the rank of the observation matrix. `None` if
    /// a sample could not be evaluated.
    pub rank: Option<usize>,
    /// Number of unknown errors.
    pub unknowns: usize,
    /// Reason for a missing rank.
    #[serde(skip)]
    pub reason: String,
}

/// Counts the identifiable errors when all joints move. Returns the counts and the number of
/// configurations.
pub(super) fn count(
    manipulator: &Interpreter,
    notes: &mut dyn Notes,
) -> Result<(Vec<Identifiable>, usize), Diagnostics> {
    let description = manipulator.description();
    let parts = Parts::new(&manipulator.spec().variables_of_transforms());
    let moved = (0..description.variables.len()).collect::<Vec<_>>();
    let configurations = configurations(parts.longest());
    let samples = random_joint_samples(manipulator, &moved, configurations, SEED)
        .map(|workspace| workspace.reached())
        .map_err(|error| error.to_string());
    let measurements = [
        ("pose", Measurement::Pose, false),
        ("pose", Measurement::Pose, true),
        ("point", Measurement::Point, false),
        ("point", Measurement::Point, true),
    ];
    let mut counted = Vec::with_capacity(measurements.len());
    for (name, measurement, base) in measurements {
        notes.go_on()?;
        let found = samples.as_ref().map_err(String::clone).and_then(|samples| {
            identifiable_in_parts(manipulator, &parts, samples, measurement, base)
                .map_err(|error| error.to_string())
        });
        counted.push(Identifiable {
            measurement: name,
            base,
            rank: found.as_ref().ok().map(|found| found.rank),
            reason: found.err().unwrap_or_default(),
            unknowns: 6 * (description.frames.len() + usize::from(base)),
        });
    }
    Ok((counted, configurations))
}
