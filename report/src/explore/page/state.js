// The state of a panel, and its text in the address of the page.

import { exact, parseValue } from "./number.js";

/**
 * Data of a machine. Numbers are in coherent units: the length unit and rad; `null` is infinite.
 * @typedef {object} Report
 * @property {string} spec
 * @property {string} name
 * @property {string} title
 * @property {string} description
 * @property {string[]} command options of the command line
 * @property {string} length
 * @property {Record<string, [string, number]>} error_unit symbol and factor
 * @property {string} orientation
 * @property {string[]} rows
 * @property {string[]} columns
 * @property {{title: string, tolerance: number | null, orientation_tolerance: number | null}} study
 * @property {{name: string}[]} frames
 * @property {boolean} tool
 * @property {{name: string, kind: "revolute" | "prismatic", limits: Interval, home: number, description: string}[]} variables
 * @property {{name: string, nominal: number, range: Interval, unit: string, description: string}[]} inputs
 * @property {{name: string, nominal: number, range: Interval | null, unit: string, description: string}[]} parameters
 * @property {Source[]} sources
 * @property {[number, number, number][]} effects source, frame and component of each
 * @property {{q: number[][], u: number[][], s: number[][]}} configurations
 * @property {string} code
 */

/** @typedef {[number | null, number | null]} Interval */

/**
 * @typedef {object} Source
 * @property {string} name
 * @property {"repeatable" | "random"} class
 * @property {string | null} distribution
 * @property {string} at
 * @property {boolean} enabled
 * @property {number | null} magnitude index of its magnitude among the inputs of the code
 * @property {number | null} value magnitude in the spec
 * @property {string} description
 */

/**
 * State of a panel: joint variables, parameters, inputs of the spec, and a factor per source, 0 if it is switched off.
 * @typedef {{q: number[], s: number[], u: number[], factors: number[]}} State
 */

/** Largest factor of a source. */
export const LARGEST_FACTOR = 3;

/** Returns the state of the spec at home. @param {Report} report @returns {State} */
export function initialState(report) {
    return {
        q: report.variables.map(({ home }) => home),
        s: report.parameters.map(({ nominal }) => nominal),
        u: report.inputs.map(({ nominal }) => nominal),
        factors: report.sources.map(({ enabled }) => Number(enabled)),
    };
}

/** @param {State} state @returns {State} */
export function copyState({ q, s, u, factors }) {
    return { q: [...q], s: [...s], u: [...u], factors: [...factors] };
}

/** Returns the unit in which a variable is shown. @param {Report} report @param {number} variable @returns {string} */
export function variableUnit(report, variable) {
    return report.variables[variable].kind === "revolute" ? "deg" : report.length;
}

/** Returns true if a value is in an interval. @param {number} value @param {Interval | null} interval @returns {boolean} */
export function isWithin(value, interval) {
    return value >= (interval?.[0] ?? -Infinity) && value <= (interval?.[1] ?? Infinity);
}

/** Returns the key of a parameter or an input; `q` is that of the joints. @param {string} name @returns {string} */
const keyOf = (name) => (name === "q" ? "set.q" : name);

/**
 * Returns what differs from the initial state, for the address behind `#`: `q=9,80,987,70deg,0,0&payload=70kg&factor.gear=0.5`.
 * @param {Report} report @param {State} state @param {string} [prefix] of the keys, which tells panels apart @returns {string}
 */
export function encodeState(report, state, prefix = "") {
    const [initial, parts] = [initialState(report), new URLSearchParams()];
    if (state.q.some((value, i) => value !== initial.q[i])) {
        parts.set(`${prefix}q`, state.q.map((value, i) => exact(value, variableUnit(report, i))).join(","));
    }
    report.parameters.forEach(({ name, unit }, i) => {
        if (state.s[i] !== initial.s[i]) parts.set(prefix + keyOf(name), exact(state.s[i], unit));
    });
    report.inputs.forEach(({ name, unit }, i) => {
        if (state.u[i] !== initial.u[i]) parts.set(prefix + keyOf(name), exact(state.u[i], unit));
    });
    report.sources.forEach(({ name }, i) => {
        if (state.factors[i] !== initial.factors[i]) parts.set(`${prefix}factor.${name}`, String(state.factors[i]));
    });
    return parts.toString().replaceAll("%2C", ",");
}

/**
 * Returns the state of an address. Values that cannot be parsed, or are outside limits, stay as in the initial state.
 * @param {Report} report @param {string} hash with or without `#` @param {string} [prefix] @returns {State}
 */
export function decodeState(report, hash, prefix = "") {
    const [state, parts] = [initialState(report), new URLSearchParams(hash.replace(/^#/, ""))];
    /** @param {string | null} text @param {string} unit @param {Interval | null} interval @param {number} otherwise */
    const parsed = (text, unit, interval, otherwise) => {
        const value = text === null ? undefined : parseValue(text, unit, report.length);
        return value !== undefined && isWithin(value, interval) ? value : otherwise;
    };
    const q = parts.get(`${prefix}q`)?.split(",") ?? [];
    if (q.length === state.q.length) {
        state.q = state.q.map((home, i) => parsed(q[i], variableUnit(report, i), report.variables[i].limits, home));
    }
    state.s = report.parameters.map(({ name, unit, nominal }) => parsed(parts.get(prefix + keyOf(name)), unit, null, nominal));
    state.u = report.inputs.map(({ name, unit, range, nominal }) => parsed(parts.get(prefix + keyOf(name)), unit, range, nominal));
    state.factors = report.sources.map(({ name }, i) =>
        parsed(parts.get(`${prefix}factor.${name}`), "", [0, LARGEST_FACTOR], state.factors[i]));
    return state;
}
