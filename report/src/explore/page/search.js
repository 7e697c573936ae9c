// The worst case in the joint box, curves along a joint, errors over the configurations of the study.

import { steady } from "./number.js";
import { copyState } from "./state.js";

/** @import { Report, State, Variable } from "./state.js" @import { Combined, Evaluation, Machine } from "./machine.js" */

/** @typedef {"position" | "orientation"} Measurand */

/**
 * Options of a search, which varies the joints, with `inputs` also the inputs over their ranges, with `parameters` those
 * that the study varies. `samples` is the number of states of its first step.
 * @typedef {{measurand?: Measurand, inputs?: boolean, parameters?: boolean, samples?: number}} Options
 */

/** Largest total that was found. @typedef {{state: State, radius: number, evaluation: Evaluation, evaluations: number}} Worst */

/** Number of best samples from which the search ascends, and steps of the ascent as parts of a range: first and last. */
const [STARTS, FIRST_STEP, LAST_STEP] = [8, 0.1, 1e-6];

/** Returns a list with another value at an index. @param {number[]} list @param {number} index @param {number} value @returns {number[]} */
export const replaced = (list, index, value) => list.map((old, i) => (i === index ? value : old));

/** Returns a value between two ends, and exactly them at 0 and 1. @param {number} a @param {number} b @param {number} t */
const mixed = (a, b, t) => (1 - t) * a + t * b;

/** Returns finite limits: one turn where a revolute joint has none. @param {Variable} variable @returns {[number, number]} */
function reach({ kind, limits, home }) {
    const far = kind === "revolute" ? Math.PI : 0;
    return [limits[0] ?? home - far, limits[1] ?? home + far];
}

/** Returns what a search varies, with its ends. @param {Report} report @param {Options} options */
function axesOf({ variables, parameters, inputs }, options) {
    const ranges = {
        q: variables.map(reach),
        s: options.parameters ? parameters.map(({ range }) => range) : [],
        u: options.inputs ? inputs.map(({ range }) => range) : [],
    };
    return /** @type {const} */ (["q", "s", "u"]).flatMap((list) => ranges[list].flatMap((range, index) => {
        const [lower, upper] = range ?? [null, null];
        return lower === null || upper === null ? [] : [{ list, index, lower, upper }];
    }));
}

/**
 * Searches the largest total: samples of a low-discrepancy sequence, then ascent along every axis from the best of them.
 * The same arguments give the same result. Yields the part that is done.
 * @param {Machine} machine @param {Report} report @param {State} state @param {Options} [options]
 * @returns {Generator<number, Worst, void>}
 */
export function* worst(machine, report, state, options = {}) {
    const { measurand = "position", samples = 20000 } = options;
    const axes = axesOf(report, options);
    const trial = copyState(state);
    let evaluations = 0;
    /** @param {number[]} at coordinates from 0 to 1 @returns {number} */
    const total = (at) => {
        axes.forEach(({ list, index, lower, upper }, j) => (trial[list][index] = mixed(lower, upper, at[j])));
        evaluations += 1;
        return machine.errors(trial)[measurand].radius || 0;
    };
    // Roberts' sequence: multiples of the powers of 1/g modulo 1, with g^(d + 1) = g + 1.
    let root = 1.5;
    for (let i = 0; i < 60; i++) root = (1 + root) ** (1 / (axes.length + 1));
    /** @type {{at: number[], radius: number}[]} */
    let best = [];
    for (let i = 0; i < samples; i++) {
        const at = axes.map((_, j) => (0.5 + (i + 1) * root ** -(j + 1)) % 1);
        const radius = total(at);
        if (best.length < STARTS || radius > best[STARTS - 1].radius) {
            best = [...best, { at, radius }].sort((a, b) => b.radius - a.radius).slice(0, STARTS);
        }
        if (i % 512 === 511) yield (0.8 * i) / samples;
    }
    for (const [k, start] of best.entries()) {
        for (let step = FIRST_STEP; step > LAST_STEP; ) {
            const before = start.radius;
            for (let j = 0; j < axes.length; j++) {
                for (const direction of [step, -step]) {
                    const at = replaced(start.at, j, Math.min(Math.max(start.at[j] + direction, 0), 1));
                    const radius = total(at);
                    if (radius > start.radius) [start.at, start.radius] = [at, radius];
                }
            }
            if (start.radius === before) step /= 2;
        }
        yield 0.8 + (0.2 * (k + 1)) / best.length;
    }
    const radius = total(best.reduce((one, other) => (other.radius > one.radius ? other : one)).at);
    return { state: trial, radius, evaluation: machine.evaluate(trial), evaluations };
}

