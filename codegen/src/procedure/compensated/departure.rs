//! Step within the bounds of the cycle.

use abbe_core::compensator::{PASSES, SOLVES};

use super::cycle::Cycle;
use crate::procedure::build::{Array, Real};
use crate::procedure::{Body, Counter, Value, Whole};

/// Variables of the step, in radians and metres from the command.
pub(super) struct Departure {
    /// Ends of the interval of each joint.
    ends: [Array; 2],
    /// The step, and what the pass before found.
    shift: Array,
    center: Array,
    /// Minimum of the free joints, and 1 for each joint that is held.
    goal: Array,
    held: Array,
    /// Columns of all joints and of the free ones.
    columns: [Array; 2],
    /// J d - r, the right-hand side of a system of equations, and its solution.
    systems: [Array; 3],
    /// Rows of a column or an error, and their weights.
    rows: [Array; 2],
    /// Numbers of systems of equations in the cycle, and of passes in the step.
    counts: [Real; 2],
    numbers: [Real; 4],
    /// Joint that is held next, and joint that is released.
    chosen: [Counter; 2],
}

impl Departure {
    pub(super) fn new(b: &mut Body<'_>, count: usize) -> Self {
        let [low, high, shift, center, goal, held] =
            ["low", "high", "shift", "center", "goal", "held"].map(|name| b.array(name, count));
        let [columns, free] = ["columns", "free"].map(|name| b.array(name, 6 * count));
        let (wanted, steps) = (b.array("wanted", 6), b.array("steps", count + 6));
        let [rows, weights, given] = ["rows", "weights", "given"].map(|name| b.array(name, 6));
        let [solves, passes, part, share, end, furthest] =
            ["solves", "passes", "part", "share", "end", "furthest"].map(|name| b.real(name));
        let [first, released] = ["first_held", "released"].map(|name| b.whole(name));
        b.comment("Whatever is assigned for some configurations only has a value before.");
        for real in [solves, passes, part, share, end, furthest] {
            b.set(real, 0.0);
        }
        for whole in [first, released] {
            b.set_whole(whole, Whole::Index((-1).into()));
        }
        for (array, len) in [(weights, 6), (given, 6), (steps, count + 6)] {
            b.each("i", [0, len], |b, i| b.set(array.at(i), 0.0));
        }
        Self {
            ends: [low, high],
            shift,
            center,
            goal,
            held,
            columns: [columns, free],
            systems: [wanted, given, steps],
            rows: [rows, weights],
            counts: [solves, passes],
            numbers: [part, share, end, furthest],
            chosen: [first, released],
        }
    }

