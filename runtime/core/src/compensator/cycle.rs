//! Arguments and result of one cycle of a controller.

use crate::{Description, VariableKind};

/// Largest change of a correction from one cycle to the next, by default: rad and metres.
pub const CHANGE: [f64; 2] = [0.002, 0.001];

/// Largest correction by default: rad and metres.
pub const LARGEST: [f64; 2] = [0.05, 0.02];

/// Largest error that [`Status::Reached`] leaves: the distance of the tool point in metres, and the
/// angle of those rotations that are to be reached, in rad.
pub const REACHED: [f64; 2] = [1e-6, 1e-5];

/// Bounds of the corrections of one cycle, and the rotations to be reached.
///
/// Joint j of the corrected command stays within its limits and within `command + last ± change`.
/// Where these are apart, the limits have priority. Where `change` lets a correction return to
/// `± largest`, it does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cycle<Q> {
    /// Corrections of the previous cycle: [`Compensated::correction`]; zeros at first.
    pub last: Q,
    /// Largest change of each correction. A number that is not positive permits none.
    pub change: Q,
    /// Largest size of each correction. A number that is not positive permits none.
    pub largest: Q,
    /// Weights of the rotations about the x, y and z axis of the tool: 1 for a rotation that is to
    /// be reached, 0 for one that is free. `[1, 1, 1]` is the whole pose, `[0, 0, 0]` the
    /// position, `[1, 1, 0]` the position and the direction of the z axis.
    pub rotations: [f64; 3],
}

impl<const N: usize> Cycle<[f64; N]> {
    /// The whole pose, with corrections of any size: for commands that no cycle precedes.
    pub const UNBOUNDED: Self =
        Self { last: [0.0; N], change: [f64::INFINITY; N], largest: [f64::INFINITY; N], rotations: [1.0; 3] };

    /// Returns the first cycle of a controller: the whole pose, no correction before, and the
    /// bounds [`CHANGE`] and [`LARGEST`].
    pub fn first(description: &Description) -> Self {
        let each = |bounds: [f64; 2]| {
            core::array::from_fn(|j| {
                description.variables.get(j).map_or(0.0, |v| bound(description, v.kind, bounds))
            })
        };
        Self { last: [0.0; N], change: each(CHANGE), largest: each(LARGEST), rotations: [1.0; 3] }
    }

    /// Begins anew where the drives stand, at the start and after a stop: the next cycle, with
    /// `command`, moves none of them further than its `change`, however far a command within the
    /// limits is from them. One beyond a limit has [`Status::OutsideLimits`]: do not send it.
    pub fn resume(&mut self, command: &[f64; N], drives: &[f64; N]) {
        self.last = core::array::from_fn(|j| drives[j] - command[j]);
    }
}

/// Returns a bound in rad and metres in the unit of a variable.
pub fn bound(description: &Description, kind: VariableKind, [angle, length]: [f64; 2]) -> f64 {
    kind.either(angle, length / description.length.in_metres())
}

/// Outcome of a cycle. Whatever it is, the commands are within the limits and the bounds, and
/// [`Compensated::after`] is what is left at them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// At most [`REACHED`] is left.
    Reached = 0,
    /// The command is beyond a limit of its joints.
    OutsideLimits = 6,
    /// More is left, and a joint is at its limit or at a bound of the cycle.
    Held = 5,
    /// More is left, and more iterations would change it.
    NotConverged = 4,
    /// More is left that no joint can correct: too few joints, or a singular pose.
    NotReached = 7,
}

impl Status {
    /// Every status.
    pub const ALL: [Self; 5] =
        [Self::Reached, Self::NotConverged, Self::Held, Self::OutsideLimits, Self::NotReached];

    /// Returns the number of the status in generated code. The numbers 1 to 3 are failures.
    pub const fn code(self) -> u8 {
        self as u8
    }

    /// Returns the name of the status in generated code.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Reached => "OK",
            Self::NotConverged => "NOT_CONVERGED",
            Self::Held => "HELD",
            Self::OutsideLimits => "OUTSIDE_LIMITS",
            Self::NotReached => "NOT_REACHED",
        }
    }

    /// Returns the meaning of the status.
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::Reached => "The pose is reached.",
            Self::NotConverged => "The pose is not reached, and more steps would change the commands.",
            Self::Held => "The pose is not reached: a limit, `change` or `largest` holds a variable.",
            Self::OutsideLimits => "The command is beyond the limits of the variables.",
            Self::NotReached => {
                "The pose is not reached, and no variable can reduce what is left: there are too few, or the pose is \
                 singular."
            }
        }
    }
}

/// Compensated joint commands, with the errors before and after.
///
/// Errors are ΔX, real minus target: three lengths in `F_0`, then the rotation vector in rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compensated<Q> {
    /// Commands within the limits.
    pub q: Q,
    /// `q` minus the command, or minus its nearest value within the limits.
    pub correction: Q,
    /// ΔX at the original commands.
    pub before: [f64; 6],
    /// ΔX at `q`.
    pub after: [f64; 6],
    /// Outcome.
    pub status: Status,
}
