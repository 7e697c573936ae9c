//! Shortest step by normal equations.

use super::machine::{Machine, positive};
use crate::procedure::build::Array;
use crate::procedure::value::below;
use crate::procedure::{Body, Procedure};

const BY_COLUMNS: &str = "Step y of the free variables, (J^T J + damping) y = J^T b, and behind it z = (b - J y) / damping. The columns \
     of held variables are zeros.";

const BY_ROWS: &str = "Step y = J^T z of the free variables, (J J^T + damping) z = b, and z behind it. The columns of held variables \
     are zeros.";

/// Shortest step: from J^T J for fewer than six joints, from J J^T for six or more.
pub(super) fn shortest(machine: &Machine<'_>) -> Procedure {
    let (count, damping) = (machine.count, machine.precision.tolerances().damping);
    let (by_columns, rank) = (count < 6, count.min(6));
    Procedure::new("shortest", if by_columns { BY_COLUMNS } else { BY_ROWS }, |b| {
        let (columns, wanted) = (b.argument("columns", 6 * count), b.argument("wanted", 6));
        let step = b.result("steps", count + 6);
        let (m, rest) = (b.array("m", rank * rank), b.array("b", rank));
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
        });
        factorize(b, m, rank, damping);
        solve(b, m, rest, rank);
        if by_columns {
            b.each("j", [0, count], |b, j| b.set(step.at(j), rest.at(j)));
            pull(b, step, [columns, wanted], damping, count);
        } else {
            b.each("j", [0, count], |b, j| {
                b.set(step.at(j), columns.dot(rest, [0, rank], |k| [6 * j + k, k.into()]));
            });
            b.each("i", [0, 6], |b, i| b.set(step.at(i + count), rest.at(i)));
        }
    })
}

/// Computes z = (b − J y) / λ behind the step.
pub(super) fn pull(b: &mut Body<'_>, step: Array, [columns, wanted]: [Array; 2], damping: f64, count: usize) {
    b.each("i", [0, 6], |b, i| b.set(step.at(i + count), wanted.at(i)));
    b.each("j", [0, count], |b, j| {
        b.each("i", [0, 6], |b, i| {
            b.set(step.at(i + count), step.at(i + count) + columns.at(6 * j + i) * -step.at(j));
        });
    });
    b.each("i", [0, 6], |b, i| b.set(step.at(i + count), step.at(i + count) / damping));
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
