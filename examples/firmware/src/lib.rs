//! One cycle of a controller: takes commands and returns compensated commands. It never allocates
//! or panics, and its number of steps is constant.
#![no_std]

include!(concat!(env!("OUT_DIR"), "/pps.rs"));

use pps::{Inputs, Parameters, VARIABLES};

/// Positions of the prismatic joints in mm, angles in rad.
pub type Joints = [f64; VARIABLES];

/// Largest correction of a command. A larger one indicates a wrong model.
pub const LARGEST: Joints = [20.0, 20.0, 20.0, 0.02, 0.02, 0.02];

/// Reason for holding the drives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// The command or a result is not finite.
    Model(abbe::Error),
    /// The correction of this variable exceeds its limit.
    TooFar(usize),
}

/// State of the controller: the parameters of the machine, and the last commands of its drives.
#[derive(Clone, Debug)]
pub struct Controller {
    parameters: Parameters,
    inputs: Inputs,
    drives: Joints,
}

impl Controller {
    /// Creates the controller of a machine whose drives are at `drives`.
    pub const fn new(parameters: Parameters, inputs: Inputs, drives: Joints) -> Self {
        Self { parameters, inputs, drives }
    }

    /// Returns the commands of the drives for a command. After a fault the drives hold their
    /// position.
    pub fn cycle(&mut self, command: &Joints) -> Result<Joints, Fault> {
        let corrected = pps::compensated(command, &self.parameters, &self.inputs).map_err(Fault::Model)?.q;
        for (variable, far) in LARGEST.iter().enumerate() {
            if (corrected[variable] - command[variable]).abs() > *far {
                return Err(Fault::TooFar(variable));
            }
        }
        self.drives = corrected;
        Ok(corrected)
    }

    /// Returns the last commands of the drives.
    pub const fn drives(&self) -> &Joints {
        &self.drives
    }
}
