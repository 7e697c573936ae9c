//! The configurations at which laws are checked.

use super::Failure;
use crate::sampling;
use crate::{Error, Manipulator, Pose, chain, euler_margin};

/// Smallest `cos ρ` at which Euler rows are compared: differences lose digits near the singularity.
const EULER_MARGIN: f64 = 0.05;

/// Manipulator under test, with its nominal parameters and inputs.
pub(super) struct Subject<'a> {
    pub(super) manipulator: &'a dyn Manipulator,
    pub(super) s: Vec<f64>,
    pub(super) u: Vec<f64>,
    /// Arm length: the unit of lengths.
    pub(super) arm: f64,
}

/// Configuration with the exact chain evaluated at it.
pub(super) struct Sample {
    pub(super) q: Vec<f64>,
    /// `A_1 … A_n` and `T`.
    pub(super) transforms: Vec<Pose>,
    pub(super) pose: Pose,
    /// `cos ρ` for Euler rows, otherwise 1: factor by which steps are reduced.
    pub(super) margin: f64,
}

impl<'a> Subject<'a> {
    pub(super) fn new(manipulator: &'a dyn Manipulator) -> Result<Self, Failure> {
        let description = manipulator.description();
        let s = sampling::nominal_parameters(description);
        let u = sampling::nominal_inputs(description);
        let arm = sampling::arm_length(manipulator, &s)
            .map_err(|error| Failure::Evaluation { q: sampling::home(description), error })?;
        Ok(Self { manipulator, s, u, arm })
    }

    /// Returns the samples at which all rows exist, and the number of those skipped.
    pub(super) fn samples(&self, count: usize) -> Result<(Vec<Sample>, usize), Failure> {
        let description = self.manipulator.description();
        let moved = (0..description.variables.len()).collect::<Vec<_>>();
        let mut samples = Vec::with_capacity(count);
        for index in 0..count {
            let q = sampling::joint_sample(description, self.arm, &moved, index);
            let transforms =
                self.transforms(&q, &self.s).map_err(|error| Failure::Evaluation { q: q.clone(), error })?;
            let pose = chain(&transforms);
            let margin = euler_margin(description.orientation, &pose);
            if margin >= EULER_MARGIN {
                samples.push(Sample { q, transforms, pose, margin });
            }
        }
        let skipped = count - samples.len();
        if 2 * skipped > count {
            return Err(Failure::Skipped { skipped, samples: count });
        }
        Ok((samples, skipped))
    }

    /// Returns `A_1 … A_n` and `T`.
    pub(super) fn transforms(&self, q: &[f64], s: &[f64]) -> Result<Vec<Pose>, Error> {
        let frames = self.manipulator.description().frames.len();
        let mut transforms = vec![Pose::IDENTITY; frames + 1];
        self.manipulator.transforms(q, s, &mut transforms)?;
        Ok(transforms)
    }

    /// Returns ΔX with rows 1–3 in arm lengths.
    pub(super) fn scaled(&self, row: [f64; 6]) -> [f64; 6] {
        core::array::from_fn(|i| if i < 3 { row[i] / self.arm } else { row[i] })
    }
}
