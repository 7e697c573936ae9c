//! One cycle of a controller.

use abbe_core::Function;
use abbe_core::compensator::{CONTRACTION, ITERATIONS, SHORTER, Status};
use abbe_core::function::COMPENSATED;

use super::{HUGE, Machine, departure::departure, variables::Cycle, weigh};
use crate::procedure::build::{Array, Real};
use crate::procedure::{Body, Condition, Procedure, Value, Whole};

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
        weigh(b, cycle.axes, target, rotations);
        let [is_outside, is_elsewhere, is_held] =
            ["is_outside", "is_elsewhere", "is_held"].map(|name| b.flag(name, false));
        let is_inside = b.flag("is_inside", true);
        cycle.bound(b, machine, [q, last, change, largest]);
        b.each("j", [0, count], |b, j| {
            b.set(present.at(j), (command.at(j) + last.at(j)).clamped(lower.at(j), upper.at(j)));
            let slack = q.at(j).abs() * machine.precision.tolerances().at_limit;
            b.when((command.at(j) - q.at(j)).abs().exceeds(slack), |b| b.set_flag(is_outside, true));
            let beyond = lower.at(j).exceeds(q.at(j)).or(q.at(j).exceeds(upper.at(j)));
            b.when(beyond, |b| b.set_flag(is_inside, false));
            b.when(present.at(j).differs(q.at(j)), |b| b.set_flag(is_elsewhere, true));
        });
        b.when(is_elsewhere.into(), |b| cycle.measure(b, present));
        b.copy(best, present);
        b.copy(rest, found);
        b.call_real("cost", [cycle.axes, found], smallest);
        let from = b.array("origin", count);
        let [is_rejected, is_moving] = ["is_rejected", "is_moving"].map(|name| b.flag(name, false));
        let [moved, ahead, length, accepted, solved] =
            ["moved", "ahead", "length", "accepted", "solved"].map(|name| b.real(name));
        let at_rest = machine.precision.tolerances().rest;
        b.set(solved, 0.0);
        b.set(square, smallest);
        b.set(accepted, HUGE);
        b.set(length, HUGE);
        b.set(moved, HUGE);
        b.copy(from, present);
        b.each("iteration", [0, ITERATIONS], |b, _| {
            b.when(moved.get().exceeds(at_rest), |b| {
                departure(b, &cycle, units, count);
                largest_step(b, ahead, [present, cycle.towards, units], count);
                b.set_flag(is_rejected, true);
                let shorter = (length.get() * CONTRACTION).exceeds(ahead);
                b.when(shorter.or(accepted.get().exceeds(square)), |b| {
                    b.set_flag(is_rejected, false);
                    b.copy(from, present);
                    b.set(accepted, square);
                    b.set(length, ahead);
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
        let reached = machine.reached(b, cycle.axes, cycle.rest);
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

/// Computes the largest step of a variable, in radians and metres.
fn largest_step(b: &mut Body<'_>, largest: Real, [from, to, units]: [Array; 3], count: usize) {
    let far = b.real("far");
    b.set(largest, 0.0);
    b.each("j", [0, count], |b, j| {
        b.set(far, (to.at(j) - from.at(j)).abs() / units.at(j));
        b.when(far.get().exceeds(largest), |b| b.set(largest, far));
    });
}
