// Commands that give the figures of a state.

import { joints, settings } from "./state.js";

/** @import { Report, State } from "./state.js" */

/** Quotes a word for a shell. @param {string} word @returns {string} */
const quoted = (word) => (/^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`);

/**
 * Returns the commands that give the figures of a state: `abbe analyze` and `abbe jacobian`.
 * @param {Report} report @param {State} state @returns {[string, string]}
 */
export function commands(report, state) {
    const isReversed = report.sources.map(({ enabled, follows }, k) => follows === k && state.factors[k] > 0 !== enabled);
    const changes = settings(report, state).flatMap(([name, value]) => ["--set", `${name}=${value}`]);
    report.sources.forEach(({ name, enabled, follows }, k) => {
        const factor = follows === k ? state.factors[k] : 1;
        if (isReversed[k]) changes.push(enabled ? "--disable" : "--enable", name);
        if (factor > 0 && factor !== 1) changes.push("--scale", `${name}=${factor}`);
    });
    if (state.q.length > 0) changes.push("--q", joints(report, state));
    /** @param {string} name @param {string[]} options of the page's own command; the state may reverse its switches */
    const line = (name, options) => {
        const pairs = options.flatMap((option, i) => (i % 2 === 0 ? [[option, options[i + 1]]] : []));
        const kept = pairs.filter(([option, value]) =>
            !/able$/.test(option) || !report.sources.some(({ name }, k) => isReversed[k] && name === value));
        return ["abbe", name, report.spec, ...kept.flat(), ...changes].map(quoted).join(" ");
    };
    return [line("analyze", report.command), line("jacobian", report.jacobian_command)];
}
