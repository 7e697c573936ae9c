//! A step within the bounds of the cycle.

use super::machine::Machine;
use crate::procedure::{Procedure, Value, Whole};

/// The command and the shortest step, within the bounds.
pub(super) fn departure(machine: &Machine<'_>) -> Procedure {
    let count = machine.count;
    let documentation = "Command plus the shortest step. Variables that exceed a bound are held at it, one at a time, the one with the \
         largest excess first.";
    Procedure::new("departure", documentation, |b| {
        let axes = b.argument("axes", 9);
        let [command, lower, upper, present] =
            ["command", "lower", "upper", "present"].map(|name| b.argument(name, count));
        let (twists, found) = (b.argument("twists", 6 * count), b.argument("found", 6));
        let q = b.result("q", count);
        let units = b.constant("units", &machine.units());
        let columns = b.array("columns", 6 * count);
        let [rows, weights, wanted] = ["rows", "weights", "wanted"].map(|name| b.array(name, 6));
        let steps = b.array("steps", count);
        let [far, furthest] = ["far", "furthest"].map(|name| b.real(name));
        let held = b.whole("held");
        b.copy(q, present);
        b.call("weighted", [axes, found], weights);
        b.each("i", [0, 6], |b, i| b.set(wanted.at(i), -weights.at(i)));
        b.each("j", [0, count], |b, j| {
            b.each("i", [0, 6], |b, i| b.set(rows.at(i), twists.at(6 * j + i) * units.at(j)));
            b.call("weighted", [axes, rows], weights);
            b.set(far, (q.at(j) - command.at(j)) / units.at(j));
            b.each("i", [0, 6], |b, i| {
                b.set(columns.at(6 * j + i), weights.at(i));
                b.set(wanted.at(i), wanted.at(i) + weights.at(i) * far);
            });
        });
        b.each("turn", [0, count + 1], |b, _| {
            b.call("shortest", [columns, wanted], steps);
            b.set(furthest, 0.0);
            b.set_whole(held, Whole::Index((-1).into()));
            b.each("j", [0, count], |b, j| {
                b.comment("Skip variables that are held or do not move the tool.");
                let square = columns.dot(columns, [0, 6], |k| [6 * j + k, 6 * j + k]);
                b.set(far, square);
                b.when(far.get().exceeds(0.0), |b| {
                    b.set(q.at(j), command.at(j) + steps.at(j) * units.at(j));
                    let excess = q.at(j) - q.at(j).clamped(lower.at(j), upper.at(j));
                    b.set(far, excess.abs() / units.at(j));
                    b.when(far.get().exceeds(furthest), |b| {
                        b.set(furthest, far);
                        b.set_whole(held, Whole::Index(j.into()));
                    });
                });
            });
            b.leave(Value::from(0.0).is_at_least(furthest));
            b.each("j", [0, count], |b, j| {
                b.when(held.is(j), |b| {
                    b.set(q.at(j), q.at(j).clamped(lower.at(j), upper.at(j)));
                    b.set(far, (command.at(j) - q.at(j)) / units.at(j));
                    b.each("i", [0, 6], |b, i| {
                        b.set(wanted.at(i), wanted.at(i) + columns.at(6 * j + i) * far);
                        b.set(columns.at(6 * j + i), 0.0);
                    });
                });
            });
        });
        b.each("j", [0, count], |b, j| b.set(q.at(j), q.at(j).clamped(lower.at(j), upper.at(j))));
    })
}
