//! Shortest step by normal equations.

use super::{Machine, positive};
use crate::procedure::build::Array;
use crate::procedure::value::below;
use crate::procedure::{Body, Procedure};

const TEXT: &str = "Step y = J^T z of the free variables, (J J^T + damping) z = b, and z behind it. The columns of held variables \
     are zeros.";

/// The shortest step, and the pull z.
pub(super) fn shortest(machine: &Machine<'_>) -> Procedure {
    let (count, damping) = (machine.count, machine.precision.tolerances().damping);
    Procedure::new("shortest", TEXT, |b| {
        let (columns, wanted) = (b.argument("columns", 6 * count), b.argument("wanted", 6));
        let (steps, m, z) = (b.result("steps", count + 6), b.array("m", 36), b.array("z", 6));
        b.each("i", [0, 6], |b, i| {
            b.set(z.at(i), wanted.at(i));
            b.each("j", below(i + 1), |b, j| {
                b.set(m.at(6 * i + j), columns.dot(columns, [0, count], |k| [6 * k + j, 6 * k + i]));
            });
        });
        factorize(b, m, damping);
        b.each("i", [0, 6], |b, i| {
            b.set(z.at(i), (z.at(i) - m.dot(z, below(i), |k| [6 * i + k, k.into()])) / m.at(7 * i));
        });
        b.each_down("i", 6, |b, i| {
            let known = m.dot(z, [i + 1, 6.into()], |k| [6 * k + i, k.into()]);
            b.set(z.at(i), (z.at(i) - known) / m.at(7 * i));
        });
        b.each("j", [0, count], |b, j| {
            b.set(steps.at(j), columns.dot(z, [0, 6], |k| [6 * j + k, k.into()]));
        });
        b.each("i", [0, 6], |b, i| b.set(steps.at(i + count), z.at(i)));
    })
}

/// Replaces the lower triangle of M by its Cholesky factor L: L L^T = M + damping.
fn factorize(b: &mut Body<'_>, m: Array, damping: f64) {
    b.comment("Cholesky factorization; rounding makes no pivot smaller than the damping.");
    b.each("i", [0, 6], |b, i| {
        b.each("j", below(i), |b, j| {
            let known = m.dot(m, below(j), |k| [6 * i + k, 6 * j + k]);
            b.set(m.at(6 * i + j), (m.at(6 * i + j) - known) / m.at(7 * j));
        });
        let known = m.dot(m, below(i), |k| [6 * i + k, 6 * i + k]);
        let pivot = m.at(7 * i) - known;
        b.set(m.at(7 * i), (positive(pivot) + damping).sqrt());
    });
}
