// Sliders and fields of joints, inputs, parameters and factors.

import { html, roundStep, setText } from "./dom.js";
import { inUnit, parseValue, quantity } from "./number.js";
import { isWithin, variableUnit } from "./state.js";

/**
 * @import { Interval, Report } from "./state.js"
 * @import { Panel } from "./panel.js"
 */

/**
 * Number that a slider and a field change. The slider has `ends`; the field accepts what is within `limits`.
 * @typedef {object} Value
 * @property {string} name
 * @property {string} [description]
 * @property {string} unit
 * @property {[number, number]} ends
 * @property {Interval | null} limits
 * @property {() => number} get
 * @property {(value: number) => void} set
 */

/** Smallest number of steps of a slider. */
const STEPS = 200;
let identifiers = 0;

/** Formats a value with its unit. @param {number} value @param {string} unit @param {string} length */
export function shown(value, unit, length) {
    const number = inUnit(value, unit, length);
    return unit === "deg" ? `${number}°` : `${number} ${unit}`.trimEnd();
}

/**
 * Creates a slider over round values and the ends, and a field that accepts any value with a unit.
 * @param {Value} value @param {string} length unit of the spec
 */
export function createInput({ name, unit, ends, limits, get, set }, length) {
    const [least, most] = ends.map((end) => (unit === "deg" ? (end * 180) / Math.PI : end));
    const step = roundStep((most - least) / STEPS || 1);
    const id = `abbe-field-${++identifiers}`;
    const slider = html("input", { type: "range", min: Math.floor(least / step + 1e-9), max: Math.ceil(most / step - 1e-9),
        "aria-label": `${name}, slider` });
    const field = html("input", { id, type: "text", autocomplete: "off", spellcheck: "false",
        "aria-describedby": `${id}-problem` });
    const problem = html("output", { class: "problem", id: `${id}-problem`, for: id });
    let [current, text] = [NaN, ""];
    slider.addEventListener("input", () => {
        const at = Number((Number(slider.value) * step).toPrecision(12));
        set(at <= least ? ends[0] : at >= most ? ends[1] : parseValue(String(at), unit, length) ?? get());
    });
    const explain = (/** @type {string} */ message) => {
        setText(problem, message);
        field.setAttribute("aria-invalid", String(message !== ""));
    };
    const commit = () => {
        if (field.value === text) return explain("");
        const parsed = parseValue(field.value, unit, length);
        if (parsed === undefined) return explain(`expected a number${unit ? ` in ${unit}` : ""}, such as ${text}`);
        if (!isWithin(parsed, limits)) {
            const [from, to] = [limits?.[0], limits?.[1]].map((end) => (end == null ? "" : shown(end, unit, length)));
            return explain(`outside ${from} … ${to}`);
        }
        current = NaN;
        set(parsed);
    };
    field.addEventListener("change", commit);
    field.addEventListener("focus", () => field.select());
    field.addEventListener("keydown", ({ key }) => {
        if (key === "Escape") field.value = text;
        if (key === "Escape" || key === "Enter") commit();
    });
    const update = () => {
        const value = get();
        if (value === current) return;
        current = value;
        text = shown(value, unit, length);
        field.value = text;
        slider.value = String(Math.round((unit === "deg" ? (value * 180) / Math.PI : value) / step));
        slider.setAttribute("aria-valuetext", text);
        explain("");
    };
    return { id, slider, field, problem, update };
}

/** Returns the ends of a slider; without limits, they are as far away as zero. @param {Interval | null} limits @param {number} value @returns {[number, number]} */
function endsOf(limits, value) {
    const size = Math.abs(value) || 1;
    return [Math.min(limits?.[0] ?? value - size, value), Math.max(limits?.[1] ?? value + size, value)];
}

/** Returns the ends of the slider of a joint: its limits, or a turn. @param {Report} report @param {number} joint */
export function jointEnds({ variables }, joint) {
    const { kind, limits, home } = variables[joint];
    return endsOf(kind === "revolute" ? [limits[0] ?? -Math.PI, limits[1] ?? Math.PI] : limits, home);
}

/**
 * Creates the sliders of joints, inputs, and parameters; parameters that the study does not vary are folded.
 * @param {Panel} panel
 */
export function createControls(panel) {
    const { report, change } = panel;
    /** @type {{update: () => void}[]} */
    const inputs = [];
    const row = (/** @type {Value} */ value) => {
        const { id, slider, field, problem, update } = createInput(value, report.length);
        inputs.push({ update });
        return html("div", { class: "row", title: value.description ?? "" }, html("label", { for: id }, value.name), slider,
            field, problem);
    };
    const group = (/** @type {string} */ title, /** @type {Value[]} */ values) => (values.length === 0 ? "" : html("fieldset", {}, html("legend", {}, title), ...values.map(row)));

    const joints = report.variables.map(({ name, description, limits }, i) => ({
        name, description, limits, unit: variableUnit(report, i), ends: jointEnds(report, i), get: () => panel.state.q[i],
        set: (/** @type {number} */ value) => change((state) => {
            state.q[i] = value;
            panel.joint = i;
        }),
    }));
    const values = (/** @type {"s" | "u"} */ list, /** @type {(Report["inputs"][0] | Report["parameters"][0])[]} */ all) =>
        all.map(({ name, description, unit, nominal, range }, i) => ({
            name, description, unit, limits: list === "u" ? range : null, ends: endsOf(range, nominal), isVaried: range !== null,
            get: () => panel.state[list][i],
            set: (/** @type {number} */ value) => change((state) => { state[list][i] = value; }),
        }));
    const parameters = values("s", report.parameters);
    const others = parameters.filter(({ isVaried }) => !isVaried);
    const element = html("div", { class: "controls" }, group("Joints", joints), group("Inputs", values("u", report.inputs)),
        group("Parameters of the study", parameters.filter(({ isVaried }) => isVaried)),
        others.length === 0 ? "" : html("details", {}, html("summary", {}, `Parameters (${others.length})`), ...others.map(row)));
    return { element, update: () => inputs.forEach(({ update }) => update()) };
}
