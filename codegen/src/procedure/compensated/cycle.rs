//! One cycle of a controller.

use abbe_core::Function;
use abbe_core::compensator::{CONTRACTION, ITERATIONS, LEVER, SHORTER, Status};
use abbe_core::function::COMPENSATED;

use super::departure::Departure;
use super::machine::{HUGE, Machine, positive};
use crate::procedure::build::{Array, Real};
use crate::procedure::{Body, Condition, Procedure, Value, Whole};

/// Variables of the algorithm.
pub(super) struct Cycle {
    pub(super) axes: Array,
    pub(super) command: Array,
    pub(super) lower: Array,
    pub(super) upper: Array,
    target: Array,
    pose: Array,
    pub(super) twists: Array,
    /// Configuration of the iteration, and its deviation.
    pub(super) present: Array,
    pub(super) found: Array,
    /// End of the step from there.
    pub(super) towards: Array,
    /// Ends of the intervals without the bound of the change.
    pub(super) least: Array,
    pub(super) most: Array,
    /// Best configuration, its deviation and its cost.
    best: Array,
    rest: Array,
    smallest: Real,
    square: Real,
}

/// The corrected command.
pub(super) fn cycle(machine: &Machine<'_>) -> Procedure {
    let count = machine.count;
    Procedure::new(COMPENSATED.name, COMPENSATED.documentation, |b| {
        let [q, last, change, largest] =
            ["q", "last", "change", "largest"].map(|name| b.argument(name, count));
        let rotations = b.argument("rotations", 3);
        let [corrected, correction] = ["corrected", "correction"].map(|name| b.result(name, count));
        let [before, after] = ["before", "after"].map(|name| b.result(name, 6));
        let status = b.result_whole("status");
        let cycle = Cycle::new(b, count);
        let Cycle { command, lower, upper, target, present, found, best, rest, smallest, square, .. } = cycle;
        let first = b.array("first", 6);
        let units = b.constant("units", &machine.units());
        b.evaluate(Function::Pose.name(), q, [target]);
        cycle.measure(b, q);
        b.copy(first, found);
        b.each("i", [0, 3], |b, i| {
            b.each("k", [0, 3], |b, k| {
                b.set(cycle.axes.at(3 * i + k), target.at(3 * i + k) * rotations.at(i));
            });
        });
        let [is_outside, is_elsewhere, is_held] =
            ["is_outside", "is_elsewhere", "is_held"].map(|name| b.flag(name, false));
        let is_inside = b.flag("is_inside", true);
        cycle.bound(b, machine, [q, last, change, largest]);
        b.each("j", [0, count], |b, j| {
            b.set(present.at(j), (command.at(j) + last.at(j)).clamped(lower.at(j), upper.at(j)));
            b.when(command.at(j).differs(q.at(j)), |b| b.set_flag(is_outside, true));
            let beyond = lower.at(j).exceeds(q.at(j)).or(q.at(j).exceeds(upper.at(j)));
            b.when(beyond, |b| b.set_flag(is_inside, false));
            b.when(present.at(j).differs(q.at(j)), |b| b.set_flag(is_elsewhere, true));
        });
        b.when(is_elsewhere.into(), |b| cycle.measure(b, present));
        b.copy(best, present);
        b.copy(rest, found);
        b.call_real("cost", [cycle.axes, found], smallest);
        let departure = Departure::new(b, count);
        let from = b.array("from", count);
        let [is_accepted, is_rejected, is_moving] =
            ["is_accepted", "is_rejected", "is_moving"].map(|name| b.flag(name, false));
        let [moved, next, far, length, accepted] =
            ["moved", "next", "far", "length", "accepted"].map(|name| b.real(name));
        let at_rest = machine.precision.tolerances().rest;
        b.set(next, 0.0);
        b.set(far, 0.0);
        b.set(square, smallest);
        b.set(accepted, HUGE);
        b.set(length, HUGE);
        b.set(moved, HUGE);
        b.copy(from, present);
        b.each("iteration", [0, ITERATIONS], |b, _| {
            b.when(moved.get().exceeds(at_rest), |b| {
                departure.write(b, &cycle, units, count);
                largest_step(b, next, [present, cycle.towards, units], count);
                b.set_flag(is_accepted, false);
                b.set_flag(is_rejected, true);
                let shorter = (length.get() * CONTRACTION).exceeds(next);
                b.when(shorter.or(accepted.get().exceeds(square)), |b| {
                    b.set_flag(is_accepted, true);
                    b.set_flag(is_rejected, false);
                });
                b.when(is_accepted.into(), |b| {
                    b.copy(from, present);
                    b.set(accepted, square);
                    b.set(length, next);
                    b.copy(present, cycle.towards);
                });
                b.when(is_rejected.into(), |b| {
                    b.each("j", [0, count], |b, j| {
                        let shorter = from.at(j) + (present.at(j) - from.at(j)) * SHORTER;
                        b.set(present.at(j), shorter.clamped(lower.at(j), upper.at(j)));
                    });
                });
                largest_step(b, moved, [from, present, units], count);
                cycle.measure(b, present);
                b.call_real("cost", [cycle.axes, found], square);
                b.set_flag(is_moving, false);
                b.when(smallest.get().exceeds(square), |b| {
                    b.copy(best, present);
                    b.copy(rest, found);
                    b.set(smallest, square);
                    b.when(moved.get().exceeds(at_rest), |b| b.set_flag(is_moving, true));
                });
            });
            b.leave(Value::from(at_rest).is_at_least(moved));
        });
        b.call_real("cost", [cycle.axes, first], square);
        b.when(Condition::from(is_inside).and(smallest.get().exceeds(square)), |b| {
            b.copy(best, q);
            b.copy(rest, first);
        });
        b.each("j", [0, count], |b, j| {
            let at_end = lower.at(j).is_at_least(best.at(j)).or(best.at(j).is_at_least(upper.at(j)));
            b.when(at_end, |b| b.set_flag(is_held, true));
            b.set(corrected.at(j), best.at(j));
            b.set(correction.at(j), best.at(j) - command.at(j));
        });
        b.copy(before, first);
        b.copy(after, rest);
        let reached = cycle.distances(b, machine);
        let cases = [
            (is_moving.into(), Status::NotConverged),
            (is_held.into(), Status::Held),
            (reached, Status::Reached),
            (is_outside.into(), Status::OutsideLimits),
        ];
        b.comment("The last condition that holds decides.");
        b.set_whole(status, Whole::Status(Status::NotReached));
        for (condition, case) in cases {
            b.when(condition, |b| b.set_whole(status, Whole::Status(case)));
        }
    })
}

