//! Corrected commands in JavaScript, by the fixed number of steps of `abbe::compensator`.

use abbe_core::function::{COMPENSATED, CONVERGED};
use abbe_spec::Spec;

use super::functions::documentation;
use super::operators::number;
use crate::print::compensated::{Tolerances, numbered};
use crate::print::layout::Writer;
use crate::program::Routines;

pub(super) fn compensated(writer: &mut Writer, spec: &Spec, routines: &Routines) {
    if spec.variables.is_empty() {
        return;
    }
    let [helpers, function] =
        [HELPERS, COMPENSATE].map(|text| numbered(text, spec, &Tolerances::DOUBLE, number));
    writer.blank();
    writer.paragraphs(&helpers);
    writer.blank();
    writer.lines("/**");
    let behind = ["converged", CONVERGED];
    documentation(writer, &routines.description, &COMPENSATED, Some(behind));
    writer.lines(" */");
    writer.lines(function.trim_end());
}

const HELPERS: &str = "\
/** Deviation of the real from the ideal pose: position in F_0, and the rotation vector of R_real R_ideal^T. */
function deviation(ideal, real) {
    const turn = (i, j) =>
        real[i] * ideal[j] + real[3 + i] * ideal[3 + j] + real[6 + i] * ideal[6 + j];
    const v = [turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1)];
    const twiceSine = Math.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    const angle = Math.atan2(twiceSine, turn(0, 0) + turn(1, 1) + turn(2, 2) - 1);
    const scale = twiceSine < LEAST_SINE ? 0.5 : angle / twiceSine;
    const lengths = [9, 10, 11].map((i) => real[i] - ideal[i]);
    return Float64Array.of(...lengths, ...v.map((component) => component * scale));
}

/** Weights the rows in metres and rad: 1 rad counts as 1 mm, so that the position has priority. */
function weighed(rows, factor) {
    return rows.map((row, i) => row * factor * (i < 3 ? METRE : LEVER));
}

function dot(a, b, count) {
    let sum = 0;
    for (let k = 0; k < count; k++) sum += a[k] * b[k];
    return sum;
}

/** Solves (M + lambda) x = b by Cholesky factorization, for positive semidefinite M; x overwrites b. */
function solve(m, b) {
    for (let i = 0; i < b.length; i++) {
        for (let j = 0; j <= i; j++) {
            const rest = m[i][j] - dot(m[i], m[j], j);
            m[i][j] = i === j ? Math.sqrt(Math.max(rest, 0) + DAMPING) : rest / m[j][j];
        }
        b[i] = (b[i] - dot(m[i], b, i)) / m[i][i];
    }
    for (let i = b.length - 1; i >= 0; i--) {
        let known = 0;
        for (let j = i + 1; j < b.length; j++) known += m[j][i] * b[j];
        b[i] = (b[i] - known) / m[i][i];
    }
    return b;
}

/** Returns the shortest step, (J^T J + lambda)^-1 J^T b; for more than six joints J^T (J J^T + lambda)^-1 b. */
function shortest(columns, b) {
    const isPrimal = columns.length <= 6;
    const rows = Array.from(b, (_, i) => columns.map((column) => column[i]));
    const m = (isPrimal ? columns : rows).map((a, _, all) => all.map((c) => dot(a, c, a.length)));
    const times = (x) => columns.map((column) => dot(column, x, 6));
    return isPrimal ? solve(m, times(b)) : times(solve(m, b.slice()));
}

/**
 * Sets q to start + step. Variables that exceed a limit are held at it, one at a time, the one with the
 * largest excess first.
 */
function depart(start, q, twists, after) {
    const units = [UNIT_LIST];
    const clamped = (j) => {
        const [lower, upper] = description.variables[j].limits;
        return Math.min(Math.max(q[j], lower), upper);
    };
    const columns = units.map((unit, j) => weighed(twists.subarray(6 * j, 6 * j + 6), unit));
    const wanted = weighed(after, -1);
    const add = (j, factor) => columns[j].forEach((entry, i) => (wanted[i] += entry * factor));
    units.forEach((unit, j) => add(j, (q[j] - start[j]) / unit));
    for (let round = 0; round <= units.length; round++) {
        const step = shortest(columns, wanted);
        let [furthest, held] = [0, -1];
        units.forEach((unit, j) => {
            // Skip variables that are held or do not move the tool.
            if (!(dot(columns[j], columns[j], 6) > 0)) return;
            q[j] = start[j] + step[j] * unit;
            const beyond = Math.abs(q[j] - clamped(j)) / unit;
            if (beyond > furthest) [furthest, held] = [beyond, j];
        });
        if (held < 0) break;
        q[held] = clamped(held);
        add(held, (start[held] - q[held]) / units[held]);
        columns[held].fill(0);
    }
    units.forEach((_, j) => (q[j] = clamped(j)));
    return q;
}
";

const COMPENSATE: &str = "\
export function compensated(q, s, u) {
    const units = [UNIT_LIST];
    const cost = (rows) => {
        const weighted = weighed(rows, 1);
        return dot(weighted, weighted, 6);
    };
    const target = pose(q, s);
    let { pose: real, columns } = compensator_step(q, s, u);
    const before = deviation(target, real);
    let at = Float64Array.from(q);
    let [corrected, after, now, moved] = [at, before, before, 0];
    const isInside = description.variables.every(
        ({ limits: [lower, upper] }, j) => q[j] >= lower && q[j] <= upper,
    );
    let least = isInside ? cost(before) : Infinity;
    for (let iteration = 0; iteration < ITERATIONS; iteration++) {
        const from = at;
        at = depart(q, from.slice(), columns, now);
        moved = Math.max(...units.map((unit, j) => Math.abs(at[j] - from[j]) / unit));
        ({ pose: real, columns } = compensator_step(at, s, u));
        now = deviation(target, real);
        if (cost(now) < least) {
            [least, corrected, after] = [cost(now), at, now];
        }
    }
    return { corrected, before, after, converged: moved <= REST };
}
";
