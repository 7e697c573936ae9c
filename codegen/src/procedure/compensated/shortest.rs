//! Shortest step by normal equations.
//!
//! A step within the bounds of the cycle.

use abbe_core::compensator::PASSES;

use super::machine::{Machine, positive};
use crate::procedure::build::Array;
use crate::procedure::value::below;
use crate::procedure::{Body, Procedure, Value, Whole};

const BY_COLUMNS: &str = "Shortest step x with J x = b, from J^T J x = J^T b, by iterated Tikhonov regularization: the first pass \
     solves (M + damping) x = b, each other one adds damping / (M + damping) of the one before.";

const BY_ROWS: &str = "Shortest step J^T x, from J J^T x = b, by iterated Tikhonov regularization: the first pass solves \
     (M + damping) x = b, each other one adds damping / (M + damping) of the one before.";

/// Shortest step: from J^T J for fewer than six joints, from J J^T for six or more.
pub(super) fn shortest(machine: &Machine<'_>) -> Procedure {
    let (count, damping) = (machine.count, machine.precision.tolerances().damping);
    let (by_columns, rank) = (count < 6, count.min(6));
    Procedure::new("shortest", if by_columns { BY_COLUMNS } else { BY_ROWS }, |b| {
        let (columns, wanted) = (b.argument("columns", 6 * count), b.argument("wanted", 6));
        let step = b.result("steps", count);
        let (m, rest) = (b.array("m", rank * rank), b.array("b", rank));
        let x = if by_columns { step } else { b.array("x", rank) };
        b.each("i", [0, rank], |b, i| {
            if by_columns {
                b.set(rest.at(i), columns.dot(wanted, [0, 6], |k| [6 * i + k, k.into()]));
                b.each("j", below(i + 1), |b, j| {
                    b.set(m.at(rank * i + j), columns.dot(columns, [0, 6], |k| [6 * i + k, 6 * j + k]));
                });
            } else {
                b.set(rest.at(i), wanted.at(i));
                b.each("j", below(i + 1), |b, j| {
                    b.set(m.at(rank * i + j), columns.dot(columns, [0, count], |k| [6 * k + j, 6 * k + i]));
                });
            }
            b.set(x.at(i), 0.0);
        });
        factorize(b, m, rank, damping);
        b.each("repetition", [0, PASSES], |b, _| {
            solve(b, m, rest, rank);
            b.each("i", [0, rank], |b, i| {
                b.set(x.at(i), x.at(i) + rest.at(i));
                b.set(rest.at(i), rest.at(i) * damping);
            });
        });
        if !by_columns {
            b.each("j", [0, count], |b, j| {
                b.set(step.at(j), columns.dot(x, [0, rank], |k| [6 * j + k, k.into()]));
            });
        }
    })
}

/// Replaces the lower triangle of M by its Cholesky factor L: L L^T = M + damping.
fn factorize(b: &mut Body<'_>, m: Array, rank: usize, damping: f64) {
    b.comment("Cholesky factorization; rounding makes no pivot smaller than the damping.");
    b.each("i", [0, rank], |b, i| {
        b.each("j", below(i), |b, j| {
            let known = m.dot(m, below(j), |k| [rank * i + k, rank * j + k]);
            b.set(m.at(rank * i + j), (m.at(rank * i + j) - known) / m.at((rank + 1) * j));
        });
        let known = m.dot(m, below(i), |k| [rank * i + k, rank * i + k]);
        let pivot = m.at((rank + 1) * i) - known;
        b.set(m.at((rank + 1) * i), (positive(pivot) + damping).sqrt());
    });
}

/// Solves L L^T x = b; x overwrites b.
fn solve(b: &mut Body<'_>, m: Array, x: Array, rank: usize) {
    b.each("i", [0, rank], |b, i| {
        let known = m.dot(x, below(i), |k| [rank * i + k, k.into()]);
        b.set(x.at(i), (x.at(i) - known) / m.at((rank + 1) * i));
    });
    b.each_down("i", rank, |b, i| {
        let known = m.dot(x, [i + 1, rank.into()], |k| [rank * k + i, k.into()]);
        b.set(x.at(i), (x.at(i) - known) / m.at((rank + 1) * i));
    });
}

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
