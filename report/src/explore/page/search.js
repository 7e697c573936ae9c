// Searches and curves over many states.

import { copyState } from "./state.js";

/**
 * @import { Report, State, Interval } from "./state.js"
 * @import { Combined, Evaluation, Machine } from "./machine.js"
 */

/** @typedef {"position" | "orientation"} Measurand */

/**
 * What a search varies and maximizes: the joints, with `inputs` also the inputs over their ranges, with `parameters` those
 * that the study varies. `samples` is the number of states of the first step.
 * @typedef {{measurand?: Measurand, inputs?: boolean, parameters?: boolean, samples?: number}} Options
 */

/**
 * Largest total that was found, its state and errors, and how many states were evaluated.
 * @typedef {{state: State, radius: number, evaluation: Evaluation, evaluations: number}} Worst
 */

/** Number of best samples from which the search ascends. */
const STARTS = 8;
/** Steps of the ascent as parts of a range: the first, and one that is small enough. */
const [FIRST_STEP, LAST_STEP] = [0.1, 1e-6];

/** @param {number[]} list @param {number} index @param {number} value @returns {number[]} */
const replaced = (list, index, value) => list.map((old, i) => (i === index ? value : old));

/** @param {Interval | null} interval @returns {interval is [number, number]} */
const isBounded = (interval) => interval !== null && interval[0] !== null && interval[1] !== null;

/** Returns the entries of a state that a search varies. @param {Report} report @param {Options} options */
function box(report, options) {
    /** @type {{list: "q" | "s" | "u", index: number, range: [number, number]}[]} */
    const axes = [];
    report.variables.forEach(({ kind, limits }, index) => {
        const turn = [-Math.PI, Math.PI];
        const [lower, upper] = limits.map((limit, end) => limit ?? (kind === "revolute" ? turn[end] : null));
        if (lower !== null && upper !== null) axes.push({ list: "q", index, range: [lower, upper] });
    });
    report.parameters.forEach(({ range }, index) => {
        if (options.parameters && isBounded(range)) axes.push({ list: "s", index, range });
    });
    report.inputs.forEach(({ range }, index) => {
        if (options.inputs && isBounded(range)) axes.push({ list: "u", index, range });
    });
    return axes;
}

/**
 * Searches the worst case in the joint box: samples of a low-discrepancy sequence, then ascent along each axis from the best
 * of them. The same arguments give the same result. Yields the part that is done.
 * @param {Machine} machine @param {Report} report @param {State} state @param {Options} [options]
 * @returns {Generator<number, Worst, void>}
 */
export function* worst(machine, report, state, options = {}) {
    const { measurand = "position", samples = 20000 } = options;
    const first = measurand === "position" ? 0 : 3;
    const axes = box(report, options);
    const trial = copyState(state);
    let evaluations = 0;
    /** @param {number[]} at coordinates from 0 to 1 @returns {number} */
    const total = (at) => {
        axes.forEach(({ list, index, range: [lower, upper] }, j) => (trial[list][index] = lower + at[j] * (upper - lower)));
        evaluations += 1;
        const radius = machine.radius(trial, first);
        return Number.isFinite(radius) ? radius : 0;
    };
    // Roberts' sequence: multiples of the powers of the root of g^(d + 1) = g + 1, modulo 1.
    let root = 1.5;
    for (let i = 0; i < 60; i++) root = (1 + root) ** (1 / (axes.length + 1));
    const steps = axes.map((_, j) => root ** -(j + 1));
    /** @type {{at: number[], radius: number}[]} */
    let best = [];
    for (let i = 0; i < samples; i++) {
        const at = steps.map((step) => (0.5 + (i + 1) * step) % 1);
        const radius = total(at);
        if (best.length < STARTS || radius > best[STARTS - 1].radius) {
            best = [...best, { at, radius }].sort((a, b) => b.radius - a.radius).slice(0, STARTS);
        }
        if (i % 64 === 0) yield (0.7 * i) / samples;
    }
    for (const [k, start] of best.entries()) {
        for (let step = FIRST_STEP; step > LAST_STEP; ) {
            const before = start.radius;
            axes.forEach((_, j) => {
                for (const direction of [step, -step]) {
                    const at = replaced(start.at, j, Math.min(Math.max(start.at[j] + direction, 0), 1));
                    const radius = total(at);
                    if (radius > start.radius) [start.at, start.radius] = [at, radius];
                }
            });
            if (!(start.radius > before)) step /= 2;
            yield 0.7 + (0.3 * k) / best.length;
        }
    }
    const [{ at }] = [...best].sort((a, b) => b.radius - a.radius);
    const radius = total(at);
    return { state: copyState(trial), radius, evaluation: machine.evaluate(trial), evaluations };
}

