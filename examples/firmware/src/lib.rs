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
    /// A path begins further from the drives than a correction may be large.
    Elsewhere,
    /// The tool has been further from its target than [`TOLERANCE`] for more than [`SETTLING`]
    /// cycles: at a limit, or with a model whose corrections are larger than the bound.
    OffTarget(f64),
}

/// State of the controller: the parameters of the machine, the correction of the cycle before, the
/// last commands of its drives, and the fault that holds them.
#[derive(Clone, Debug)]
pub struct Controller {
    parameters: Parameters,
    inputs: Inputs,
    cycle: Cycle<Joints>,
    off_target: u32,
    drives: Joints,
    is_standing: bool,
    fault: Option<Fault>,
}

impl Controller {
    /// Creates the controller of a machine whose drives stand at `drives`.
    pub fn new(parameters: Parameters, inputs: Inputs, drives: Joints) -> Self {
        let cycle = pps::first_cycle();
        Self { parameters, inputs, cycle, off_target: 0, drives, is_standing: true, fault: None }
    }

    /// Returns the commands of the drives for a command, and what is left at them. After a fault
    /// the drives stand, until [`Self::reset`]. No cycle moves one further than its command and the
    /// bound of the change; the first one, no further than that bound.
    pub fn cycle(&mut self, command: &Joints) -> Result<Compensated<Joints>, Fault> {
        if let Some(fault) = self.fault {
            return Err(fault);
        }
        let done = self.corrected(command);
        self.is_standing = done.is_err();
        self.fault = done.err();
        done
    }

    fn corrected(&mut self, command: &Joints) -> Result<Compensated<Joints>, Fault> {
        if self.is_standing {
            self.cycle.resume(command, &self.drives);
            if self.cycle.last.iter().zip(&self.cycle.largest).any(|(far, most)| far.abs() > *most) {
                return Err(Fault::Elsewhere);
            }
        }
        let done = pps::compensated(command, &self.parameters, &self.inputs, &self.cycle);
        let done = done.map_err(Fault::Model)?;
        if done.status == Status::OutsideLimits {
            return Err(Fault::OutsideLimits);
        }
        let (distance, _) = norms(&done.after);
        self.off_target = if distance <= TOLERANCE { 0 } else { self.off_target + 1 };
        if self.off_target > SETTLING {
            return Err(Fault::OffTarget(distance));
        }
        self.cycle.last = done.correction;
        self.drives = done.q;
        Ok(done)
    }

    /// Stops: the drives stand where they are, and the next cycle resumes there.
    pub const fn hold(&mut self) {
        self.is_standing = true;
    }

    /// Ends a fault, with the drives where they stand now. The next cycle resumes there.
    pub const fn reset(&mut self, drives: Joints) {
        (self.drives, self.off_target) = (drives, 0);
        (self.is_standing, self.fault) = (true, None);
    }

    /// Returns the command that the drives carry out where they are: a path that begins there moves
    /// none of them.
    pub fn command(&self) -> Result<Joints, Fault> {
        let begun = pps::begin(&self.drives, &self.parameters, &self.inputs, self.cycle.rotations);
        Ok(begun.map_err(Fault::Model)?.command)
    }

    /// Returns the last commands of the drives.
    pub const fn drives(&self) -> &Joints {
        &self.drives
    }
}
