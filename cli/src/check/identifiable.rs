//! How many of the generalized errors measurements can tell apart.

use abbe::Manipulator;
use abbe::analysis::{Measurement, Workspace, identifiable, joint_samples};
use serde::Serialize;

/// How many configurations show the rank: 60 that of any arm, more that of a very long chain.
pub(super) fn configurations(frames: usize) -> usize {
    (10 * frames).max(60)
}

/// One way to measure.
#[derive(Serialize)]
pub(super) struct Identified {
    pub(super) measurement: &'static str,
    /// Whether the errors of a base frame are unknown too.
    pub(super) base: bool,
    /// None where Euler rows do not exist at one of the samples.
    pub(super) rank: Option<usize>,
    pub(super) unknowns: usize,
}

/// Counts what can be identified when all joints are moved.
pub(super) fn count(manipulator: &dyn Manipulator) -> Vec<Identified> {
    let description = manipulator.description();
    let moved = (0..description.variables.len()).collect::<Vec<_>>();
    let samples = joint_samples(manipulator, &moved, configurations(description.frames.len()))
        .map(|workspace| workspace.reached());
    let ways = [
        ("pose", Measurement::Pose, false),
        ("pose", Measurement::Pose, true),
        ("point", Measurement::Point, false),
        ("point", Measurement::Point, true),
    ];
    let counted = ways.into_iter().map(|(name, measurement, base)| {
        let samples = samples.as_ref().ok();
        let found = samples.and_then(|samples| identifiable(manipulator, samples, measurement, base).ok());
        Identified {
            measurement: name,
            base,
            rank: found.map(|found| found.rank),
            unknowns: 6 * (description.frames.len() + usize::from(base)),
        }
    });
    counted.collect()
}
