// Commands that give the figures of a state.

import { joints, settings } from "./state.js";

/** @import { Report, State } from "./state.js" */

/** Quotes a word for a shell. @param {string} word @returns {string} */
const quoted = (word) => (/^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`);

/**
 * Returns the commands that give the figures of a state: `abbe analyze` and `abbe jacobian`.
 * Tolerances that differ from those of the study stand in the first.
 * @param {Report} report @param {State} state @param {Record<"position" | "orientation", number | null>} [tolerances]
 * @returns {[string, string]}
 */
export function commands(report, state, tolerances) {
    const isEnabled = report.sources.map(({ enabled, follows }, k) => follows === k && state.factors[k] > 0 && !enabled);
    const changes = settings(report, state).flatMap(([name, value]) => ["--set", `${name}=${value}`]);
    // A source that is switched off keeps its weight, which also loads others, as at a factor of 0 in the page.
    report.sources.forEach(({ name, enabled, follows }, k) => {
        if (isEnabled[k]) changes.push("--enable", name);
        if (follows === k && state.factors[k] !== 1 && (enabled || isEnabled[k])) changes.push("--scale", `${name}=${state.factors[k]}`);
    });
    changes.push("--q", joints(report, state));
    /** @param {string} name @param {string[]} options of the page's own command; the state may enable what they disable */
    const line = (name, options) => {
        const pairs = options.flatMap((option, i) => (i % 2 === 0 ? [[option, options[i + 1]]] : []));
        const kept = pairs.filter(([option, value]) =>
            !/able$/.test(option) || !report.sources.some(({ name }, k) => isEnabled[k] && name === value));
        return ["abbe", name, report.spec, ...kept.flat(), ...changes].map(quoted).join(" ");
    };
    const { tolerance, orientation_tolerance: orientation } = report.study;
    const isTyped = tolerances !== undefined && (tolerances.position !== tolerance || tolerances.orientation !== orientation);
    const typed = isTyped ? [[tolerances.position, report.length], [tolerances.orientation, "rad"]] : [];
    const limits = typed.flatMap(([value, unit]) => (value === null ? [] : ["--tolerance", `${value}${unit}`]));
    const given = report.command.filter((option, i) => !(isTyped && report.command[i - (i % 2)] === "--tolerance"));
    return [line("analyze", [...given, ...limits]), line("jacobian", report.jacobian_command)];
}
