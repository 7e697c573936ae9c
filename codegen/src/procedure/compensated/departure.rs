//! Step within the bounds of the cycle.

use abbe_core::compensator::{PASSES, RELEASES, solves};

use super::variables::Cycle;
use crate::procedure::build::{Array, Real};
use crate::procedure::{Body, Counter, Value, Whole};

/// Returns the variables of the step, in radians and metres from the command: the ends of the
/// intervals, the step, what the pass before found, the minimum of the free joints, and how often a
/// joint was released: −r of a free one, 1 + r of one that is held.
fn joints(b: &mut Body<'_>, count: usize) -> [Array; 6] {
    ["low", "high", "shift", "center", "goal", "held"].map(|name| b.array(name, count))
}

/// Returns the numbers of systems of equations in the cycle and of passes in the step, and others.
fn numbers(b: &mut Body<'_>) -> [Real; 6] {
    ["solved", "passes", "part", "share", "meets", "furthest"].map(|name| b.real(name))
}

/// Fills `towards` with the end of the step from the present configuration, where `found` is
/// left.
pub(super) fn departure(b: &mut Body<'_>, cycle: &Cycle, units: Array, count: usize) {
    let ([low, high, shift, ..], [solved, passes, ..]) = (joints(b, count), numbers(b));
    begin(b, cycle, units, count);
    let [all, most] = [PASSES, solves(count)].map(|number| number as f64);
    b.set(passes, 0.0);
    b.each("turn", [0, solves(count)], |b, _| {
        b.when(Value::from(all).exceeds(passes).and(Value::from(most).exceeds(solved)), |b| {
            turn(b, cycle, units, count);
        });
        b.leave(passes.get().is_at_least(all).or(solved.get().is_at_least(most)));
    });
    b.each("j", [0, count], |b, j| {
        let [lower, upper] = [cycle.lower.at(j), cycle.upper.at(j)];
        let inside = cycle.command.at(j) + shift.at(j) * units.at(j);
        b.set(cycle.towards.at(j), inside.clamped(lower.clone(), upper.clone()));
        b.when(shift.at(j).is_at_least(high.at(j)), |b| b.set(cycle.towards.at(j), upper));
        b.when(low.at(j).is_at_least(shift.at(j)), |b| b.set(cycle.towards.at(j), lower));
    });
}

/// Computes the intervals, the columns and J d − r, and holds the joints that are at an end.
fn begin(b: &mut Body<'_>, cycle: &Cycle, units: Array, count: usize) {
    let ([low, high, shift, center, ..], columns) = (joints(b, count), b.array("columns", 6 * count));
    let [rows, weights, wanted] = ["rows", "weights", "wanted"].map(|name| b.array(name, 6));
    b.call("weighted", [cycle.axes, cycle.found], weights);
    b.each("i", [0, 6], |b, i| b.set(wanted.at(i), -weights.at(i)));
    b.each("j", [0, count], |b, j| {
        let about = |q: Array| (q.at(j) - cycle.command.at(j)) / units.at(j);
        b.set(low.at(j), about(cycle.bottom));
        b.set(high.at(j), about(cycle.top));
        b.set(center.at(j), 0.0);
        b.set(shift.at(j), about(cycle.present));
        b.each("i", [0, 6], |b, i| b.set(rows.at(i), cycle.twists.at(6 * j + i) * units.at(j)));
        b.call("weighted", [cycle.axes, rows], weights);
        b.each("i", [0, 6], |b, i| {
            b.set(columns.at(6 * j + i), weights.at(i));
            b.set(wanted.at(i), wanted.at(i) + weights.at(i) * shift.at(j));
        });
        hold(b, count, j);
    });
}

