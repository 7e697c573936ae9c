//! The configurations at which laws are checked.

use super::{Configuration, Failure};
use crate::{Error, Manipulator, Pose, euler_margin, sampling, tool_pose};

/// Smallest `cos ρ` at which Euler rows are compared: differences lose digits near the singularity.
const EULER_MARGIN: f64 = 0.05;

/// Factor of all steps of a machine with loops, which large errors may prevent from closing.
const SMALLER: f64 = 0.02;

/// Largest deviation of a sampled parameter from its nominal value, as a share of it.
const SPREAD: f64 = 0.05;

/// Manipulator under test.
pub(super) struct Subject<'a> {
    pub(super) manipulator: &'a dyn Manipulator,
    /// Arm length: the unit of lengths.
    pub(super) arm: f64,
}

/// Configuration with the exact chain evaluated at it.
pub(super) struct Sample {
    pub(super) given: Configuration,
    /// `A_1 … A_n` and `T`.
    pub(super) transforms: Vec<Pose>,
    pub(super) pose: Pose,
    /// `cos ρ` for Euler rows, otherwise 1, and less with loops: factor by which steps are reduced.
    pub(super) margin: f64,
}

impl<'a> Subject<'a> {
    pub(super) fn new(manipulator: &'a dyn Manipulator) -> Result<Self, Failure> {
        let description = manipulator.description();
        let s = sampling::nominal_parameters(description);
        let arm = sampling::arm_length(manipulator, &s).map_err(|error| {
            let at = Configuration { q: sampling::home(description), s: s.clone(), u: Vec::new() };
            Failure::Evaluation { at, error }
        })?;
        Ok(Self { manipulator, arm })
    }

    /// Returns the samples at which all loops close and all rows exist, and the number of those
    /// skipped.
    pub(super) fn samples(&self, count: usize) -> Result<(Vec<Sample>, usize), Failure> {
        let description = self.manipulator.description();
        let mut samples = Vec::with_capacity(count);
        let mut open = None;
        for index in 0..count {
            let mut given = self.configuration(index);
            let mut transforms = self.transforms(&given.q, &given.s);
            if transforms.is_err() {
                // Some values of the parameters may not make a machine.
                given.s = sampling::nominal_parameters(description);
                transforms = self.transforms(&given.q, &given.s);
            }
            let transforms = match transforms {
                Err(error) if error.is_open() => {
                    open.get_or_insert(given);
                    continue;
                }
                transforms => transforms.map_err(|error| Failure::Evaluation { at: given.clone(), error })?,
            };
            let pose = tool_pose(description, &transforms, &[]);
            let margin = euler_margin(description.orientation, &pose);
            if margin >= EULER_MARGIN {
                let margin = if description.has_loops() { SMALLER * margin } else { margin };
                samples.push(Sample { given, transforms, pose, margin });
            }
        }
        let skipped = count - samples.len();
        if 2 * skipped > count {
            if let Some(at) = open {
                return Err(Failure::Evaluation { at, error: Error::NotClosed });
            }
            return Err(Failure::Skipped { skipped, samples: count });
        }
        Ok((samples, skipped))
    }

    /// Returns configuration `index`: joints within their limits, inputs within their ranges, and
    /// parameters within [`SPREAD`] of their nominal values.
    fn configuration(&self, index: usize) -> Configuration {
        let description = self.manipulator.description();
        let moved = (0..description.variables.len()).collect::<Vec<_>>();
        let mut dimension = moved.len();
        let mut between = |[lower, upper]: [f64; 2]| {
            let share = sampling::halton(index + 1, dimension);
            dimension += 1;
            lower + (upper - lower) * share
        };
        let u = description.inputs.iter().map(|input| {
            let size = self.size(input.nominal, &input.unit);
            let [lower, upper] = input.range;
            let lower = if lower.is_finite() { lower } else { upper.min(input.nominal) - size };
            let upper = if upper.is_finite() { upper } else { lower.max(input.nominal) + size };
            between([lower, upper])
        });
        let u = u.collect();
        let s = description.parameters.iter().map(|parameter| {
            let size = SPREAD * self.size(parameter.nominal, &parameter.unit);
            between([parameter.nominal - size, parameter.nominal + size])
        });
        let s = s.collect();
        Configuration { q: sampling::joint_sample(description, self.arm, &moved, index), s, u }
    }

    /// Returns the order of magnitude of a quantity: its nominal value, or if that is 0 an arm
    /// length or 1.
    fn size(&self, nominal: f64, unit: &str) -> f64 {
        if nominal != 0.0 {
            nominal.abs()
        } else if unit == self.manipulator.description().length.symbol() {
            self.arm
        } else {
            1.0
        }
    }

    /// Returns `A_1 … A_n` and `T`.
    pub(super) fn transforms(&self, q: &[f64], s: &[f64]) -> Result<Vec<Pose>, Error> {
        let mut transforms = vec![Pose::IDENTITY; self.manipulator.description().frames.len() + 1];
        self.manipulator.transforms(q, s, &mut transforms)?;
        Ok(transforms)
    }

    /// Returns the exact pose with errors of all frames.
    pub(super) fn displaced_pose(&self, at: &Sample, errors: &[[f64; 6]]) -> Result<Pose, Failure> {
        let description = self.manipulator.description();
        if description.is_chain() {
            return Ok(tool_pose(description, &at.transforms, errors));
        }
        let real = self.manipulator.displaced_pose(&at.given.q, &at.given.s, errors);
        real.map_err(|error| Failure::Evaluation { at: at.given.clone(), error })
    }

    /// Returns ΔX with rows 1–3 in arm lengths.
    pub(super) fn scaled(&self, row: [f64; 6]) -> [f64; 6] {
        core::array::from_fn(|i| if i < 3 { row[i] / self.arm } else { row[i] })
    }
}