/** Runs a search to its end. @template T @param {Generator<number, T, void>} search @returns {T} */
export function finish(search) {
    for (;;) {
        const { done, value } = search.next();
        if (done) return value;
    }
}

/**
 * Curves along one joint: total, norm of the repeatable, of the random sources, and of each source.
 * @typedef {{values: number[], total: number[], repeatable: number[], random: number[], sources: number[][]}} Sweep
 */

/**
 * Evaluates states along one joint, from limit to limit.
 * @param {Machine} machine @param {Report} report @param {State} state @param {number} joint @param {number} [points]
 * @param {Measurand} [measurand] @returns {Sweep}
 */
export function sweep(machine, report, state, joint, points = 121, measurand = "position") {
    const { kind, limits } = report.variables[joint];
    const reach = kind === "revolute" ? Math.PI : 0;
    const [lower, upper] = [limits[0] ?? state.q[joint] - reach, limits[1] ?? state.q[joint] + reach];
    const values = Array.from({ length: points }, (_, i) => lower + ((upper - lower) * i) / (points - 1));
    const errors = values.map((value) => machine.errors({ ...state, q: replaced(state.q, joint, value) })[measurand]);
    return {
        values,
        total: errors.map(({ radius }) => radius),
        repeatable: errors.map(({ repeatableRadius }) => repeatableRadius),
        random: errors.map(({ randomRadius }) => randomRadius),
        sources: report.sources.map((_, k) => errors.map(({ norms }) => norms[k])),
    };
}

/** Returns the state of a configuration of the study, with the factors of a state. @param {Report} report @param {State} state @param {number} index @returns {State} */
export function stateAt({ configurations: { q, s, u } }, state, index) {
    return copyState({ ...state, q: q[index], s: s[index] ?? state.s, u: u[index] ?? state.u });
}

/**
 * Largest errors of a measurand over some states: of each source, the total and the index of its state, and all totals.
 * @typedef {{norms: number[], radius: number, worst: number, radii: number[]}} Largest
 */

/**
 * Evaluates the configurations of the study. `displacements` are Σ of the repeatable sources.
 * @param {Machine} machine @param {Report} report @param {State} state
 * @returns {{displacements: number[][], position: Largest, orientation: Largest}}
 */
export function cloud(machine, report, state) {
    const errors = report.configurations.q.map((_, index) => machine.errors(stateAt(report, state, index)));
    /** @param {Measurand} measurand @returns {Largest} */
    const largest = (measurand) => {
        const radii = errors.map((one) => one[measurand].radius);
        const worst = radii.reduce((best, radius, i) => (radius > (radii[best] ?? 0) ? i : best), 0);
        const norms = report.sources.map((_, k) => errors.reduce((most, one) => (one[measurand].norms[k] > most ? one[measurand].norms[k] : most), 0));
        return { norms, radius: radii[worst] || 0, worst, radii };
    };
    const displacements = errors.map(({ displacement }) => displacement);
    return { displacements, position: largest("position"), orientation: largest("orientation") };
}

/**
 * Factors at which a tolerance is used up; `null` for a source without effect. `alone`: each source without the others;
 * `together`: all sources; `equal`: each source if all contribute `share`.
 * @typedef {{alone: (number | null)[], together: number | null, share: number | null, equal: (number | null)[]}} Admissible
 */

/**
 * Returns the factors that meet a tolerance, as `abbe analyze` does it.
 * @param {{norms: number[], radius: number}} figures @param {number} tolerance in the unit of the figures @returns {Admissible}
 */
export function tighten({ norms, radius }, tolerance) {
    /** @param {number} limit @param {number} norm */
    const factor = (limit, norm) => (norm > 0 && Number.isFinite(limit / norm) ? limit / norm : null);
    const active = norms.filter((norm) => norm > 0).length;
    const share = active > 0 ? tolerance / active : null;
    return {
        alone: norms.map((norm) => factor(tolerance, norm)),
        together: factor(tolerance, radius),
        share,
        equal: norms.map((norm) => (share === null ? null : factor(share, norm))),
    };
}
