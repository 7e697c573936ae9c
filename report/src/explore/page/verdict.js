// Verdict: total error here and over the study against the tolerance, and the search of the worst case.

import { button, html, setText } from "./dom.js";
import { shown } from "./controls.js";
import { decimals, fixed, parseValue, percent, roundedDown, short } from "./number.js";
import { tighten } from "./search.js";
import { variableUnit } from "./state.js";
import { searchWorst } from "./worker.js";

/**
 * @import { Panel } from "./panel.js"
 * @import { State } from "./state.js"
 */

/** Formats an error with the decimals that show `largest` to four digits. @param {Panel} panel @param {number} value @param {number} largest */
function errorText({ unit }, value, largest) {
    return `${fixed(unit.factor * value, decimals(unit.factor * largest, 4))} ${unit.symbol}`;
}

/** Formats what a state sets: its joints, and what differs from the spec. @param {Panel} panel @param {State} state */
function placeText({ report }, state) {
    const joints = report.variables.map(({ name }, i) => `${name} = ${shown(state.q[i], variableUnit(report, i), report.length)}`);
    const others = [...report.parameters.map((one, i) => ({ ...one, value: state.s[i] })),
        ...report.inputs.map((one, i) => ({ ...one, value: state.u[i] }))].filter(({ value, nominal }) => value !== nominal);
    return [...joints, ...others.map(({ name, value, unit }) => `${name} = ${shown(value, unit, report.length)}`)].join(", ");
}

