//! One cycle of a controller: takes commands and returns compensated commands. It never allocates
//! or panics, and its number of steps is constant.
#![no_std]

include!(concat!(env!("OUT_DIR"), "/pps.rs"));

use abbe::compensator::{Compensated, Cycle, Status, norms};
use pps::{Inputs, Parameters, VARIABLES};

/// Positions of the prismatic joints in mm, angles in rad.
pub type Joints = [f64; VARIABLES];

/// Distance of the tool from its target, in mm, that is no fault.
pub const TOLERANCE: f64 = 0.1;

/// Number of cycles in which the tool may be further away: the first correction moves in by the
/// bound of a cycle, 1 mm and 2 mrad.
pub const SETTLING: u32 = 50;

/// Reason for holding the drives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// The command or a result is not finite.
    Model(abbe::Error),
    /// The command is beyond the limits of the joints.
    OutsideLimits,
    /// The tool has been further from its target than [`TOLERANCE`] for more than [`SETTLING`]
    /// cycles: at a limit, or with a model whose corrections are larger than the bound.
    OffTarget(f64),
}

/// State of the controller: the parameters of the machine, the correction of the cycle before, and
/// the last commands of its drives.
#[derive(Clone, Debug)]
pub struct Controller {
    parameters: Parameters,
    inputs: Inputs,
    cycle: Cycle<Joints>,
    off_target: u32,
    drives: Joints,
}

impl Controller {
    /// Creates the controller of a machine whose drives are at `drives`.
    pub fn new(parameters: Parameters, inputs: Inputs, drives: Joints) -> Self {
        Self { parameters, inputs, cycle: pps::first_cycle(), off_target: 0, drives }
    }

    /// Returns the commands of the drives for a command, and what is left at them. After a fault
    /// the drives hold their position.
    pub fn cycle(&mut self, command: &Joints) -> Result<Compensated<Joints>, Fault> {
        let done = pps::compensated(command, &self.parameters, &self.inputs, &self.cycle);
        let done = done.map_err(Fault::Model)?;
        let (distance, _) = norms(&done.after);
        if done.status == Status::OutsideLimits {
            return Err(Fault::OutsideLimits);
        }
        self.off_target = if distance <= TOLERANCE { 0 } else { self.off_target + 1 };
        if self.off_target > SETTLING {
            self.off_target = SETTLING;
            return Err(Fault::OffTarget(distance));
        }
        self.cycle.last = done.correction;
        self.drives = done.q;
        Ok(done)
    }

    /// Returns the last commands of the drives.
    pub const fn drives(&self) -> &Joints {
        &self.drives
    }
}
