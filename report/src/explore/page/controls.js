// Sliders and fields of joints, inputs, parameters and factors.

import { html, roundStep, setText } from "./dom.js";
import { inUnit, parseValue } from "./number.js";
import { isWithin, variableUnit } from "./state.js";
/** @import { Interval, Report, State } from "./state.js" @import { Panel } from "./panel.js" */

/**
 * Number that a slider and a field change: the slider between `ends`, the field also beyond them, within `limits`.
 * @typedef {{name: string, description: string, unit: string, ends: [number, number], limits: Interval | null,
 *     get: () => number, set: (value: number) => void}} Value
 */

let identifiers = 0;

/** Formats a value with its unit. @param {number} value @param {string} unit @param {string} length unit of the spec */
export function shown(value, unit, length) {
    const number = inUnit(value, unit, length);
    return unit === "deg" ? `${number}°` : `${number} ${unit}`.trimEnd();
}

/** Creates a slider over round values, a field, and a place for what is wrong in it. @param {Value} value @param {string} length */
export function createInput({ name, unit, ends, limits, get, set }, length) {
    const factor = unit === "deg" ? 180 / Math.PI : 1;
    const [least, most] = ends.map((end) => end * factor);
    const [step, id] = [roundStep((most - least) / 200), `abbe-field-${++identifiers}`];
    const slider = html("input", { type: "range", "aria-label": `${name}, slider`, min: Math.floor(least / step + 1e-9),
        max: Math.ceil(most / step - 1e-9) });
    const field = html("input", { type: "text", id, autocomplete: "off", spellcheck: "false", "aria-label": name,
        "aria-describedby": `${id}-problem` });
    const problem = html("output", { class: "problem", id: `${id}-problem` });
    let [current, text] = [NaN, ""];
    const explain = (/** @type {string} */ message) => {
        setText(problem, message);
        field.setAttribute("aria-invalid", String(message !== ""));
    };
    slider.addEventListener("input", () => {
        const at = Number((Number(slider.value) * step).toPrecision(12));
        set(at <= least ? ends[0] : at >= most ? ends[1] : parseValue(String(at), unit, length) ?? get());
    });
    const commit = () => {
        if (field.value === text) return explain("");
        const parsed = parseValue(field.value, unit, length);
        if (parsed === undefined) return explain(`expected a number${unit && ` in ${unit}`}, such as ${text}`);
        const [from, to] = [limits?.[0], limits?.[1]].map((end) => (end == null ? "" : shown(end, unit, length)));
        if (!isWithin(parsed, limits)) return explain(`outside ${from} … ${to}`);
        current = NaN;
        set(parsed);
    };
    field.addEventListener("change", commit);
    field.addEventListener("keydown", ({ key }) => {
        if (key !== "Escape") return;
        field.value = text;
        explain("");
        field.blur();
    });
    field.addEventListener("focus", () => field.select());
    const update = () => {
        if (get() === current) return;
        current = get();
        text = shown(current, unit, length);
        field.value = text;
        slider.value = String(Math.round((current * factor) / step));
        slider.setAttribute("aria-valuetext", text);
        explain("");
    };
    return { slider, field, problem, update };
}

/** Returns the ends of a slider; without limits, as far away as zero. @param {Interval | null} limits @param {number} value @returns {[number, number]} */
function endsOf(limits, value) {
    const size = Math.abs(value) || 1;
    return [Math.min(limits?.[0] ?? value - size, value), Math.max(limits?.[1] ?? value + size, value)];
}

/** Returns the ends of the slider of a joint: its limits, or a turn. @param {Report} report @param {number} joint */
export function jointEnds({ variables }, joint) {
    const { kind, limits, home } = variables[joint];
    return endsOf(kind === "revolute" ? [limits[0] ?? -Math.PI, limits[1] ?? Math.PI] : limits, home);
}

/** Creates the controls; parameters that the study does not vary are folded. @param {Panel} panel */
export function createControls(panel) {
    const { report, state, change } = panel;
    const updates = /** @type {(() => void)[]} */ ([]);
    const row = (/** @type {Value} */ value) => {
        const { slider, field, problem, update } = createInput(value, report.length);
        updates.push(update);
        return html("div", { class: "row", title: value.description }, html("label", { for: field.id }, value.name), slider, field, problem);
    };
    const group = (/** @type {string} */ title, /** @type {Value[]} */ values, tag = /** @type {"fieldset" | "details"} */ ("fieldset")) =>
        (values.length === 0 ? "" : html(tag, {}, html(tag === "details" ? "summary" : "legend", {}, title), ...values.map(row)));
    const access = (/** @type {"q" | "s" | "u"} */ list, /** @type {number} */ i) => ({ get: () => state[list][i],
        set: (/** @type {number} */ value) => change(() => {
            state[list][i] = value;
            if (list === "q") panel.joint = i;
        }) });
    const joints = report.variables.map((one, i) => ({ ...one, ...access("q", i), unit: variableUnit(report, i), ends: jointEnds(report, i) }));
    const inputs = report.inputs.map((one, i) => ({ ...one, ...access("u", i), limits: one.range, ends: endsOf(one.range, one.nominal) }));
    const parameters = report.parameters.map((one, i) => ({ ...one, ...access("s", i), limits: null, ends: endsOf(one.range, one.nominal) }));
    const [varied, others] = [true, false].map((isVaried) => parameters.filter(({ range }) => (range !== null) === isVaried));
    const element = html("div", { class: "controls" }, group("Joints", joints), group("Inputs", inputs),
        group("Parameters of the study", varied), group(`Parameters (${others.length})`, others, "details"));
    return { element, update: () => updates.forEach((update) => update()) };
}
