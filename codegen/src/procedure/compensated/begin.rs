//! The command that drives carry out where they stand.

use abbe_core::Function;
use abbe_core::compensator::{ITERATIONS, Status};
use abbe_core::function::BEGIN;

use super::{HUGE, Machine, weigh};
use crate::procedure::{Procedure, Whole};

/// Describes [`abbe_core::compensator::begin`].
pub(super) fn begin(machine: &Machine<'_>) -> Procedure {
    let count = machine.count;
    Procedure::new(BEGIN.name, BEGIN.documentation, |b| {
        let q = b.argument("q", count);
        let rotations = b.argument("rotations", 3);
        let [command, last] = ["command", "last"].map(|name| b.result(name, count));
        let after = b.result("after", 6);
        let status = b.result_whole("status");
        let units = b.constant("units", &machine.units());
        let [lower_limits, upper_limits] = machine.limits(b);
        let [target, pose] = ["target", "actual"].map(|name| b.array(name, 12));
        let axes = b.array("axes", 9);
        let [present, best] = ["present", "best"].map(|name| b.array(name, count));
        let [found, rest, rows, weights, wanted] =
            ["found", "rest", "rows", "weights", "wanted"].map(|name| b.array(name, 6));
        let [twists, columns] = ["twists", "columns"].map(|name| b.array(name, 6 * count));
        let steps = b.array("steps", count + 6);
        let [square, smallest] = ["square", "smallest"].map(|name| b.real(name));
        b.evaluate(Function::CompensatorStep.name(), q, [target, twists]);
        weigh(b, axes, target, rotations);
        b.copy(present, q);
        b.copy(best, q);
        b.each("i", [0, 6], |b, i| b.set(rest.at(i), 0.0));
        b.set(smallest, HUGE);
        b.each("iteration", [0, ITERATIONS], |b, _| {
            b.evaluate(Function::CompensatorStep.name(), present, [pose, twists]);
            b.evaluate(Function::Pose.name(), present, [pose]);
            b.call("deviation", [target, pose], found);
            b.call_real("cost", [axes, found], square);
            b.when(smallest.get().exceeds(square), |b| {
                b.copy(best, present);
                b.copy(rest, found);
                b.set(smallest, square);
            });
            b.each("j", [0, count], |b, j| {
                b.each("i", [0, 6], |b, i| b.set(rows.at(i), twists.at(6 * j + i) * units.at(j)));
                b.call("weighted", [axes, rows], weights);
                b.each("i", [0, 6], |b, i| b.set(columns.at(6 * j + i), weights.at(i)));
            });
            b.call("weighted", [axes, found], weights);
            b.each("i", [0, 6], |b, i| b.set(wanted.at(i), -weights.at(i)));
            b.call("shortest", [columns, wanted], steps);
            b.each("j", [0, count], |b, j| {
                let moved = present.at(j) + steps.at(j) * units.at(j);
                b.set(present.at(j), moved.clamped(lower_limits.at(j), upper_limits.at(j)));
            });
        });
        b.each("j", [0, count], |b, j| b.set(last.at(j), q.at(j) - best.at(j)));
        b.copy(command, best);
        b.copy(after, rest);
        let reached = machine.reached(b, axes, rest);
        b.set_whole(status, Whole::Status(Status::NotReached));
        b.when(reached, |b| b.set_whole(status, Whole::Status(Status::Reached)));
    })
}