impl Cycle {
    fn new(b: &mut Body<'_>, count: usize) -> Self {
        let [command, lower, upper, least, most] =
            ["command", "lower", "upper", "least", "most"].map(|name| b.array(name, count));
        let [present, towards, best] = ["present", "towards", "best"].map(|name| b.array(name, count));
        let [target, pose] = ["target", "actual"].map(|name| b.array(name, 12));
        let [found, rest] = ["found", "rest"].map(|name| b.array(name, 6));
        let (axes, twists) = (b.array("axes", 9), b.array("twists", 6 * count));
        let [smallest, square] = ["smallest", "square"].map(|name| b.real(name));
        Self {
            axes,
            command,
            lower,
            upper,
            target,
            pose,
            twists,
            present,
            found,
            towards,
            least,
            most,
            best,
            rest,
            smallest,
            square,
        }
    }

    /// Evaluates the real pose at a configuration, and its deviation from the target.
    fn measure(&self, b: &mut Body<'_>, q: Array) {
        b.evaluate(Function::CompensatorStep.name(), q, [self.pose, self.twists]);
        b.call("deviation", [self.target, self.pose], self.found);
    }

    /// Computes the nearest command within the limits, and the interval of each joint.
    fn bound(&self, b: &mut Body<'_>, machine: &Machine<'_>, [q, last, change, largest]: [Array; 4]) {
        let ends = |end: usize| machine.spec.variables.iter().map(move |one| one.limits[end]);
        let lower_limits = b.constant("lower_limits", &ends(0).collect::<Vec<_>>());
        let upper_limits = b.constant("upper_limits", &ends(1).collect::<Vec<_>>());
        let [bound, widest] = ["bound", "widest"].map(|name| b.real(name));
        b.each("j", [0, machine.count], |b, j| {
            let within = |value: Value| value.clamped(lower_limits.at(j), upper_limits.at(j));
            let window = |correction: Value| correction.clamped(last.at(j) - bound, last.at(j) + bound);
            b.set(self.command.at(j), within(q.at(j)));
            b.comment("Bounds that are not positive are 0.");
            b.set(bound, positive(change.at(j)));
            b.set(widest, positive(largest.at(j)));
            for (end, size) in [(self.least, -widest.get()), (self.most, widest.get())] {
                b.set(end.at(j), within(self.command.at(j) + size));
            }
            for (end, size) in [(self.lower, -widest.get()), (self.upper, widest.get())] {
                b.set(end.at(j), self.command.at(j) + window(size));
                b.set(end.at(j), within(end.at(j)));
            }
        });
    }

    /// Returns the condition that the position and the weighted rotations are reached.
    fn distances(&self, b: &mut Body<'_>, machine: &Machine<'_>) -> Condition {
        let weights = b.array("weights", 6);
        let [far, angle] = ["far", "angle"].map(|name| b.real(name));
        b.call("weighted", [self.axes, self.rest], weights);
        b.set(far, weights.dot(weights, [0, 3], |k| [k, k]).sqrt());
        b.set(angle, weights.dot(weights, [3, 6], |k| [k, k]).sqrt());
        let [position, rotation] = machine.precision.tolerances().reached;
        let is_near = Value::from(position).is_at_least(far);
        is_near.and(Value::from(rotation * LEVER).is_at_least(angle))
    }
}

/// Computes the largest step of a variable, in radians and metres.
fn largest_step(b: &mut Body<'_>, largest: Real, [from, to, units]: [Array; 3], count: usize) {
    let far = b.real("far");
    b.set(largest, 0.0);
    b.each("j", [0, count], |b, j| {
        b.set(far, (to.at(j) - from.at(j)).abs() / units.at(j));
        b.when(far.get().exceeds(largest), |b| b.set(largest, far));
    });
}
