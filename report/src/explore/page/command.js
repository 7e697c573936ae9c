// Commands that give the figures of a state, and these figures as the commands print them.

import { decimals, digits, exact, fixed, percent, roundedDown } from "./number.js";
import { initialState, variableUnit } from "./state.js";
import { tighten } from "./search.js";

/**
 * @import { Report, State } from "./state.js"
 * @import { Errors } from "./machine.js"
 */

/** Quotes a word for a shell. @param {string} word @returns {string} */
export function quoted(word) {
    return /^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}

/**
 * Returns the commands that give the figures of a state: `abbe analyze` and `abbe jacobian`.
 * @param {Report} report @param {State} state @returns {[string, string]}
 */
export function commands(report, state) {
    const initial = initialState(report);
    /** @type {string[]} */
    const changes = [];
    report.parameters.forEach(({ name, unit }, i) => {
        if (state.s[i] !== initial.s[i]) changes.push("--set", `${name}=${exact(state.s[i], unit)}`);
    });
    report.inputs.forEach(({ name, unit }, i) => {
        if (state.u[i] !== initial.u[i]) changes.push("--set", `${name}=${exact(state.u[i], unit)}`);
    });
    report.sources.forEach(({ name, enabled }, i) => {
        const factor = state.factors[i];
        if (factor > 0 !== enabled) changes.push(enabled ? "--disable" : "--enable", name);
        if (factor > 0 && factor !== 1) changes.push("--scale", `${name}=${factor}`);
    });
    // The options of the page's own command, without switches that the state reverses.
    const options = report.command.flatMap((option, i, all) => (i % 2 === 0 ? [[option, all[i + 1]]] : []));
    const kept = options.filter(([option, value]) =>
        !["--enable", "--disable"].includes(option) || !report.sources.some(({ name, enabled }, i) =>
            name === value && state.factors[i] > 0 !== enabled));
    const q = state.q.length > 0 ? ["--q", state.q.map((value, i) => exact(value, variableUnit(report, i))).join(",")] : [];
    /** @param {string} command @param {string[][]} options */
    const line = (command, options) =>
        ["abbe", command, report.spec, ...options.flat(), ...changes, ...q].map(quoted).join(" ");
    return [line("analyze", kept), line("jacobian", kept.filter(([option]) => option !== "--study"))];
}

/**
 * Figures as `abbe analyze` prints them; empty texts and lists where it prints nothing.
 * @typedef {object} Printed
 * @property {string} total position, such as `5.480 mm`
 * @property {string} share of the tolerance, such as `1096 %`
 * @property {string} random norm of the random sources, if there are repeatable ones too
 * @property {string} randomShare
 * @property {string} orientation total orientation, such as `0.1225 mrad`
 * @property {string} orientationShare
 * @property {{source: number, max: string, share: string, factor: string}[]} sources largest position error first, with the
 *     share of the sum and the factor at which the source alone would use up the tolerance
 * @property {string} together factor at which all sources use up the tolerance
 */

/**
 * Formats the errors of a state, or the largest ones over several.
 * @param {Report} report @param {Pick<Errors, "position" | "orientation">} errors @returns {Printed}
 */
export function printed(report, { position, orientation }) {
    const [symbol, factor] = report.error_unit.length;
    const { tolerance, orientation_tolerance } = report.study;
    const shown = decimals(factor * position.radius, 4);
    /** @param {number} value */
    const length = (value) => fixed(factor * value, shown);
    /** @param {number} value @param {number | null} limit */
    const share = (value, limit) => (limit === null ? "" : percent(value, limit));
    /** @param {number | null} factor */
    const times = (factor) => (factor === null ? "" : `× ${roundedDown(factor, decimals(factor, 2))}`);
    const admissible = tolerance === null ? null : tighten(position, tolerance);
    const order = position.norms.map((_, k) => k).sort((a, b) => position.norms[b] - position.norms[a]);
    const sum = order.reduce((sum, k) => sum + position.norms[k], 0);
    const isMixed = position.randomRadius > 0 && position.repeatableRadius > 0;
    const isTurned = orientation.radius > 0;
    return {
        total: `${length(position.radius)} ${symbol}`,
        share: share(position.radius, tolerance),
        random: isMixed ? `${length(position.randomRadius)} ${symbol}` : "",
        randomShare: isMixed ? share(position.randomRadius, tolerance) : "",
        orientation: isTurned ? `${digits(1e3 * orientation.radius, 4)} mrad` : "",
        orientationShare: isTurned ? share(orientation.radius, orientation_tolerance) : "",
        sources: order.map((source) => ({
            source,
            max: length(position.norms[source]),
            share: percent(position.norms[source], sum),
            factor: times(admissible?.alone[source] ?? null),
        })),
        together: times(admissible?.together ?? null),
    };
}
