//! Shortest step by orthogonalization in single precision.
//!
//! Rounding errors of a Jacobian of about one metre are 6e-8 and must not act like a direction in
//! which the tool moves. Rotations are weighted by 1/1000 and must be solved down to a least
//! singular value of 0.1, that is 1e-4: squares of such rows, as normal equations have them, would
//! have no significant digits. The damping lies between the two, as in double precision.

use super::Machine;
use crate::procedure::build::Array;
use crate::procedure::value::below;
use crate::procedure::{Body, Procedure};

const BY_COLUMNS: &str = "Step y of the free variables, which minimizes |J y - b|^2 + damping^2 |y|^2, and behind it z = (b - J y) / \
     damping^2. QR factorization by Gram-Schmidt. The columns of held variables are zeros.";

const BY_ROWS: &str = "Step y = J^T z of the free variables, (J J^T + damping^2) z = b, and z behind it. QR factorization by \
     Gram-Schmidt. The columns of held variables are zeros.";

/// Shortest step from the columns of J for fewer than six joints, from its rows for six or more.
pub(super) fn shortest(machine: &Machine<'_>) -> Procedure {
    let (count, damping) = (machine.count, machine.precision.tolerances().damping);
    let (by_columns, rank, len) = (count < 6, count.min(6), 6 + count);
    Procedure::new("shortest", if by_columns { BY_COLUMNS } else { BY_ROWS }, |b| {
        let (columns, wanted) = (b.argument("columns", 6 * count), b.argument("wanted", 6));
        let step = b.result("steps", count + 6);
        let (a, r) = (b.array("a", rank * len), b.array("r", rank * rank));
        let x = b.array("x", rank);
        b.each("k", [0, rank * len], |b, k| b.set(a.at(k), 0.0));
        b.each("j", [0, rank], |b, j| {
            b.each("i", [0, count.max(6)], |b, i| {
                let entry = if by_columns { 6 * j + i } else { 6 * i + j };
                b.set(a.at(len * j + i), columns.at(entry));
            });
            b.set(a.at((len + 1) * j + count.max(6)), damping);
        });
        orthogonalize(b, a, r, [rank, len, count.max(6)]);
        if by_columns {
            b.each_down("i", rank, |b, i| {
                b.set(x.at(i), a.dot(wanted, [0, 6], |k| [len * i + k, k.into()]));
                b.each("k", [i + 1, rank.into()], |b, k| {
                    b.set(x.at(i), x.at(i) - r.at(rank * i + k) * x.at(k));
                });
                b.set(x.at(i), x.at(i) / r.at((rank + 1) * i));
            });
            b.each("j", [0, count], |b, j| b.set(step.at(j), x.at(j)));
            b.each("i", [0, 6], |b, i| b.set(step.at(i + count), wanted.at(i)));
            b.each("j", [0, count], |b, j| {
                b.each("i", [0, 6], |b, i| {
                    b.set(step.at(i + count), step.at(i + count) - columns.at(6 * j + i) * step.at(j));
                });
            });
            b.each("i", [0, 6], |b, i| b.set(step.at(i + count), step.at(i + count) / (damping * damping)));
        } else {
            b.each("i", [0, rank], |b, i| {
                b.set(x.at(i), wanted.at(i));
                b.each("k", below(i), |b, k| {
                    b.set(x.at(i), x.at(i) - r.at(rank * k + i) * x.at(k));
                });
                b.set(x.at(i), x.at(i) / r.at((rank + 1) * i));
            });
            b.each("j", [0, len], |b, j| {
                b.set(step.at(j), a.dot(x, [0, rank], |k| [len * k + j, k.into()]));
            });
            b.each("i", [0, 6], |b, i| b.set(step.at(i + count), step.at(i + count) / damping));
        }
    })
}

/// Replaces the rows of `a` by orthonormal ones, and fills `r`. The entries of row j behind
/// `full + j` are 0.
fn orthogonalize(b: &mut Body<'_>, a: Array, r: Array, [rank, len, full]: [usize; 3]) {
    b.each("j", [0, rank], |b, j| {
        b.each("l", below(j), |b, l| {
            let product = a.dot(a, below(l + (full + 1)), |k| [len * l + k, len * j + k]);
            b.set(r.at(rank * l + j), product);
            b.each("i", below(l + (full + 1)), |b, i| {
                let part = r.at(rank * l + j) * a.at(len * l + i);
                b.set(a.at(len * j + i), a.at(len * j + i) - part);
            });
        });
        let square = a.dot(a, below(j + (full + 1)), |k| [len * j + k, len * j + k]);
        b.set(r.at((rank + 1) * j), square.sqrt());
        b.each("i", below(j + (full + 1)), |b, i| {
            b.set(a.at(len * j + i), a.at(len * j + i) / r.at((rank + 1) * j));
        });
    });
}
