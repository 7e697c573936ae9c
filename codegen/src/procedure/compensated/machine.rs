//! Numbers of a manipulator, and tolerances of a precision.

use abbe_core::VariableKind;
use abbe_core::compensator::{DAMPING, LEAST_SINE, REACHED, REST, Status};
use abbe_spec::Spec;

/// Precision of the corrected command, with the tolerances that depend on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// Double precision.
    Double,
    /// Single precision.
    Single,
}

impl Precision {
    /// Damping of the steps, in metres and radians: λ, or its square root in single precision,
    /// where no squares are formed.
    pub(super) fn damping(self) -> f64 {
        match self {
            Self::Double => DAMPING,
            Self::Single => DAMPING.sqrt(),
        }
    }

    /// Step size for convergence, in radians and metres.
    pub(super) fn rest(self) -> f64 {
        match self {
            Self::Double => REST,
            Self::Single => 1e-5,
        }
    }

    /// Largest error of a pose that is reached: position in metres, rotation in rad. In single
    /// precision a pose is accurate to about 1e-6 m, which a singular value of 0.1 amplifies to
    /// 1e-5.
    pub(crate) fn reached(self) -> [f64; 2] {
        match self {
            Self::Double => REACHED,
            Self::Single => [1e-5; 2],
        }
    }

    /// Below this value the square of twice the sine of an angle underflows, and the angle itself
    /// is used.
    pub(super) fn least_sine(self) -> f64 {
        match self {
            Self::Double => LEAST_SINE,
            Self::Single => 1e-18,
        }
    }

    /// Returns the statuses with their numbers and meanings.
    pub(crate) fn statuses(self) -> String {
        let one = |status: Status| format!("{} `{}`: {}", status.code(), status.name(), self.meaning(status));
        Status::ALL.map(one).join(" ")
    }

    /// Returns the meaning of a status, with the bound of what is left where it is reached.
    pub(crate) fn meaning(self, status: Status) -> String {
        let [position, rotation] = self.reached().map(|bound| (bound * 1e6).round());
        match status {
            Status::Reached => format!(
                "{} At most {position} μm and {rotation} μrad of the rotations are left, up to rounding errors.",
                status.meaning(),
            ),
            _ => status.meaning().to_owned(),
        }
    }
}

/// Numbers of a manipulator.
pub(super) struct Machine<'s> {
    pub(super) spec: &'s Spec,
    pub(super) precision: Precision,
    /// Number of joint variables.
    pub(super) count: usize,
    /// One metre in the manipulator's unit.
    pub(super) metre: f64,
}

impl Machine<'_> {
    /// Returns 1 rad or 1 m in the unit of each variable.
    pub(super) fn units(&self) -> Vec<f64> {
        let unit = |kind: VariableKind| kind.either(1.0, self.metre);
        self.spec.variables.iter().map(|variable| unit(variable.kind)).collect()
    }
}

/// Largest number that bounds may have: sums of it are finite.
pub(super) const HUGE: f64 = 1e30;
