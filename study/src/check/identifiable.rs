//! How many of the generalized errors measurements can tell apart.

use abbe::Manipulator;
use abbe::analysis::{Measurement, Parts, Workspace, identifiable_in_parts, random_joint_samples};
use abbe_interpreter::Interpreter;
use abbe_spec::diagnostic::Diagnostics;
use serde::Serialize;

use crate::notes::Notes;

/// Of the configurations.
const SEED: u64 = 1;

/// How many configurations show the rank of a chain whose longest part has so many transforms.
fn configurations(longest: usize) -> usize {
    (3 * longest).max(60)
}

/// One way to measure.
#[derive(Clone, Debug, Serialize)]
pub struct Identifiable {
    /// `pose` or `point`.
    pub measurement: &'static str,
    /// Whether the errors of a base frame are unknown too.
    pub base: bool,
    /// How many errors can be told apart; none where a sample could not be evaluated.
    pub rank: Option<usize>,
    /// How many there are.
    pub unknowns: usize,
    /// Why there is no rank.
    #[serde(skip)]
    pub reason: String,
}

/// Counts what can be identified when all joints are moved, and over how many configurations.
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
    let ways = [
        ("pose", Measurement::Pose, false),
        ("pose", Measurement::Pose, true),
        ("point", Measurement::Point, false),
        ("point", Measurement::Point, true),
    ];
    let mut counted = Vec::with_capacity(ways.len());
    for (name, measurement, base) in ways {
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
