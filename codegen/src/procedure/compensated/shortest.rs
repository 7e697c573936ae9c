//! Shortest step by normal equations.

use abbe_core::compensator::PASSES;

use super::error::positive;
use super::machine::Machine;
use crate::procedure::build::Array;
use crate::procedure::index::below;
use crate::procedure::{Body, Procedure};

const BY_COLUMNS: &str = "Shortest step x with J x = b, from J^T J x = J^T b, by iterated Tikhonov regularization: the first pass \
     solves (M + damping) x = b, each other one adds damping / (M + damping) of the one before.";

const BY_ROWS: &str = "Shortest step J^T x, from J J^T x = b, by iterated Tikhonov regularization: the first pass solves \
     (M + damping) x = b, each other one adds damping / (M + damping) of the one before.";

/// Shortest step: from J^T J for fewer than six joints, from J J^T for six or more.
pub(super) fn shortest(machine: &Machine<'_>) -> Procedure {
    let (count, damping) = (machine.count, machine.precision.damping());
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
