//! Corrected commands in JavaScript, by the fixed number of steps of `abbe::compensator`.

use abbe_core::function::COMPENSATED;
use abbe_spec::Spec;

use super::functions::documentation;
use super::operators::number;
use crate::print::compensated::{Tolerances, numbered, statuses};
use crate::print::layout::Writer;
use crate::program::Routines;

pub(super) fn compensated(writer: &mut Writer, spec: &Spec, routines: &Routines) {
    if !routines.has_compensated() {
        return;
    }
    let [helpers, function] =
        [HELPERS, COMPENSATE].map(|text| numbered(text, spec, &Tolerances::DOUBLE, number));
    writer.blank();
    writer.paragraphs(&helpers);
    writer.blank();
    writer.lines("/**");
    let statuses = statuses(&Tolerances::DOUBLE);
    documentation(writer, &routines.description, &COMPENSATED, Some(["status", &statuses]));
    writer.documentation_line("");
    writer.documentation(WITHOUT_LAST);
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

/** Checks the length of an argument, and that its numbers are finite. */
function given(name, numbers, count, mayBeInfinite) {
    if (numbers.length !== count) throw new RangeError(`${name}: expected ${count} numbers, found ${numbers.length}`);
    if (!mayBeInfinite && !numbers.every(Number.isFinite)) throw new RangeError(`${name}: a number is not finite`);
}

/** Returns the nearest value of an interval, and its lower end for NaN. */
function clamped(value, [lower, upper]) {
    const above = value > lower ? value : lower;
    return above < upper ? above : upper;
}

/**
 * Weights the position in metres, and the rotations about the weighted axes of the tool in rad: 1 rad counts as 1 mm, so
 * that the position has priority.
 */
function weighed(axes, rows, factor) {
    const turn = rows.subarray(3);
    return Float64Array.from(rows, (row, i) => (i < 3 ? row * factor * METRE : dot(axes[i - 3], turn, 3) * factor * LEVER));
}

function dot(a, b, count) {
    let sum = 0;
    for (let k = 0; k < count; k++) sum += a[k] * b[k];
    return sum;
}

/**
 * Iterated Tikhonov regularization by Cholesky factorization of M + lambda, for positive semidefinite M: the first pass
 * solves (M + lambda) x = b, each other one adds lambda (M + lambda)^-1 of the one before.
 */
function solve(m, b) {
    for (let i = 0; i < b.length; i++) {
        for (let j = 0; j <= i; j++) {
            const rest = m[i][j] - dot(m[i], m[j], j);
            m[i][j] = i === j ? Math.sqrt((rest > 0 ? rest : 0) + DAMPING) : rest / m[j][j];
        }
    }
    const x = b.map(() => 0);
    for (let pass = 0; pass < PASSES; pass++) {
        for (let i = 0; i < b.length; i++) b[i] = (b[i] - dot(m[i], b, i)) / m[i][i];
        for (let i = b.length - 1; i >= 0; i--) {
            let known = 0;
            for (let j = i + 1; j < b.length; j++) known += m[j][i] * b[j];
            b[i] = (b[i] - known) / m[i][i];
        }
        b.forEach((entry, i) => {
            x[i] += entry;
            b[i] = entry * DAMPING;
        });
    }
    return x;
}

/** Returns the shortest step: x of (J^T J) x = J^T b, and for six joints or more J^T x of (J J^T) x = b. */
function shortest(columns, b) {
    const isPrimal = columns.length < 6;
    const rows = Array.from(b, (_, i) => columns.map((column) => column[i]));
    const m = (isPrimal ? columns : rows).map((a, _, all) => all.map((c) => dot(a, c, a.length)));
    const times = (x) => columns.map((column) => dot(column, x, 6));
    return isPrimal ? solve(m, times(b)) : times(solve(m, b.slice()));
}

/**
 * Sets q to start + step. Variables that exceed a bound are held at it, one at a time, the one with the
 * largest excess first.
 */
function depart(axes, start, bounds, q, twists, after) {
    const units = [UNIT_LIST];
    const columns = units.map((unit, j) => weighed(axes, twists.subarray(6 * j, 6 * j + 6), unit));
    const wanted = weighed(axes, after, -1);
    const add = (j, factor) => columns[j].forEach((entry, i) => (wanted[i] += entry * factor));
    units.forEach((unit, j) => add(j, (q[j] - start[j]) / unit));
    for (let round = 0; round <= units.length; round++) {
        const step = shortest(columns, wanted);
        let [furthest, held] = [0, -1];
        units.forEach((unit, j) => {
            // Skip variables that are held or do not move the tool.
            if (!(dot(columns[j], columns[j], 6) > 0)) return;
            q[j] = start[j] + step[j] * unit;
            const beyond = Math.abs(q[j] - clamped(q[j], bounds[j])) / unit;
            if (beyond > furthest) [furthest, held] = [beyond, j];
        });
        if (held < 0) break;
        q[held] = clamped(q[held], bounds[held]);
        add(held, (start[held] - q[held]) / units[held]);
        columns[held].fill(0);
    }
    bounds.forEach((interval, j) => (q[j] = clamped(q[j], interval)));
    return q;
}
";

/// Arguments that may be left out.
const WITHOUT_LAST: &str = "Without `last`, no cycle precedes: corrections have any size. With it, `change` and `largest` are \
     those of `description.variables` if they are left out, and `rotations` is the whole pose. Throws a RangeError if an \
     argument has another length, a number is not finite or an input is outside its range.";

const COMPENSATE: &str = "\
export function compensated(q, s, u, last, change, largest, rotations = [1, 1, 1]) {
    const { variables, parameters, inputs } = description;
    const units = [UNIT_LIST];
    const either = (list, name) => list ?? variables.map((one) => (last === undefined ? Infinity : one[name]));
    [change, largest] = [either(change, 'change'), either(largest, 'largest')];
    last ??= units.map(() => 0);
    [['q', q, COUNT], ['s', s, parameters.length], ['u', u, inputs.length], ['last', last, COUNT]].forEach((one) => given(...one));
    given('rotations', rotations, 3);
    [['change', change, COUNT], ['largest', largest, COUNT]].forEach((one) => given(...one, true));
    inputs.forEach(({ name, range: [lower, upper] }, k) => {
        if (u[k] < lower || u[k] > upper) throw new RangeError(`input ${name} is outside its range, ${lower} to ${upper}`);
    });
    const target = pose(q, s);
    const axes = [0, 1, 2].map((k) => target.slice(3 * k, 3 * k + 3).map((entry) => entry * rotations[k]));
    const cost = (rows) => {
        const weighted = weighed(axes, rows, 1);
        return dot(weighted, weighted, 6);
    };
    let columns;
    const errorAt = (at) => {
        const step = compensator_step(at, s, u);
        columns = step.columns;
        const rows = deviation(target, step.pose);
        given('result', rows, 6);
        return rows;
    };
    const start = variables.map(({ limits }, j) => clamped(q[j], limits));
    const bounds = variables.map(({ limits }, j) => {
        const [far, size] = [change[j] > 0 ? change[j] : 0, largest[j] > 0 ? largest[j] : 0];
        const end = (size) => clamped(start[j] + clamped(size, [last[j] - far, last[j] + far]), limits);
        return [end(-size), end(size)];
    });
    const before = errorAt(q);
    let at = Float64Array.from(bounds, (interval, j) => clamped(start[j] + last[j], interval));
    let now = at.some((value, j) => value !== q[j]) ? errorAt(at) : before;
    let [corrected, after, least, moved] = [at, now, cost(now), 0];
    const isInside = bounds.every(([lower, upper], j) => q[j] >= lower && q[j] <= upper);
    if (isInside && cost(before) < least) {
        [corrected, after, least] = [Float64Array.from(q), before, cost(before)];
    }
    for (let iteration = 0; iteration < ITERATIONS; iteration++) {
        const from = at;
        at = depart(axes, start, bounds, from.slice(), columns, now);
        moved = Math.max(...units.map((unit, j) => Math.abs(at[j] - from[j]) / unit));
        now = errorAt(at);
        if (cost(now) < least) [corrected, after, least] = [at, now, cost(now)];
    }
    const correction = corrected.map((value, j) => value - start[j]);
    const weighted = weighed(axes, after, 1);
    const [position, turn] = [weighted.slice(0, 3), weighted.slice(3)].map((rows) => Math.sqrt(dot(rows, rows, 3)));
    const isHeld = corrected.some((value, j) => value <= bounds[j][0] || value >= bounds[j][1]);
    const { OK, NOT_CONVERGED, HELD, OUTSIDE_LIMITS, NOT_REACHED } = description.statuses;
    let status = moved > REST ? NOT_CONVERGED : NOT_REACHED;
    if (isHeld) status = HELD;
    if (position <= REACHED_POSITION && turn <= REACHED_ROTATION) status = OK;
    if (start.some((value, j) => value !== q[j])) status = OUTSIDE_LIMITS;
    return { corrected, correction, before, after, status };
}
";