/** Creates the verdict. @param {Panel} panel */
export function createVerdict(panel) {
    const { report } = panel;
    const [status, total, share, parts, largest, before] =
        ["status", "total", "of", "parts", "largest", "before"].map((name) => html("span", { class: name }));
    const [repeatable, random, limit] = ["repeatable", "random", "limit"].map((name) => html("i", { class: name }));
    const gauge = html("div", { class: "gauge", "aria-hidden": true }, repeatable, random, limit);
    const tolerance = html("input", { type: "text", class: "tolerance", "aria-label": "tolerance", placeholder: "none" });
    const live = html("div", { class: "live", role: "status", "aria-live": "polite" });
    const here = html("div", { class: "here" }, html("p", { class: "line" }, status, total, share,
        html("label", {}, "tolerance ", tolerance)), gauge, html("p", { class: "detail" }, largest, parts, before));

    const [studyText, boxText] = [html("p"), html("p")];
    const studyButton = button("Show", () => panel.load(panel.cloud?.[panel.measurand].worst ?? 0));
    const study = html("div", { class: "study" }, html("h3", {}, "Worst in the study"), studyText, studyButton);
    const everything = html("input", { type: "checkbox" });
    const hasRanges = [...report.inputs, ...report.parameters].some(({ range }) => range?.[0] != null && range?.[1] != null);
    const progress = html("progress", { max: 1, value: 0, hidden: true, "aria-label": "Search of the worst case" });
    const searchButton = button("Find", () => void search(), { "aria-label": "Find the worst case within the joint limits" });
    const box = html("div", { class: "box" }, html("h3", {}, "Worst within the joint limits"), boxText, progress, searchButton,
        hasRanges ? html("label", {}, everything, " vary inputs and parameters too") : "");
    const element = html("div", { class: "verdict" }, here);
    const searches = html("div", { class: "searches" }, study, report.variables.length > 0 ? box : "");

    tolerance.addEventListener("change", () => {
        const { unit, measurand, tolerances } = panel;
        const value = tolerance.value.trim() === "" ? null : parseValue(tolerance.value, unit.symbol, report.length) ?? NaN;
        tolerance.toggleAttribute("aria-invalid", value !== null && !(value > 0));
        if (value === null || value > 0) tolerances[measurand] = value;
        panel.refresh();
    });

    /** @type {AbortController | null} */
    let running = null;
    /** Searches the worst case and loads it; a second click stops the search. */
    async function search() {
        if (running) return running.abort();
        running = new AbortController();
        progress.hidden = false;
        setText(searchButton, "Stop");
        const { measurand, index, state } = panel;
        const options = { measurand, inputs: everything.checked, parameters: everything.checked };
        try {
            const found = await searchWorst({ report, index, state, options }, (part) => { progress.value = part; }, running.signal);
            setText(boxText, `${errorText(panel, found.radius, found.radius)}${shareText(found.radius)} at ${placeText(panel, found.state)}; `
                + `${found.evaluations} configurations evaluated.`);
            panel.go(found.state);
        } catch (error) {
            setText(boxText, error instanceof DOMException && error.name === "AbortError" ? "Stopped." : String(error));
        }
        running = null;
        progress.hidden = true;
        setText(searchButton, "Find again");
    }

    /** @param {number} radius */
    function shareText(radius) {
        const limit = panel.tolerances[panel.measurand];
        return limit === null ? "" : `, ${percent(radius, limit)} of the tolerance`;
    }

    function update() {
        const { figures, reference, measurand, unit, tolerances, cloud } = panel;
        const errors = figures[measurand];
        const limitValue = tolerances[measurand];
        const isMet = limitValue !== null && errors.radius <= limitValue;
        element.classList.toggle("missed", limitValue !== null && !isMet);
        const isJudged = limitValue !== null && report.study.judged === "as-built";
        setText(status, !isJudged ? "As built, here" : isMet ? "✓ MET here" : "✗ NOT MET here");
        setText(total, errorText(panel, errors.radius, errors.radius));
        setText(share, limitValue === null ? "" : `${percent(errors.radius, limitValue)} of`);
        if (document.activeElement !== tolerance) tolerance.value = limitValue === null ? "" : `${short(unit.factor * limitValue)} ${unit.symbol}`;
        const end = Math.max(errors.radius, (limitValue ?? 0) * 1.25) || 1;
        repeatable.style.width = `${(100 * errors.repeatableRadius) / end}%`;
        random.style.width = `${(100 * errors.randomRadius) / end}%`;
        limit.hidden = limitValue === null;
        limit.style.left = `${(100 * (limitValue ?? 0)) / end}%`;
        const most = errors.norms.indexOf(Math.max(...errors.norms));
        const sum = errors.norms.reduce((all, one) => all + one, 0);
        setText(largest, sum > 0 ? `largest source: ${report.sources[most].name} (${percent(errors.norms[most], sum)})` : "no error here");
        setText(parts, `repeatable ${errorText(panel, errors.repeatableRadius, errors.radius)} + random ± ${errorText(panel, errors.randomRadius, errors.radius)}`);
        const old = reference?.[measurand].radius ?? 0;
        const change = old > 0 ? ` (${errors.radius >= old ? "+" : "−"}${percent(Math.abs(errors.radius - old), old)})` : "";
        setText(before, reference ? `before your changes ${errorText(panel, old, errors.radius)}${change}` : "");
        if (cloud) {
            const { radius, worst, norms } = cloud[measurand];
            const source = norms.indexOf(Math.max(...norms));
            const factors = limitValue === null ? null : tighten(cloud[measurand], limitValue);
            const times = (/** @type {number | null | undefined} */ factor) => `× ${roundedDown(factor ?? 0, decimals(factor ?? 0, 2))}`;
            setText(studyText, `${errorText(panel, radius, radius)}${shareText(radius)}, configuration ${worst + 1} of `
                + `${report.configurations.q.length}. ${factors ? `Tolerance met with all sources ${times(factors.together)}, with `
                + `${report.sources[source].name} alone ${times(factors.alone[source])}.` : ""}`);
        }
    }

    function settle() {
        setText(live, `${status.textContent}: ${total.textContent} ${share.textContent} ${tolerance.value}; ${largest.textContent}`);
    }
    element.append(live);
    return { element, searches, update, settle };
}
