// Sources: switch, factor, size of the error, share, and factor that meets the tolerance.

import { createInput } from "./controls.js";
import { button, html, setText } from "./dom.js";
import { decimals, fixed, percent, roundedDown } from "./number.js";
import { LARGEST_FACTOR } from "./state.js";
import { tighten } from "./search.js";

/** @import { Panel } from "./panel.js" */

/** Returns the smallest of 1, 2 and 5 times a power of ten that is at least `value`. @param {number} value */
function roundUp(value) {
    if (!(value > 0)) return 1;
    const power = 10 ** Math.floor(Math.log10(value));
    return ([1, 2, 5].find((mantissa) => mantissa * power >= value * (1 - 1e-9)) ?? 10) * power;
}

/**
 * Creates the list of sources. The largest are first; the order changes only while the list has no focus.
 * @param {Panel} panel
 */
export function createSources(panel) {
    const { report, change } = panel;
    const rows = report.sources.map((source, k) => {
        const { id, slider, field, problem, update } = createInput({ name: `factor of ${source.name}`, unit: "",
            ends: [0, LARGEST_FACTOR], limits: [0, LARGEST_FACTOR], get: () => panel.state.factors[k],
            set: (value) => change((state) => { state.factors[k] = value; }) }, "");
        field.setAttribute("aria-label", `factor of ${source.name}`);
        const check = html("input", { type: "checkbox" });
        let before = 1;
        check.addEventListener("change", () => change((state) => {
            if (!check.checked) before = state.factors[k];
            state.factors[k] = check.checked ? before || 1 : 0;
        }));
        // An uncertainty shares the factor of its source, or has none.
        const own = source.follows === k;
        check.disabled = !own;
        const kind = source.class === "random" ? `random (${source.distribution})` : source.class;
        const [value, share] = ["number", "share"].map((name) => html("span", { class: name }));
        const tightened = button("", () => change((state) => { state.factors[k] = Number(tightened.value); }),
            { class: "tighten", title: "Factor at which this source alone would use up the tolerance; click to set it" });
        const [bar, mark] = ["i", "b"].map((name) => html(/** @type {"i" | "b"} */ (name), { class: name === "i" ? source.class : "" }));
        const element = html("li", { title: `${source.name}: ${kind}, ${source.at}. ${source.description}` },
            html("label", { class: "name" }, check, html("span", {}, html("span", {}, source.name), html("small", {}, source.at))),
            value, share, html("span", { class: "factor" }, ...(own ? [slider, html("label", { for: id }, "×"), field, problem] : [])), tightened,
            html("span", { class: "bar", "aria-hidden": true }, bar, mark));
        return { element, check, bar, mark, value, share, tightened, update };
    });
    const list = html("ol", {}, ...rows.map(({ element }) => element));
    const total = ["number", "share", "factor", "tighten"].map((name) => html("span", { class: name }));
    const measurands = (/** @type {const} */ (["position", "orientation"])).map((measurand) => {
        const radio = html("input", { type: "radio", name: `abbe-measurand-${panel.index}`, checked: measurand === panel.measurand });
        radio.addEventListener("change", () => {
            panel.measurand = measurand;
            panel.refresh();
        });
        return html("label", {}, radio, measurand);
    });
    const [errorHead, scale] = [html("span", { class: "number" }), html("span", { class: "bar" })];
    const head = (/** @type {string} */ name, text = name) => html("span", { class: name }, text);
    const element = html("section", { class: "sources" },
        html("fieldset", { class: "measurand" }, html("legend", {}, "Sources of error here"), ...measurands),
        html("div", { class: "head", "aria-hidden": true }, head("name", "source"), errorHead, head("share"), head("factor"),
            head("tighten", "tighten to"), scale),
        list, html("div", { class: "total" }, head("name", "all together"), ...total));

    function update() {
        const { state, figures, reference, measurand, unit, tolerances } = panel;
        const errors = figures[measurand];
        const largest = roundUp(unit.factor * Math.max(...errors.norms, 0)) / unit.factor;
        const places = decimals(unit.factor * errors.radius, 4);
        const sum = errors.norms.reduce((all, one) => all + one, 0);
        const tolerance = tolerances[measurand];
        const factors = tolerance === null ? null : tighten(errors, tolerance);
        setText(scale, `bars: 0 … ${fixed(unit.factor * largest, decimals(unit.factor * largest, 1))} ${unit.symbol}`);
        setText(errorHead, unit.symbol);
        rows.forEach((row, k) => {
            const norm = errors.norms[k];
            row.update();
            row.check.checked = state.factors[k] !== 0;
            row.bar.style.width = `${(100 * norm) / largest}%`;
            row.mark.hidden = !reference;
            row.mark.style.left = `${Math.min(100, (100 * (reference?.[measurand].norms[k] ?? 0)) / largest)}%`;
            setText(row.value, `${report.sources[k].class === "random" && norm > 0 ? "± " : ""}${fixed(unit.factor * norm, places)}`);
            setText(row.share, sum > 0 ? percent(norm, sum) : "");
            const most = (factors?.alone[k] ?? NaN) * state.factors[k];
            row.tightened.value = Number.isFinite(most) ? roundedDown(most, decimals(most, 2)) : "";
            row.tightened.disabled = !(most <= LARGEST_FACTOR) || row.check.disabled;
            setText(row.tightened, row.tightened.value && `× ${row.tightened.value}`);
            row.element.classList.toggle("off", state.factors[k] === 0);
        });
        setText(total[0], fixed(unit.factor * errors.radius, places));
        const together = factors?.together ?? null;
        setText(total[3], together === null ? "" : `× ${roundedDown(together, decimals(together, 2))}`);
        element.classList.toggle("judged", tolerance !== null);
    }

    /** Sorts the sources by their errors. */
    function settle() {
        if (list.contains(document.activeElement)) return;
        const { norms } = panel.figures[panel.measurand];
        const order = rows.map((_, k) => k).sort((a, b) => norms[b] - norms[a]);
        if (order.some((k, i) => list.children[i] !== rows[k].element)) list.append(...order.map((k) => rows[k].element));
    }
    return { element, update, settle };
}
