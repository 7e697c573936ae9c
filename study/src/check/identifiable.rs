//! Number of generalized errors that measurements can identify.

use std::{convert::Infallible, ops::ControlFlow};

use abbe::analysis::{
    Configuration, Measurement, Parts, Workspace, identifiable, identifiable_in_parts, in_order_until,
    random_joint_samples,
};
use abbe::{Error, Manipulator};
use abbe_interpreter::Interpreter;
use serde::Serialize;

use crate::{Notes, Result, number};

/// Seed of the sampled configurations.
const SEED: u64 = 1;

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

/// Counts of identifiable errors.
#[derive(Default)]
pub(super) struct Counted {
    pub(super) list: Vec<Identifiable>,
    /// Number of configurations with closed loops.
    pub(super) configurations: usize,
    /// Sentence about configurations at which loops do not close.
    pub(super) remark: Option<String>,
}

/// Counts the identifiable errors when all joints move.
pub(super) fn count(manipulator: &Interpreter, notes: &mut dyn Notes) -> Result<Counted> {
    let description = manipulator.description();
    let parts = Parts::new(&manipulator.spec().variables_of_transforms());
    let is_chain = manipulator.spec().is_serial();
    let moved = (0..description.variables.len()).collect::<Vec<_>>();
    // Without loops, only the frames that carry the tool have columns that are not zero.
    let carrying =
        std::iter::successors(description.tool_frame(), |frame| description.parent(*frame)).count();
    let longest = match () {
        () if is_chain => parts.longest(),
        () if description.has_loops() => description.frames.len() + 1,
        () => carrying + 1,
    };
    // Enough for the rank of a chain whose longest part has this many transforms.
    let configurations = (3 * longest).max(60);
    let samples = random_joint_samples(manipulator, &moved, configurations, SEED)
        .map(|workspace| workspace.reached())
        .map_err(|error| error.to_string());
    let is_open = |at: &Configuration| manipulator.pose(&at.q, &at.s).is_err_and(|error| error.is_open());
    let (open, samples) = match samples {
        Ok(all) => {
            let (open, closed): (Vec<_>, Vec<_>) = all.into_iter().partition(is_open);
            (open, if closed.is_empty() { Err(Error::NotClosed.to_string()) } else { Ok(closed) })
        }
        error => (Vec::new(), error),
    };
    let remark = open.first().map(|first| {
        let joints = number::variables(&first.q, manipulator.spec());
        format!(
            "The loops do not close at {} of {configurations} configurations within the joint limits, such as \
             {joints}: narrow the limits to where they close.",
            open.len()
        )
    });
    let measurements = [
        ("pose", Measurement::Pose, false),
        ("pose", Measurement::Pose, true),
        ("point", Measurement::Point, false),
        ("point", Measurement::Point, true),
    ];
    let mut counted = Vec::with_capacity(measurements.len());
    let count = |i: usize| {
        let (name, measurement, base) = measurements[i];
        let found = samples.as_ref().map_err(String::clone).and_then(|samples| {
            let found = match is_chain {
                true => identifiable_in_parts(manipulator, &parts, samples, measurement, base),
                false => identifiable(manipulator, samples, measurement, base),
            };
            found.map_err(|error| error.to_string())
        });
        Ok::<_, Infallible>(Identifiable {
            measurement: name,
            base,
            rank: found.as_ref().ok().map(|found| found.rank),
            reason: found.err().unwrap_or_default(),
            unknowns: 6 * (description.frames.len() + usize::from(base)),
        })
    };
    in_order_until(measurements.len(), count, |one| {
        counted.push(one);
        if notes.stop() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    })
    .unwrap_or_else(|never| match never {});
    notes.go_on()?;
    let configurations = samples.map_or(configurations, |closed| closed.len());
    Ok(Counted { list: counted, configurations, remark })
}