/**
 * Curves along a joint: total, norm of the repeatable, of the random sources, and of each source.
 * @typedef {{values: number[], total: number[], repeatable: number[], random: number[], sources: number[][]}} Sweep
 */

/**
 * Evaluates states along a joint, from limit to limit.
 * @param {Machine} machine @param {Report} report @param {State} state @param {number} joint @param {number} [points]
 * @param {Measurand} [measurand] @returns {Sweep}
 */
export function sweep(machine, report, state, joint, points = 121, measurand = "position") {
    const [lower, upper] = reach(report.variables[joint]);
    const values = Array.from({ length: points }, (_, i) => mixed(lower, upper, i / (points - 1)));
    const errors = values.map((value) => machine.errors({ ...state, q: replaced(state.q, joint, value) })[measurand]);
    return {
        values,
        total: errors.map(({ radius }) => radius),
        repeatable: errors.map(({ repeatableRadius }) => repeatableRadius),
        random: errors.map(({ randomRadius }) => randomRadius),
        sources: report.sources.map((_, k) => errors.map(({ norms }) => norms[k])),
    };
}

/**
 * Returns a state with the values of a configuration of the study.
 * @param {Report} report @param {State} state @param {number} index @returns {State}
 */
export function stateAt({ configurations: { q, s, u } }, state, index) {
    return copyState({ ...state, q: q[index], s: s[index] ?? state.s, u: u[index] ?? state.u });
}

/**
 * Largest errors over states: of each source, the total with the index of its state, and all totals.
 * @typedef {{norms: number[], radius: number, worst: number, radii: number[]}} Largest
 */

/**
 * Evaluates the configurations of the study.
 * @param {Machine} machine @param {Report} report @param {State} state @returns {Record<Measurand, Largest>}
 */
export function cloud(machine, report, state) {
    const all = report.configurations.q.map((_, index) => machine.errors(stateAt(report, state, index)));
    /** @param {number[]} values */
    const largest = (values) => values.reduce((most, value) => (value > most ? value : most), 0);
    /** @param {Measurand} measurand @returns {Largest} */
    const over = (measurand) => {
        const radii = all.map((errors) => errors[measurand].radius);
        const norms = report.sources.map((_, k) => largest(all.map((errors) => errors[measurand].norms[k])));
        return { norms, radius: largest(radii), worst: Math.max(radii.indexOf(largest(radii)), 0), radii };
    };
    return { position: over("position"), orientation: over("orientation") };
}

/**
 * Returns the factor at which an error of this size uses up a tolerance, as `abbe analyze` does it; `null` without an error.
 * @param {number} size @param {number} tolerance in the same unit @returns {number | null}
 */
export const factorAt = (size, tolerance) => (size > 0 && tolerance / size < Infinity ? steady(tolerance / size) : null);

/**
 * Returns the smallest and the largest factor of a source, relative to its size now, between which the total meets a
 * tolerance while the others stay. Null if the source has no effect, or if the total is too large with any factor.
 * @param {Machine} machine @param {Combined} errors @param {number} k @param {number[]} rows of the source @param {number} tolerance
 * @returns {[number, number] | null}
 */
export function allowed(machine, errors, k, rows, tolerance) {
    const size = Math.hypot(...rows);
    if (!(size > 0)) return null;
    // The total is a convex function of the factor.
    const total = (/** @type {number} */ factor) => machine.rescaled(errors, k, rows, factor);
    const end = (tolerance + total(0)) / size;
    let [lower, upper] = [0, end];
    for (let i = 0; i < 60 && total(lower) > tolerance; i++) {
        const [a, b] = [0.618 * lower + 0.382 * upper, 0.382 * lower + 0.618 * upper];
        if (total(a) <= tolerance || total(b) <= tolerance) {
            [lower, upper] = total(a) <= tolerance ? [a, a] : [b, b];
        } else if (total(a) < total(b)) upper = b;
        else lower = a;
    }
    if (total(lower) > tolerance) return null;
    /** Returns the factor between one that meets the tolerance and one that does not. @param {number} good @param {number} bad */
    const limit = (good, bad) => {
        for (let i = 0; i < 60; i++) {
            const middle = (good + bad) / 2;
            if (total(middle) <= tolerance) good = middle;
            else bad = middle;
        }
        return good;
    };
    return [total(0) <= tolerance ? 0 : limit(lower, 0), limit(lower, end * (1 + 1e-9))];
}
