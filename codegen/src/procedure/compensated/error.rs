//! Error of a pose, its weights, and its cost.

use abbe_core::compensator::LEVER;

use super::machine::{HUGE, Machine};
use crate::procedure::{Procedure, Value};

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
        let least = machine.precision.least_sine();
        b.when(twice_sine.get().is_at_least(least), |b| {
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

/// Returns a number that is not negative, and 0 for NaN.
pub(super) fn positive(value: Value) -> Value {
    value.clamped(0.0, HUGE)
}