    /// Fills `towards` with the end of the step from the present configuration, where `found` is
    /// left.
    pub(super) fn write(&self, b: &mut Body<'_>, cycle: &Cycle, units: Array, count: usize) {
        let Self { ends: [low, high], shift, counts: [solves, passes], .. } = *self;
        self.begin(b, cycle, units, count);
        let [all, most] = [PASSES, SOLVES].map(|number| number as f64);
        b.set(passes, 0.0);
        b.each("turn", [0, SOLVES], |b, _| {
            b.when(Value::from(all).exceeds(passes).and(Value::from(most).exceeds(solves)), |b| {
                self.turn(b, cycle, units, count);
            });
            b.leave(passes.get().is_at_least(all).or(solves.get().is_at_least(most)));
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
    fn begin(&self, b: &mut Body<'_>, cycle: &Cycle, units: Array, count: usize) {
        let Self { ends: [low, high], shift, center, columns: [columns, _], .. } = *self;
        let ([rows, weights], [wanted, ..]) = (self.rows, self.systems);
        b.call("weighted", [cycle.axes, cycle.found], weights);
        b.each("i", [0, 6], |b, i| b.set(wanted.at(i), -weights.at(i)));
        b.each("j", [0, count], |b, j| {
            let about = |q: Array| (q.at(j) - cycle.command.at(j)) / units.at(j);
            b.set(low.at(j), about(cycle.least));
            b.set(high.at(j), about(cycle.most));
            b.set(center.at(j), 0.0);
            b.set(shift.at(j), about(cycle.present));
            b.each("i", [0, 6], |b, i| b.set(rows.at(i), cycle.twists.at(6 * j + i) * units.at(j)));
            b.call("weighted", [cycle.axes, rows], weights);
            b.each("i", [0, 6], |b, i| {
                b.set(columns.at(6 * j + i), weights.at(i));
                b.set(wanted.at(i), wanted.at(i) + weights.at(i) * shift.at(j));
            });
            hold(b, self, j);
        });
    }

    /// Moves towards the minimum of the free joints. Holds the first one that meets an end; at the
    /// minimum, releases one or ends the pass.
    fn turn(&self, b: &mut Body<'_>, cycle: &Cycle, units: Array, count: usize) {
        let Self { ends: [low, high], shift, center, goal, held, columns: [columns, free], .. } = *self;
        let ([wanted, given, steps], [part, share, end, furthest]) = (self.systems, self.numbers);
        let ([solves, passes], [first, released]) = (self.counts, self.chosen);
        b.set(solves, solves.get() + 1.0);
        b.copy(given, wanted);
        b.each("j", [0, count], |b, j| {
            b.set(part, center.at(j));
            b.when(held.at(j).exceeds(0.0), |b| b.set(part, shift.at(j)));
            b.each("i", [0, 6], |b, i| {
                b.set(given.at(i), given.at(i) + columns.at(6 * j + i) * -part.get());
                b.set(free.at(6 * j + i), columns.at(6 * j + i));
                b.when(held.at(j).exceeds(0.0), |b| b.set(free.at(6 * j + i), 0.0));
            });
        });
        b.call("shortest", [free, given], steps);
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
                b.set(held.at(j), 1.0);
                b.set(shift.at(j), goal.at(j).clamped(low.at(j), high.at(j)));
            });
        });
        b.when(share.get().is_at_least(1.0), |b| {
            b.comment("Release the held variable that would move furthest; without one the pass ends.");
            b.set(furthest, 0.0);
            b.set_whole(released, Whole::Index((-1).into()));
            b.each("j", [0, count], |b, j| {
                b.when(held.at(j).exceeds(0.0), |b| {
                    b.set(part, columns.dot(steps, [0, 6], |k| [6 * j + k, k + count]));
                    b.set(part, (center.at(j) + part.get()).clamped(low.at(j), high.at(j)));
                    b.set(part, (part.get() - shift.at(j)).abs());
                    b.when(part.get().exceeds(furthest), |b| {
                        b.set(furthest, part);
                        b.set_whole(released, Whole::Index(j.into()));
                    });
                });
            });
            b.each("j", [0, count], |b, j| {
                b.when(released.is(j), |b| b.set(held.at(j), 0.0));
            });
            b.when(Value::from(0.0).is_at_least(furthest), |b| {
                b.set(passes, passes.get() + 1.0);
                b.copy(center, shift);
                b.when(passes.get().is_at_least((PASSES - 1) as f64), |b| {
                    b.comment("The last pass keeps to what the cycle permits.");
                    b.each("j", [0, count], |b, j| {
                        let about = |q: Array| (q.at(j) - cycle.command.at(j)) / units.at(j);
                        b.set(low.at(j), about(cycle.lower));
                        b.set(high.at(j), about(cycle.upper));
                        hold(b, self, j);
                    });
                });
            });
        });
    }
}

/// Moves the step of a joint into its interval, and holds it at an end or beyond.
fn hold(b: &mut Body<'_>, &Departure { ends: [low, high], shift, held, .. }: &Departure, j: Counter) {
    b.set(held.at(j), 1.0);
    let is_inside = shift.at(j).exceeds(low.at(j)).and(high.at(j).exceeds(shift.at(j)));
    b.when(is_inside, |b| b.set(held.at(j), 0.0));
    b.set(shift.at(j), shift.at(j).clamped(low.at(j), high.at(j)));
}
