// Charts: errors along one joint with the configurations of the study, and these errors in space.

import { shown } from "./controls.js";
import { html, onResize, path, roundStep, setText, svg } from "./dom.js";
import { decimals, fixed } from "./number.js";
import { sweep } from "./search.js";
import { variableUnit } from "./state.js";

/** @import { Panel } from "./panel.js" */

const [LEFT, RIGHT, TOP, BOTTOM] = [52, 132, 12, 34];
/** Number of points of a curve, and of sources with a curve. */
const [POINTS, CURVES] = [81, 4];
/** Distance in pixels at which a point is picked. */
const NEAR = 9;

/** Returns round values from `least` to `most`. @param {number} least @param {number} most @param {number} count */
function ticks(least, most, count) {
    const step = roundStep((most - least) / count) || 1;
    const first = Math.ceil(least / step - 1e-9);
    return Array.from({ length: Math.floor(most / step + 1e-9) - first + 1 }, (_, i) => Number(((first + i) * step).toPrecision(12)));
}

/**
 * Creates the chart of errors along one joint. A click sets the joint, or loads the configuration of a point.
 * @param {Panel} panel
 */
export function createSweep(panel) {
    const { report, change } = panel;
    const chosen = html("select", { "aria-label": "Joint" }, ...report.variables.map(({ name }, i) => html("option", { value: i }, name)));
    const layer = (/** @type {string} */ name) => svg("path", { class: name });
    const [grid, tolerance, points, random, repeatable, total, here] =
        ["grid", "tolerance", "points", "random", "repeatable", "total", "here"].map(layer);
    const curves = Array.from({ length: CURVES }, () => layer("curve"));
    const [texts, names] = [svg("g", { class: "ticks" }), svg("g", { class: "names" })];
    const dot = svg("circle", { r: 4.5, class: "tip" });
    const drawing = svg("svg", { "aria-hidden": true }, grid, tolerance, points, ...curves, random, repeatable, total, here, dot, texts, names);
    const stage = html("div", { class: "chart" }, drawing);
    const summary = html("figcaption");
    const element = html("figure", { class: "sweep" }, html("h3", {}, "Error along joint ", chosen), stage, summary);
    let [width, height] = [0, 260];
    let ends = [0, 1];
    let top = 1;
    const across = (/** @type {number} */ value) => LEFT + ((width - LEFT - RIGHT) * (value - ends[0])) / (ends[1] - ends[0] || 1);
    const above = (/** @type {number} */ error) => height - BOTTOM - ((height - TOP - BOTTOM) * error) / top;

    function update() {
        if (report.variables.length === 0 || width === 0) return;
        const { state, figures, measurand, unit, machine, joint, cloud, tolerances } = panel;
        chosen.value = String(joint);
        const curve = sweep(machine, report, state, joint, POINTS, measurand);
        ends = [curve.values[0], curve.values[POINTS - 1]];
        const limit = tolerances[measurand];
        const largest = Math.max(...curve.total, ...(cloud?.[measurand].radii ?? []), 0);
        top = 1.06 * (Math.max(largest, limit !== null && limit < 4 * largest ? limit : 0) || 1);
        const line = (/** @type {number[]} */ values) => path(values.map((value, i) => [across(curve.values[i]), above(value)]));
        total.setAttribute("d", line(curve.total));
        const isMixed = figures[measurand].repeatableRadius > 0 && figures[measurand].randomRadius > 0;
        repeatable.setAttribute("d", isMixed ? line(curve.repeatable) : "");
        random.setAttribute("d", isMixed ? line(curve.random) : "");
        const peak = curve.sources.map((values) => Math.max(...values));
        const largestSources = peak.map((_, k) => k).filter((k) => peak[k] > 0).sort((a, b) => peak[b] - peak[a]).slice(0, CURVES);
        curves.forEach((one, i) => one.setAttribute("d", i < largestSources.length ? line(curve.sources[largestSources[i]]) : ""));
        tolerance.setAttribute("d", limit === null ? "" : `M${LEFT} ${above(limit).toFixed(1)}H${width - RIGHT}`);
        const value = state.q[joint];
        here.setAttribute("d", `M${across(value).toFixed(1)} ${TOP}V${height - BOTTOM}`);
        dot.setAttribute("cx", across(value).toFixed(1));
        dot.setAttribute("cy", above(figures[measurand].radius).toFixed(1));
        points.setAttribute("d", (cloud?.[measurand].radii ?? []).map((error, i) =>
            `M${across(report.configurations.q[i][joint]).toFixed(1)} ${above(error).toFixed(1)}h0`).join(""));
        drawTicks(unit, variableUnit(report, joint));
        const last = (/** @type {number[]} */ values) => above(values[POINTS - 1]);
        drawNames([["total", last(curve.total), "total"],
            ...(isMixed ? [["repeatable", last(curve.repeatable), "repeatable"], ["random", last(curve.random), "random"]] : []),
            ...(limit === null ? [] : [["tolerance", above(limit), "tolerance"]]),
            ...largestSources.map((k) => [report.sources[k].name, last(curve.sources[k]), "curve"]),
        ].map(([name, y, kind]) => ({ name: String(name), y: Number(y), kind: String(kind) })));
        const worst = curve.total.indexOf(Math.max(...curve.total));
        const places = decimals(unit.factor * curve.total[worst], 4);
        setText(summary, `Largest along ${report.variables[joint].name}: ${fixed(unit.factor * curve.total[worst], places)} ${unit.symbol} at `
            + `${shown(curve.values[worst], variableUnit(report, joint), report.length)}.`
            + (cloud ? ` Dots: total at the ${cloud.position.radii.length} configurations of the study; click one to load it.` : ""));
    }

    /** @param {{factor: number, symbol: string}} unit of the errors @param {string} along unit of the joint */
    function drawTicks(unit, along) {
        const factor = along === "deg" ? 180 / Math.PI : 1;
        const lines = [];
        const children = [svg("text", { x: LEFT, y: height - 4 }, `${report.variables[panel.joint].name} (${along})`)];
        for (const tick of ticks(factor * ends[0], factor * ends[1], Math.max(2, (width - LEFT - RIGHT) / 70))) {
            const x = across(tick / factor);
            lines.push(`M${x.toFixed(1)} ${TOP}V${height - BOTTOM}`);
            children.push(svg("text", { x, y: height - BOTTOM + 15, "text-anchor": "middle" }, String(tick)));
        }
        const most = unit.factor * top;
        for (const tick of ticks(0, most, 5)) {
            const y = above(tick / unit.factor);
            lines.push(`M${LEFT} ${y.toFixed(1)}H${width - RIGHT}`);
            const label = tick === 0 ? "0" : fixed(tick, decimals(roundStep(most / 5), 1));
            children.push(svg("text", { x: LEFT - 6, y: y + 4, "text-anchor": "end" }, label));
        }
        children.push(svg("text", { x: LEFT, y: TOP - 2 }, unit.symbol));
        grid.setAttribute("d", lines.join(""));
        texts.replaceChildren(...children);
    }

    /** Writes the names of the curves at their right ends, without overlap. @param {{name: string, y: number, kind: string}[]} all */
    function drawNames(all) {
        let free = height - BOTTOM + 4;
        const sorted = all.sort((a, b) => b.y - a.y);
        const longest = Math.floor((RIGHT - 8) / 6.3);
        names.replaceChildren(...sorted.map(({ name, y, kind }) => {
            const at = Math.min(y + 4, free);
            free = at - 13;
            return svg("text", { x: width - RIGHT + 6, y: at, class: kind }, name.length > longest ? `${name.slice(0, longest - 1)}…` : name);
        }));
    }

    /** @param {PointerEvent} event */
    function pick(event) {
        const { cloud, measurand, joint } = panel;
        const box = stage.getBoundingClientRect();
        const [x, y] = [event.clientX - box.left, event.clientY - box.top];
        let [nearest, distance] = [-1, event.type === "pointerdown" ? NEAR : 0];
        (cloud?.[measurand].radii ?? []).forEach((error, i) => {
            const away = Math.hypot(across(report.configurations.q[i][joint]) - x, above(error) - y);
            if (away < distance) [nearest, distance] = [i, away];
        });
        if (nearest >= 0) return panel.load(nearest);
        const value = ends[0] + ((ends[1] - ends[0]) * (x - LEFT)) / (width - LEFT - RIGHT);
        stage.setPointerCapture(event.pointerId);
        change((state) => { state.q[joint] = Math.min(ends[1], Math.max(ends[0], value)); });
    }
    stage.addEventListener("pointerdown", pick);
    stage.addEventListener("pointermove", (event) => { if (stage.hasPointerCapture(event.pointerId)) pick(event); });
    chosen.addEventListener("change", () => {
        panel.joint = Number(chosen.value);
        panel.refresh();
    });
    onResize(stage, (newWidth) => {
        width = newWidth;
        drawing.setAttribute("viewBox", `0 0 ${width} ${height}`);
        panel.refresh();
    });
    return { element, update };
}
