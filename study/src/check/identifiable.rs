//! How many of the generalized errors measurements can tell apart.

use abbe::Manipulator;
use abbe::analysis::{Measurement, Workspace, identifiable, joint_samples};
use abbe_codegen::spec::{Orientation, Spec};
use abbe_interpreter::Interpreter;
use serde::Serialize;

/// How many configurations show the rank: 60 that of any arm, more that of a very long chain.
pub(super) fn configurations(frames: usize) -> usize {
    (10 * frames).max(60)
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

/// Counts what can be identified when all joints are moved.
///
/// What measurements tell does not depend on how orientations are written: small rotations are taken, which exist
/// everywhere, also where Euler rows do not.
pub(super) fn count(spec: &Spec) -> Vec<Identifiable> {
    let spec = Spec { orientation: Orientation::RotationVector, ..spec.clone() };
    let manipulator = &Interpreter::new(spec);
    let description = manipulator.description();
    let moved = (0..description.variables.len()).collect::<Vec<_>>();
    let samples = joint_samples(manipulator, &moved, configurations(description.frames.len()))
        .map(|workspace| workspace.reached())
        .map_err(|error| error.to_string());
    let ways = [
        ("pose", Measurement::Pose, false),
        ("pose", Measurement::Pose, true),
        ("point", Measurement::Point, false),
        ("point", Measurement::Point, true),
    ];
    let counted = ways.into_iter().map(|(name, measurement, base)| {
        let found = samples.as_ref().map_err(String::clone).and_then(|samples| {
            identifiable(manipulator, samples, measurement, base).map_err(|error| error.to_string())
        });
        Identifiable {
            measurement: name,
            base,
            rank: found.as_ref().ok().map(|found| found.rank),
            reason: found.err().unwrap_or_default(),
            unknowns: 6 * (description.frames.len() + usize::from(base)),
        }
    });
    counted.collect()
}
