//! Numbers of a manipulator, and tolerances of a precision.
//!
//! Error of a pose, its weights, and its cost.

use abbe_core::VariableKind;
use abbe_core::compensator::{AT_LIMIT, DAMPING, LEAST_SINE, LEVER, REACHED, REST, Status};
use abbe_spec::Spec;

use crate::procedure::build::Array;
use crate::procedure::{Body, Condition, Procedure, Value};

/// Precision of the corrected command, with the tolerances that depend on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// Double precision.
    Double,
    /// Single precision.
    Single,
}

/// Tolerances of the corrected command.
pub(crate) struct Tolerances {
    /// Damping of the steps, in metres and radians: λ, or its square root in single precision,
    /// where no squares are formed.
    pub(super) damping: f64,
    /// Step size for convergence, in radians and metres.
    pub(super) rest: f64,
    /// Share of a command by which it may be beyond a limit.
    pub(super) at_limit: f64,
    /// Largest error of a pose that is reached: position in metres, rotation in rad. In single
    /// precision a pose is accurate to about 1e-6 m, which a singular value of 0.1 amplifies to
    /// 1e-5.
    pub(crate) reached: [f64; 2],
    /// Below this value the square of twice the sine of an angle underflows, and the angle itself
    /// is used.
    pub(super) least_sine: f64,
}

impl Precision {
    /// Returns the tolerances of the precision.
    pub(crate) fn tolerances(self) -> Tolerances {
        match self {
            Self::Double => Tolerances {
                damping: DAMPING,
                rest: REST,
                at_limit: AT_LIMIT,
                reached: REACHED,
                least_sine: LEAST_SINE,
            },
            Self::Single => Tolerances {
                damping: DAMPING.sqrt(),
                rest: 1e-5,
                at_limit: 4.0 * f64::from(f32::EPSILON),
                reached: [1e-5; 2],
                least_sine: 1e-18,
            },
        }
    }

    /// Returns the statuses with their numbers and meanings.
    pub(crate) fn statuses(self) -> String {
        let one = |status: Status| format!("{} `{}`: {}", status.code(), status.name(), self.meaning(status));
        Status::ALL.map(one).join(" ")
    }

    /// Returns the meaning of a status, with the bound of what is left where it is reached.
    pub(crate) fn meaning(self, status: Status) -> String {
        let [position, rotation] = self.tolerances().reached.map(|bound| (bound * 1e6).round());
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

    /// Declares the limits of the variables.
    pub(super) fn limits(&self, b: &mut Body<'_>) -> [Array; 2] {
        [("lower_limits", 0), ("upper_limits", 1)].map(|(name, end)| {
            let limits: Vec<f64> = self.spec.variables.iter().map(|one| one.limits[end]).collect();
            b.constant(name, &limits)
        })
    }

    /// Returns the condition that the position and the weighted rotations are reached.
    pub(super) fn reached(&self, b: &mut Body<'_>, axes: Array, left: Array) -> Condition {
        let weights = b.array("weights", 6);
        let [far, angle] = ["far", "angle"].map(|name| b.real(name));
        b.call("weighted", [axes, left], weights);
        b.set(far, weights.dot(weights, [0, 3], |k| [k, k]).sqrt());
        b.set(angle, weights.dot(weights, [3, 6], |k| [k, k]).sqrt());
        let [position, rotation] = self.precision.tolerances().reached;
        let is_near = Value::from(position).is_at_least(far);
        is_near.and(Value::from(rotation * LEVER).is_at_least(angle))
    }
}

/// Largest number that bounds may have: sums of it are finite.
pub(super) const HUGE: f64 = 1e30;

/// Deviation of the real from the ideal pose.
pub(super) fn deviation(machine: &Machine<'_>) -> Procedure {
    let documentation = "Deviation of the real from the ideal pose: position in F_0, and the rotation vector of the real \
         rotation times the transposed ideal one.";
    Procedure::new("deviation", documentation, |b| {
        let [ideal, found] = ["ideal", "found"].map(|name| b.argument(name, 12));
        let rows = b.result("rows", 6);
        let (turn, v) = (b.array("turn", 9), b.array("v", 3));
        let [twice_sine, scale] = ["twice_sine", "scale"].map(|name| b.real(name));
        b.each("i", [0, 3], |b, i| {
            b.set(rows.at(i), found.at(i + 9) - ideal.at(i + 9));
            b.each("k", [0, 3], |b, k| {
                let [x, y, z] = [0, 3, 6].map(|axis| found.at(i + axis) * ideal.at(k + axis));
                b.set(turn.at(3 * i + k), x + y + z);
            });
        });
        b.set(v.at(0), turn.at(7) - turn.at(5));
        b.set(v.at(1), turn.at(2) - turn.at(6));
        b.set(v.at(2), turn.at(3) - turn.at(1));
        let square = |k: usize| v.at(k) * v.at(k);
        b.set(twice_sine, (square(0) + square(1) + square(2)).sqrt());
        b.set(scale, 0.5);
        b.when(twice_sine.get().is_at_least(machine.precision.tolerances().least_sine), |b| {
            let twice_cosine = turn.at(0) + turn.at(4) + turn.at(8) - 1.0;
            b.set(scale, twice_sine.get().atan2(twice_cosine) / twice_sine);
        });
        b.each("i", [0, 3], |b, i| b.set(rows.at(i + 3), v.at(i) * scale));
    })
}

/// Weights of an error.
pub(super) fn weighted(machine: &Machine<'_>) -> Procedure {
    let documentation = "Weights the position in metres, and the rotations about the weighted axes of the tool in rad: \
         1 rad counts as 1 mm, so that the position has priority.";
    Procedure::new("weighted", documentation, |b| {
        let (axes, rows) = (b.argument("axes", 9), b.argument("rows", 6));
        let weights = b.result("weights", 6);
        b.each("i", [0, 3], |b, i| {
            b.set(weights.at(i), rows.at(i) * (1.0 / machine.metre));
            b.set(weights.at(i + 3), axes.dot(rows, [0, 3], |k| [3 * i + k, k + 3]) * LEVER);
        });
    })
}

/// Square of a weighted error.
pub(super) fn cost() -> Procedure {
    Procedure::new("cost", "Sum of the squares of a weighted deviation.", |b| {
        let (axes, rows) = (b.argument("axes", 9), b.argument("rows", 6));
        let squares = b.result_real("squares");
        let weights = b.array("weights", 6);
        b.call("weighted", [axes, rows], weights);
        b.set(squares, weights.dot(weights, [0, 6], |k| [k, k]));
    })
}

/// Computes the axes of the tool, multiplied by the weights of the rotations about them.
pub(super) fn weigh(b: &mut Body<'_>, axes: Array, target: Array, rotations: Array) {
    b.each("i", [0, 3], |b, i| {
        b.each("k", [0, 3], |b, k| {
            b.set(axes.at(3 * i + k), target.at(3 * i + k) * rotations.at(i));
        });
    });
}

/// Returns a number that is not negative, and 0 for NaN.
pub(super) fn positive(value: Value) -> Value {
    value.clamped(0.0, HUGE)
}
