// Tool points of the study's configurations in the picture, coloured by their error, and a configuration to load.

import { html, onPick, path, paths, setText } from "./dom.js";
import { decimals } from "./number.js";
import { stateAt } from "./search.js";
import { errorOf } from "./sources.js";
/** @import { Tell } from "./dom.js" @import { Panel } from "./panel.js" */

/** Creates the points, which `draw` moves, and their key. @param {Panel} panel */
export function createWorkspace(panel) {
    const { report, generated, load } = panel;
    const marks = paths("within", "beyond");
    const keys = ["within", "beyond"].map((name) => html("span", { class: `key ${name}` }, html("i"), html("span")));
    let [points, places, parameters] = [/** @type {number[][]} */ ([]), /** @type {number[][]} */ ([]), ""];
    /** @param {(point: number[]) => number[]} project */
    function draw(project) {
        const { state, cloud, measurand, tolerances } = panel;
        if (String(state.s) !== parameters || points.length === 0) {
            points = report.configurations.q.map((_, i) => {
                const { q, s } = stateAt(report, state, i);
                return Array.from(generated.pose(q, s)).slice(9);
            });
            parameters = String(state.s);
        }
        places = points.map(project);
        // A study of the compensated machine judges what this page does not compute.
        const limit = report.study.judged === "as-built" ? tolerances[measurand] : null;
        const radii = cloud?.[measurand].radii ?? [];
        const beyond = radii.map((radius) => limit !== null && !(radius <= limit));
        [false, true].forEach((kind, k) => {
            const dots = places.map((place, i) => (kind === (beyond[i] ?? false) ? path([place]) : "")).filter(Boolean);
            marks[k].setAttribute("d", dots.map((dot) => `${dot}h0`).join(""));
            const count = beyond.filter((one) => one === kind).length;
            setText(keys[k].children[1], limit === null ? "tool points of the study" : `${count} of ${radii.length} ${kind ? "beyond" : "within"}`);
            keys[k].hidden = kind ? limit === null : radii.length === 0;
        });
    }
    const text = (/** @type {number} */ i) => {
        const { cloud, measurand, unit: { factor, symbol } } = panel;
        const error = factor * (cloud?.[measurand].radii[i] ?? NaN);
        return `${errorOf(error, decimals(error, 4))} ${symbol} at configuration ${i + 1}`;
    };
    return { keys, marks, draw, listen: (/** @type {HTMLElement} */ stage, /** @type {Tell} */ tell) => onPick(stage, () => places, load, text, tell) };
}
