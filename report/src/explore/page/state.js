// The state of a panel, and its text in the address of the page.

import { exact, parseValue } from "./number.js";

/** Lower and upper end; `null` is infinite. @typedef {[number | null, number | null]} Interval */

/** @typedef {{name: string, kind: "revolute" | "prismatic", limits: Interval, home: number, description: string}} Variable */

/** @typedef {{name: string, nominal: number, range: Interval | null, unit: string, description: string}} Setting */

/**
 * An error source. `bound` is that of a random one as a multiple of its magnitude, `magnitude` the index of that of a
 * repeatable one among the inputs of the code, `value` its value, `follows` the source whose factor applies, if one does, and
 * `parts` the sources of the code that are its own or parts of its error.
 * @typedef {{name: string, class: "repeatable" | "tolerance" | "random", distribution: string | null, bound: number, at: string,
 *     enabled: boolean, parts: number[], magnitude: number | null, value: number, follows: number | null, description: string}} Source
 */

/**
 * Measured rows in F_0 with names of their errors; their configurations are those of the report.
 * @typedef {{before: string | null, after: string, count: number, rows: {line: number, point: number[], before: number[] | null, after: number[]}[]}} Residuals
 */

/**
 * Data of a machine. Numbers are in coherent units: the length unit and rad. `command` and `jacobian_command` are options
 * of the commands, `effects` source, frame and component of each effect, `configurations` those of the study.
 * @typedef {{spec: string, name: string, title: string, description: string, command: string[], length: string,
 *     jacobian_command: string[], error_unit: Record<string, [string, number]>, orientation: string, rows: string[],
 *     columns: string[], frames: {name: string}[], links: [number, number][], has_loops: boolean, tool: boolean, up: number, variables: Variable[], inputs: Setting[],
 *     study: {title: string, tolerance: number | null, orientation_tolerance: number | null, judged: string, criterion: string},
 *     parameters: Setting[], sources: Source[], effects: [number, number, number][],
 *     configurations: {q: number[][], u: number[][], s: number[][]}, residuals?: Residuals, code: string}} Report
 */

/**
 * State of a panel: joint variables, parameters, inputs of the spec, and a factor per source, 0 if it is switched off.
 * @typedef {{q: number[], s: number[], u: number[], factors: number[]}} State
 */

/** Largest factor of a source. */
export const LARGEST_FACTOR = 3;

/** Returns the state of the spec at home. @param {Report} report @returns {State} */
export function initialState({ variables, parameters, inputs, sources }) {
    const [s, u] = [parameters, inputs].map((all) => all.map(({ nominal }) => nominal));
    return { q: variables.map(({ home }) => home), s, u, factors: sources.map(({ enabled }) => Number(enabled)) };
}

/** Returns the factor that applies to a source. @param {Report} report @param {State} state @param {number} k @returns {number} */
export function factorOf({ sources }, { factors }, k) {
    const { follows, enabled } = sources[k];
    return follows === null ? Number(enabled) : factors[follows];
}

/** Copies a state. @param {State} state @returns {State} */
export const copyState = ({ q, s, u, factors }) => ({ q: [...q], s: [...s], u: [...u], factors: [...factors] });

/** Returns the unit in which a variable is shown. @param {Report} report @param {number} i @returns {string} */
export const variableUnit = ({ variables, length }, i) => (variables[i].kind === "revolute" ? "deg" : length);

/** Returns true if a value is in an interval. @param {number} value @param {Interval | null} interval @returns {boolean} */
export const isWithin = (value, interval) => value >= (interval?.[0] ?? -Infinity) && value <= (interval?.[1] ?? Infinity);

/** Returns the joint variables with units and all digits. @param {Report} report @param {State} state @returns {string} */
export const joints = (report, { q }) => q.map((value, i) => exact(value, variableUnit(report, i))).join(",");

/**
 * Returns the parameters and inputs that differ from the spec, with units and all digits.
 * @param {Report} report @param {State} state @returns {[string, string][]} names and values
 */
export function settings({ parameters, inputs }, { s, u }) {
    const values = [...s, ...u];
    return [...parameters, ...inputs].flatMap(({ name, unit, nominal }, i) =>
        values[i] === nominal ? [] : [[name, exact(values[i], unit)]]);
}

/** Returns the key of a parameter or input; some names are keys of the page. @param {string} name @returns {string} */
const keyOf = (name) => (["q", "tolerances", "shown"].includes(name) ? `set.${name}` : name);

/**
 * Returns what differs from the spec at home, for the address: `q=9mm,70deg&payload=70kg&factor.gear=0.5`.
 * @param {Report} report @param {State} state @param {string} [prefix] of the keys, which tells panels apart @returns {string}
 */
export function encodeState(report, state, prefix = "") {
    const [initial, parts] = [initialState(report), new URLSearchParams()];
    if (String(state.q) !== String(initial.q)) parts.set(`${prefix}q`, joints(report, state));
    for (const [name, value] of settings(report, state)) parts.set(prefix + keyOf(name), value);
    report.sources.forEach(({ name, follows }, k) => {
        if (follows === k && state.factors[k] !== initial.factors[k]) parts.set(`${prefix}factor.${name}`, String(state.factors[k]));
    });
    return parts.toString().replaceAll("%2C", ",");
}

/**
 * Returns the state of an address. What cannot be parsed, or is outside limits, stays as in the spec at home, and is listed.
 * @param {Report} report @param {string} hash with or without `#` @param {string} [prefix] @param {string[]} [ignored] filled
 * @returns {State}
 */
export function decodeState(report, hash, prefix = "", ignored = []) {
    const [initial, parts] = [initialState(report), new URLSearchParams(hash.replace(/^#/, ""))];
    /** @param {string} name @param {string | null} text @param {string} unit @param {Interval | null} interval @param {number} otherwise */
    const parsed = (name, text, unit, interval, otherwise) => {
        const value = parseValue(text ?? "", unit, report.length);
        if (value !== undefined && isWithin(value, interval)) return value;
        if (text) ignored.push(`${name}=${text}`);
        return otherwise;
    };
    const known = new Set(["tolerances", "shown"]);
    const read = (/** @type {string} */ key) => {
        known.add(key);
        return parts.get(prefix + key);
    };
    const q = read("q")?.split(",") ?? [];
    const state = {
        q: report.variables.map(({ name, limits, home }, i) =>
            parsed(name, q.length === initial.q.length ? q[i] : "", variableUnit(report, i), limits, home)),
        s: report.parameters.map(({ name, unit, nominal }) => parsed(name, read(keyOf(name)), unit, null, nominal)),
        u: report.inputs.map(({ name, unit, range, nominal }) => parsed(name, read(keyOf(name)), unit, range, nominal)),
        factors: report.sources.map(({ name }, k) => parsed(`factor.${name}`, read(`factor.${name}`), "", [0, LARGEST_FACTOR], initial.factors[k])),
    };
    if (q.length > 0 && q.length !== initial.q.length) ignored.push(`q=${q}`);
    for (const key of parts.keys()) {
        const isOwn = key.startsWith(prefix) && (prefix !== "" || !/^\d+\./.test(key));
        if (isOwn && !known.has(key.slice(prefix.length))) ignored.push(`${key.slice(prefix.length)}=${parts.get(key)}`);
    }
    return state;
}
