//! One cycle of a controller: commands in, corrected commands out. It allocates nothing, never panics, and takes the same number of
//! steps every time.
#![no_std]

include!(concat!(env!("OUT_DIR"), "/pps.rs"));

use pps::{Inputs, Parameters, VARIABLES};

/// Lengths of the slides in mm, angles in rad.
pub type Joints = [f64; VARIABLES];

/// How far a drive may be sent from its command. What wants more has a wrong model, not a larger error.
pub const LARGEST: Joints = [20.0, 20.0, 20.0, 0.02, 0.02, 0.02];

/// Why the drives are held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// The command, or what follows from it, is not finite.
    Model(abbe::Error),
    /// This variable would go further from its command than it may.
    TooFar(usize),
}

/// What is kept from cycle to cycle: what the machine is, and where its drives were sent last.
#[derive(Clone, Debug)]
pub struct Controller {
    parameters: Parameters,
    inputs: Inputs,
    drives: Joints,
}

impl Controller {
    /// Of a machine that stands at `drives`.
    pub const fn new(parameters: Parameters, inputs: Inputs, drives: Joints) -> Self {
        Self { parameters, inputs, drives }
    }

    /// What the drives get for a command. After a fault they are held where they are.
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

    /// Where the drives were sent last.
    pub const fn drives(&self) -> &Joints {
        &self.drives
    }
}
