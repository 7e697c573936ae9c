// Chart of the errors along one joint, with the configurations of the study.

import { shown } from "./controls.js";
import { createNote, html, moveTo, nearest, onResize, path, paths, roundStep, setText, svg } from "./dom.js";
import { decimals, fixed } from "./number.js";
import { replaced, sweep } from "./search.js";
import { errorOf } from "./sources.js";
import { variableUnit } from "./state.js";
/** @import { Panel } from "./panel.js" */

const [LEFT, RIGHT, TOP, BOTTOM] = [48, 136, 20, 36];
/** Number of points of a curve, and of sources with a curve. */
const [POINTS, CURVES] = [61, 4];

/** Returns the largest of the numbers that are finite. @param {number[]} values */
const greatest = (values) => values.reduce((most, value) => (value > most ? value : most), -Infinity);

/** Returns about `count` round values from `least` to `most`. @param {number} least @param {number} most @param {number} count */
function ticks(least, most, count) {
    const step = roundStep((most - least) / count);
    const first = Math.ceil(least / step - 1e-9);
    return Array.from({ length: Math.floor(most / step + 1e-9) - first + 1 }, (_, i) => Number(((first + i) * step).toPrecision(12)));
}

/** Creates the chart: a click or a drag sets the joint, a click on a dot loads its configuration. @param {Panel} panel */
export function createSweep(panel) {
    const { report, machine } = panel;
    const chosen = html("select", { "aria-label": "Joint" }, ...report.variables.map(({ name }, i) => html("option", { value: i }, name)));
    const [grid, tolerance, dots, here] = paths("grid", "tolerance", "points", "here");
    const kinds = ["total", "repeatable", "random", ...Array.from({ length: CURVES }, () => "curve")];
    const lines = paths(...kinds);
    const [numbers, names, tip] = [svg("g"), svg("g"), svg("circle", { class: "tip", r: 4 })];
    const note = createNote();
    const drawing = svg("svg", { "aria-hidden": true }, grid, tolerance, dots, ...[...lines].reverse(), here, tip, numbers, names, note.element);
    const stage = html("div", { class: "chart" }, drawing);
    const summary = html("figcaption");
    const element = html("figure", { class: "sweep" }, html("h2", {}, "Error along joint ", chosen), stage, summary);
    let [width, height, from, to, top] = [0, 0, 0, 1, 1];
    const across = (/** @type {number} */ value) => LEFT + ((width - LEFT - RIGHT) * (value - from)) / (to - from || 1);
    const above = (/** @type {number} */ error) => height - BOTTOM - ((height - TOP - BOTTOM) * error) / top;
    const radii = () => panel.cloud?.[panel.measurand].radii ?? [];

    function update() {
        if (width === 0) return;
        const { state, figures, measurand, unit, joint, tolerances } = panel;
        const along = variableUnit(report, joint);
        const { values, total, repeatable, random, sources } = sweep(machine, report, state, joint, POINTS, measurand);
        [from, to] = [values[0], values[POINTS - 1]];
        const limit = tolerances[measurand];
        const most = greatest([...total, ...radii(), 0]);
        top = 1.05 * (Math.max(most, limit !== null && limit < 4 * most ? limit : 0) || 1);
        const peaks = sources.map((curve, k) => ({ name: report.sources[k].name, curve, peak: greatest(curve) }));
        const isMixed = greatest(repeatable) > 0 && greatest(random) > 0;
        const all = [{ name: "total", curve: total }, { name: "repeatable", curve: isMixed ? repeatable : [] },
            { name: "random", curve: isMixed ? random : [] },
            ...peaks.filter(({ peak }) => peak > 0).sort((a, b) => b.peak - a.peak).slice(0, CURVES)];
        lines.forEach((line, i) => line.setAttribute("d", path((all[i]?.curve ?? []).map((error, k) =>
            [across(values[k]), above(error)]))));
        const ends = all.map(({ name, curve }, i) => ({ name, kind: kinds[i], y: above(curve.filter(Number.isFinite).at(-1) ?? NaN) }));
        writeNames([...ends, { name: "tolerance", kind: "", y: above(limit ?? NaN) }].filter(({ y }) => y > 0));
        tolerance.setAttribute("d", limit === null ? "" : path([[LEFT, above(limit)], [width - RIGHT, above(limit)]]));
        here.setAttribute("d", path([TOP, height - BOTTOM].map((y) => [across(state.q[joint]), y])));
        moveTo(tip, [across(state.q[joint]), above(figures[measurand].radius || 0)]);
        dots.setAttribute("d", radii().map((error, i) => `${path([[across(report.configurations.q[i][joint]), above(error || 0)]])}h0`).join(""));
        writeNumbers(unit, along);
        chosen.value = String(joint);
        const worst = total.indexOf(greatest(total));
        const largest = unit.factor * (total[worst] ?? 0);
        const isConstant = total.every(Number.isFinite) && Math.min(...total) >= (total[worst] ?? 0) * (1 - 1e-9);
        setText(summary, `${isConstant ? "Constant" : "Largest"} along ${report.variables[joint].name}: ${fixed(largest, decimals(largest, 4))} `
            + `${unit.symbol}${isConstant ? "" : ` at ${shown(values[worst] ?? 0, along, report.length)}`}. Dots: ${radii().length} configurations of the ${report.residuals ? "rows" : "study"}; click one to load it.`);
    }
    /** Draws the grid with its numbers. @param {Panel["unit"]} unit of the errors @param {string} along unit of the joint */
    function writeNumbers({ factor, symbol }, along) {
        const turn = along === "deg" ? 180 / Math.PI : 1;
        const columns = ticks(turn * from, turn * to, (width - LEFT - RIGHT) / 100).map((tick) => ({ text: String(tick), x: across(tick / turn) }));
        const step = roundStep((factor * top) / 5);
        const rows = ticks(0, factor * top, 5).map((tick) => ({ text: fixed(tick, decimals(step, 1)), y: above(tick / factor) }));
        grid.setAttribute("d", [...columns.map(({ x }) => path([[x, TOP], [x, height - BOTTOM]])),
            ...rows.map(({ y }) => path([[LEFT, y], [width - RIGHT, y]]))].join(""));
        numbers.replaceChildren(svg("text", { x: LEFT, y: 12 }, symbol),
            svg("text", { x: LEFT, y: height - 3 }, `${report.variables[panel.joint].name} in ${along}`),
            ...columns.map(({ text, x }) => svg("text", { x, y: height - BOTTOM + 15, "text-anchor": "middle" }, text)),
            ...rows.map(({ text, y }) => svg("text", { x: LEFT - 6, y: y + 4, "text-anchor": "end" }, text)));
    }
    /** Writes the names of the curves at their right ends, one above the other. @param {{name: string, kind: string, y: number}[]} all */
    function writeNames(all) {
        let free = height - BOTTOM + 4;
        names.replaceChildren(...all.sort((a, b) => b.y - a.y).map(({ name, kind, y }) => {
            const at = Math.min(y + 4, free);
            free = at - 13;
            return svg("text", { x: width - RIGHT + 6, y: at, class: kind }, name);
        }));
    }
    const places = () => radii().map((error, i) => [across(report.configurations.q[i][panel.joint]), above(error)]);
    /** Returns the value of the joint at a pointer. @param {MouseEvent} event */
    const valueAt = ({ clientX }) => {
        const x = clientX - stage.getBoundingClientRect().left;
        return Math.min(to, Math.max(from, from + ((to - from) * (x - LEFT)) / (width - LEFT - RIGHT)));
    };
    /** @param {PointerEvent} event */
    function pick(event) {
        const near = event.type === "pointerdown" ? nearest(stage, places(), event) : -1;
        if (near >= 0) return panel.load(near);
        stage.setPointerCapture(event.pointerId);
        panel.change(({ q }) => { q[panel.joint] = valueAt(event); });
    }
    /** Tells the error at a dot, or of the curve. @param {PointerEvent} event */
    function hover(event) {
        const { unit: { factor, symbol }, joint, state, measurand } = panel;
        const near = nearest(stage, places(), event);
        const value = valueAt(event);
        const error = factor * (near >= 0 ? radii()[near] : machine.errors({ ...state, q: replaced(state.q, joint, value) })[measurand].radius);
        note.tell(places()[near] ?? [across(value), above(error / factor)], `${errorOf(error, decimals(error, 4))} ${symbol} at `
            + (near >= 0 ? `configuration ${near + 1}` : shown(Number(value.toPrecision(4)), variableUnit(report, joint), report.length)));
    }
    stage.addEventListener("pointerdown", pick);
    stage.addEventListener("pointermove", (event) => (stage.hasPointerCapture(event.pointerId) ? pick : hover)(event));
    stage.addEventListener("pointerleave", () => note.tell([NaN, NaN], ""));
    chosen.addEventListener("change", () => panel.change(() => { panel.joint = Number(chosen.value); }));
    onResize(drawing, (size) => panel.change(() => { [width, height] = size; }));
    return { element, update };
}
