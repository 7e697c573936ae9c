//! Variables of a cycle, the intervals of the joints, and what is left.

use abbe_core::Function;

use super::{Machine, positive};
use crate::procedure::build::{Array, Real};
use crate::procedure::{Body, Value};

/// Variables of the algorithm.
pub(super) struct Cycle {
    pub(super) axes: Array,
    pub(super) command: Array,
    pub(super) lower: Array,
    pub(super) upper: Array,
    pub(super) target: Array,
    pub(super) pose: Array,
    pub(super) twists: Array,
    /// Configuration of the iteration, and its deviation.
    pub(super) present: Array,
    pub(super) found: Array,
    /// End of the step from there.
    pub(super) towards: Array,
    /// Ends of the intervals without the bound of the change.
    pub(super) bottom: Array,
    pub(super) top: Array,
    /// Best configuration, its deviation and its cost.
    pub(super) best: Array,
    pub(super) rest: Array,
    pub(super) smallest: Real,
    pub(super) square: Real,
}

impl Cycle {
    pub(super) fn new(b: &mut Body<'_>, count: usize) -> Self {
        Self {
            axes: b.array("axes", 9),
            command: b.array("command", count),
            lower: b.array("lower", count),
            upper: b.array("upper", count),
            target: b.array("target", 12),
            pose: b.array("actual", 12),
            twists: b.array("twists", 6 * count),
            present: b.array("present", count),
            found: b.array("found", 6),
            towards: b.array("towards", count),
            bottom: b.array("bottom", count),
            top: b.array("top", count),
            best: b.array("best", count),
            rest: b.array("rest", 6),
            smallest: b.real("smallest"),
            square: b.real("square"),
        }
    }

    /// Evaluates the real pose at a configuration, and its deviation from the target.
    pub(super) fn measure(&self, b: &mut Body<'_>, q: Array) {
        b.evaluate(Function::CompensatorStep.name(), q, [self.pose, self.twists]);
        b.call("deviation", [self.target, self.pose], self.found);
    }

    /// Computes the nearest command within the limits, and the interval of each joint.
    pub(super) fn bound(
        &self,
        b: &mut Body<'_>,
        machine: &Machine<'_>,
        [q, last, change, largest]: [Array; 4],
    ) {
        let [lower_limits, upper_limits] = machine.limits(b);
        let [bound, widest] = ["bound", "widest"].map(|name| b.real(name));
        b.each("j", [0, machine.count], |b, j| {
            let within = |value: Value| value.clamped(lower_limits.at(j), upper_limits.at(j));
            let window = |correction: Value| correction.clamped(last.at(j) - bound, last.at(j) + bound);
            b.set(self.command.at(j), within(q.at(j)));
            b.comment("Bounds that are not positive are 0.");
            b.set(bound, positive(change.at(j)));
            b.set(widest, positive(largest.at(j)));
            let (lower, upper) = ([self.bottom, self.lower], [self.top, self.upper]);
            for ([widely, end], size) in [(lower, -widest.get()), (upper, widest.get())] {
                b.set(widely.at(j), within(self.command.at(j) + size.clone()));
                b.set(end.at(j), self.command.at(j) + window(size));
                b.set(end.at(j), within(end.at(j)));
            }
        });
    }
}
