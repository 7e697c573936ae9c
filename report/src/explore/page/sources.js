// Sources: switch, factor, size of the error, share, and factor that meets the tolerance.

import { createInput } from "./controls.js";
import { button, html, roundStep, setText, spans } from "./dom.js";
import { decimals, digits, fixed, percent, roundedDown } from "./number.js";
import { allowed, factorAt } from "./search.js";
import { LARGEST_FACTOR, factorOf } from "./state.js";
/** @import { Report } from "./state.js" @import { Panel } from "./panel.js" */

/** Formats a factor, rounded down. @param {number | null | undefined} factor */
export const times = (factor) => (factor == null || !Number.isFinite(factor) ? "" : `× ${roundedDown(factor, decimals(factor, 2))}`);

/** Formats an error; a dash where there is none, as of Euler angles at a singularity. @param {number} value @param {number} places */
export const errorOf = (value, places) => (Number.isFinite(value) ? fixed(value, places) : "–");

/**
 * Formats the size at which a source uses up the tolerance, such as `0.15 mrad`, if it has one: on one frame, in one unit.
 * @param {Report} report @param {number[]} values of all effects @param {number} k source @param {number} factor
 */
function sizeText({ effects, error_unit }, values, k, factor) {
    const own = effects.flatMap(([source, frame, component], i) =>
        (source === k ? [{ place: 2 * frame + Number(component > 2), value: values[i] }] : []));
    const [symbol, unit] = error_unit[own[0]?.place % 2 ? "angle" : "length"];
    const size = factor * unit * Math.hypot(...own.map(({ value }) => value));
    if (!(size > 0 && size < Infinity) || own.some(({ place }) => place !== own[0].place)) return "";
    return `${roundedDown(size, decimals(size, 2))} ${symbol}`;
}

/** Creates the list of sources, the largest first; the order does not change while the list has the focus. @param {Panel} panel */
export function createSources(panel) {
    const { report, change } = panel;
    const rows = report.sources.map((source, k) => {
        const { slider, field, problem, update } = createInput({ name: `factor of ${source.name}`, description: "", unit: "",
            ends: [0, LARGEST_FACTOR], limits: [0, LARGEST_FACTOR], get: () => factorOf(report, panel.state, k),
            set: (value) => change(({ factors }) => { factors[k] = value; }) }, "");
        // An uncertainty shares the factor of its source, or has none.
        const isOwn = source.follows === k;
        const check = html("input", { type: "checkbox", disabled: !isOwn });
        check.addEventListener("change", () => change(({ factors }) => { factors[k] = Number(check.checked); }));
        const allowance = button("", () => change(({ factors }) => { factors[k] = Number(allowance.value); }),
            { class: "allowed", title: "Largest factor, and size, with which the total meets the tolerance while the others stay; click to set it" });
        const [value, share, name, factor, most] = spans("number", "share", "", "factor", "");
        const size = html("small");
        allowance.append(most, size);
        name.append(html("span", {}, source.name), html("small", {}, source.at));
        if (isOwn) factor.append(slider, "×", field, problem);
        const [bar, mark] = [html("i", { class: source.class }), html("b")];
        const kind = source.distribution ? `${source.class} (${source.distribution})` : source.class;
        const element = html("li", { title: `${source.name}: ${kind}, ${source.at}. ${source.description}` },
            html("label", { class: "name" }, check, name), value, share, factor, allowance,
            html("span", { class: "bar", "aria-hidden": true }, bar, mark));
        return { element, check, bar, mark, value, share, allowance, most, size, update };
    });
    const list = html("ol", {}, ...rows.map(({ element }) => element));
    const measurands = (/** @type {const} */ (["position", "orientation"])).map((measurand) => {
        const radio = html("input", { type: "radio", name: `abbe-measurand-${panel.index}`, checked: measurand === panel.measurand });
        radio.addEventListener("change", () => change(() => { panel.measurand = measurand; }));
        return { measurand, radio, element: html("label", {}, radio, measurand) };
    });
    const heads = spans("name", "number", "share", "factor", "allowed", "bar");
    const sums = spans("name", "number", "share", "factor", "allowed");
    ["source", "", "share", "factor", "allowed"].forEach((text, i) => setText(heads[i], text));
    setText(sums[0], "all together");
    const element = html("section", { class: "sources" },
        html("fieldset", { class: "measurand" }, html("legend", {}, "Sources of error here"), ...measurands.map(({ element }) => element)),
        html("div", { class: "head", "aria-hidden": true }, ...heads), list, html("div", { class: "total" }, ...sums));

    function update() {
        const { state, figures, reference, measurand, unit: { factor, symbol }, tolerances } = panel;
        const [errors, displacements, first] = [figures[measurand], figures.displacements, measurand === "position" ? 0 : 3];
        const largest = factor * Math.max(...errors.norms, 0);
        const end = [1, 2, 2.5].map((ratio) => ratio * roundStep(largest)).find((round) => largest <= round * (1 + 1e-9)) ?? 1;
        const places = decimals(factor * errors.radius, 4);
        const tolerance = tolerances[measurand];
        const effects = panel.machine.effects(state);
        measurands.forEach((one) => { one.radio.checked = one.measurand === measurand; });
        rows.forEach((row, k) => {
            const [norm, isRandom] = [errors.norms[k], report.sources[k].class !== "repeatable"];
            row.update();
            const current = factorOf(report, state, k);
            row.check.checked = current !== 0;
            row.element.classList.toggle("off", current === 0);
            row.bar.style.width = `${(100 * factor * norm) / end}%`;
            row.mark.hidden = !reference;
            row.mark.style.left = `${Math.min(100, (100 * factor * (reference?.[measurand].norms[k] ?? 0)) / end)}%`;
            setText(row.value, `${isRandom && norm > 0 ? "± " : ""}${errorOf(factor * norm, places)}`);
            setText(row.share, Number.isFinite(errors.radius) ? percent(errors.shares[k], 1) : "");
            const [least, most] = (tolerance === null ? null : allowed(panel.machine, errors, k, displacements[k].slice(first, first + 3), tolerance)) ?? [0, null];
            const text = most === null ? (tolerance !== null && norm > 0 ? "not alone" : "") : times(most * current);
            // Less than the lower end is too little against the others.
            setText(row.most, least > 0 ? `${digits(least * current, 2)} … ${text.slice(2)}` : text);
            setText(row.size, most === null ? "" : sizeText(report, effects, k, most));
            row.allowance.value = most === null ? "" : text.slice(2);
            row.allowance.ariaLabel = `${text}, allowed factor of ${report.sources[k].name}`;
            row.allowance.disabled = row.check.disabled || !row.allowance.value || Number(row.allowance.value) > LARGEST_FACTOR;
        });
        setText(heads[1], symbol);
        setText(heads[5], `bars: 0 … ${fixed(end, decimals(end, 1))} ${symbol}`);
        setText(sums[1], errorOf(factor * errors.radius, places));
        setText(sums[4], tolerance === null ? "" : times(factorAt(errors.radius, tolerance)));
        element.classList.toggle("judged", tolerance !== null);
    }
    function settle() {
        if (list.contains(document.activeElement)) return;
        const { norms, shares } = panel.figures[panel.measurand];
        const order = rows.map((_, k) => k).sort((a, b) => Math.abs(shares[b]) - Math.abs(shares[a]) || norms[b] - norms[a]);
        if (order.some((k, i) => list.children[i] !== rows[k].element)) list.append(...order.map((k) => rows[k].element));
    }
    return { element, update, settle };
}