/// Moves towards the minimum of the free joints. Holds the first one that meets an end; at the
/// minimum, releases one or ends the pass.
fn turn(b: &mut Body<'_>, cycle: &Cycle, units: Array, count: usize) {
    let [low, high, shift, center, goal, held] = joints(b, count);
    let [solved, passes, part, share, end, furthest] = numbers(b);
    let [columns, free] = ["columns", "movable"].map(|name| b.array(name, 6 * count));
    let [wanted, sides] = ["wanted", "sides"].map(|name| b.array(name, 6));
    let steps = b.array("steps", count + 6);
    let [first, released] = ["first_held", "released"].map(|name| b.whole(name));
    b.set(solved, solved.get() + 1.0);
    b.copy(sides, wanted);
    b.each("j", [0, count], |b, j| {
        b.set(part, center.at(j));
        b.when(held.at(j).exceeds(0.0), |b| b.set(part, shift.at(j)));
        b.each("i", [0, 6], |b, i| {
            b.set(sides.at(i), sides.at(i) + columns.at(6 * j + i) * -part.get());
            b.set(free.at(6 * j + i), columns.at(6 * j + i));
            b.when(held.at(j).exceeds(0.0), |b| b.set(free.at(6 * j + i), 0.0));
        });
    });
    b.call("shortest", [free, sides], steps);
    b.comment("The share of the way to the minimum of the free variables, up to the first end.");
    b.set(share, 1.0);
    b.set_whole(first, Whole::Index((-1).into()));
    b.each("j", [0, count], |b, j| {
        b.set(goal.at(j), center.at(j) + steps.at(j));
        b.set(end, goal.at(j).clamped(low.at(j), high.at(j)));
        let is_free = Value::from(0.0).is_at_least(held.at(j));
        b.when(is_free.and(goal.at(j).differs(end)), |b| {
            b.set(part, (end.get() - shift.at(j)) / (goal.at(j) - shift.at(j)));
            b.when(share.get().exceeds(part), |b| {
                b.set(share, part);
                b.set_whole(first, Whole::Index(j.into()));
            });
        });
    });
    b.each("j", [0, count], |b, j| {
        b.when(Value::from(0.0).is_at_least(held.at(j)), |b| {
            let moved = shift.at(j) + share.get() * (goal.at(j) - shift.at(j));
            b.set(shift.at(j), moved.clamped(low.at(j), high.at(j)));
        });
        b.when(first.is(j), |b| {
            b.set(held.at(j), -held.at(j) + 1.0);
            b.set(shift.at(j), goal.at(j).clamped(low.at(j), high.at(j)));
        });
    });
    b.when(share.get().is_at_least(1.0), |b| {
        b.comment("Release the held variable that would move furthest; without one the pass ends.");
        b.set(furthest, 0.0);
        b.set_whole(released, Whole::Index((-1).into()));
        b.each("j", [0, count], |b, j| {
            let may_move = held.at(j).exceeds(0.0).and(Value::from(RELEASES).is_at_least(held.at(j)));
            b.when(may_move, |b| {
                b.set(part, columns.dot(steps, [0, 6], |k| [6 * j + k, k + count]));
                b.set(part, center.at(j) + part.get());
                b.set(end, part.get().clamped(low.at(j), high.at(j)));
                let moves = end.get().differs(shift.at(j));
                b.set(part, (part.get() - shift.at(j)).abs());
                b.when(moves.and(part.get().exceeds(furthest)), |b| {
                    b.set(furthest, part);
                    b.set_whole(released, Whole::Index(j.into()));
                });
            });
        });
        b.each("j", [0, count], |b, j| {
            b.when(released.is(j), |b| b.set(held.at(j), -held.at(j)));
        });
        b.when(Value::from(0.0).is_at_least(furthest), |b| {
            b.set(passes, passes.get() + 1.0);
            b.copy(center, shift);
            b.each("j", [0, count], |b, j| b.set(held.at(j), held.at(j).clamped(0.0, 1.0)));
            b.when(passes.get().is_at_least((PASSES - 1) as f64), |b| {
                b.comment("The last pass keeps to what the cycle permits.");
                b.each("j", [0, count], |b, j| {
                    let about = |q: Array| (q.at(j) - cycle.command.at(j)) / units.at(j);
                    b.set(low.at(j), about(cycle.lower));
                    b.set(high.at(j), about(cycle.upper));
                    hold(b, count, j);
                });
            });
        });
    });
}

/// Moves the step of a joint into its interval, and holds it at an end or beyond.
fn hold(b: &mut Body<'_>, count: usize, j: Counter) {
    let [low, high, shift, _, _, held] = joints(b, count);
    b.set(held.at(j), 1.0);
    let is_inside = shift.at(j).exceeds(low.at(j)).and(high.at(j).exceeds(shift.at(j)));
    b.when(is_inside, |b| b.set(held.at(j), 0.0));
    b.set(shift.at(j), shift.at(j).clamped(low.at(j), high.at(j)));
}
