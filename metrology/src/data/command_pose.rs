//! Joints of rows that have the pose of the tool in their place.

use abbe::Pose;
use abbe::analysis::{InverseKinematics, sampling};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_study::{Result, mistake};

use super::{Channel, Column, Turn, rotation};

/// Columns of the pose at which the controller has the tool of the nominal machine.
#[derive(Clone, Debug)]
pub(crate) struct CommandPose {
    pub(super) position: [Column; 3],
    /// Factor of the position to coherent units.
    pub(super) factor: f64,
    pub(super) turn: Turn,
    pub(super) spec: Box<Spec>,
}

impl CommandPose {
    /// Returns its columns, in the order of their numbers.
    pub(super) fn columns(&self) -> impl Iterator<Item = &Column> {
        self.position.iter().chain(self.turn.columns())
    }

    /// Returns the joints before the first row, at home, as channels.
    pub(super) fn joints(spec: &Spec) -> Vec<Channel> {
        spec.variables.iter().map(|variable| Channel::Fixed(variable.home)).collect()
    }

    /// Returns the nominal machine, by which poses become joints.
    pub(super) fn machine(&self) -> Interpreter {
        Interpreter::new((*self.spec).clone())
    }

    /// Returns the joints at which the nominal machine has its tool at the pose of some numbers: of
    /// all, those nearest to `last`.
    pub(super) fn joints_at(
        &self,
        machine: &InverseKinematics<'_>,
        last: &[f64],
        numbers: &[f64],
    ) -> Result<Vec<f64>, String> {
        let [x, y, z] = rotation::from_numbers(&self.turn, &numbers[3..])?;
        let position = [0, 1, 2].map(|axis| numbers[axis] * self.factor);
        let unreached = || "the nominal machine does not reach this pose".to_owned();
        let found = machine.solve(last, &Pose([x, y, z, position]));
        found.map_err(|reason| format!("{}: {reason}", unreached()))?.into_iter().next().ok_or_else(unreached)
    }
}

/// Prepares the nominal machine for the poses of rows.
pub(super) fn inverse(machine: &Interpreter) -> Result<InverseKinematics<'_>> {
    let description = abbe::Manipulator::description(machine);
    let s = sampling::nominal_parameters(description);
    let help = "name columns for the joints in `[joints]`";
    InverseKinematics::new(machine, &s)
        .map_err(|reason| mistake::with_help(&description.name, reason.to_string(), help))
}
