// Rows of data: their errors as vectors in the picture, before or after, and a row to load.

import { html, onPick, path, paths, roundStep } from "./dom.js";
import { decimals, fixed } from "./number.js";
/** @import { Residuals } from "./state.js" @import { Tell } from "./dom.js" @import { Panel } from "./panel.js" */

/** Part of the points' diagonal that the 95 % quantile of the vectors takes. */
const LONG = 0.1;

/** Returns the length of an error; 0 without one. @param {number[] | null} error */
export const lengthOf = (error) => Math.hypot(...(error ?? []));

/** Returns the errors to choose from: both with the magnification of the first, then those after with their own. @param {Residuals} residuals */
export function residualViews({ before, after, rows }) {
    const along = [0, 1, 2].map((axis) => rows.map(({ point }) => point[axis]));
    const diagonal = Math.hypot(...along.map((values) => Math.max(...values) - Math.min(...values)));
    const [first, own] = [/** @type {const} */ ("before"), /** @type {const} */ ("after")].map((kind) => {
        const lengths = rows.map((row) => lengthOf(row[kind])).sort((a, b) => a - b);
        const ratio = (LONG * diagonal) / lengths[Math.floor((19 * (rows.length - 1)) / 20)];
        return { kind, name: (kind === "before" ? before : after) ?? "", scale: ratio > 0 && ratio < Infinity ? roundStep(ratio) : 1 };
    });
    if (before === null) return [own];
    return [first, { ...own, scale: first.scale }, ...(own.scale === first.scale ? [] : [own])];
}

/** Creates the list of rows, and their marks in the picture, which `draw` moves. @param {Panel} panel @param {Residuals} residuals */
export function createResiduals({ report, refresh, load }, residuals) {
    const { rows, before, after, count } = residuals;
    const [symbol, factor] = report.error_unit.length;
    const [views, marks] = [residualViews(residuals), paths("residual", "measured", "measured chosen")];
    /** @type {number[][]} */
    let places = [];
    const size = (/** @type {number[]} */ error, /** @type {number} */ most, /** @type {string} */ name) =>
        `${fixed(factor * lengthOf(error), decimals(factor * most, 4))} ${symbol} (${name})`;
    const texts = rows.map((row) => `line ${row.line}: ${row.before ? `${size(row.before, lengthOf(row.before), before ?? "")}, ` : ""}`
        + size(row.after, lengthOf(row.before ?? row.after), after));
    const [list, choice] = [["click a point, or choose a row", ...texts], views.map(({ name, scale }) => `${name}, errors × ${scale}`)]
        .map((all) => html("select", {}, ...all.map((text) => html("option", {}, text))));
    const element = html("section", { class: "residuals" }, html("label", {}, html("h2", {}, "Vectors"), choice),
        html("label", {}, html("h2", {}, `Rows${count > rows.length ? ` (${rows.length} of ${count})` : ""}`), list));
    choice.addEventListener("change", refresh);
    list.addEventListener("change", () => list.selectedIndex > 0 && load(list.selectedIndex - 1));
    /** @param {(point: number[]) => number[]} project */
    function draw(project) {
        const { kind, scale } = views[choice.selectedIndex];
        places = rows.map(({ point }) => project(point));
        const dots = places.map((place) => `${path([place])}h0`);
        const vectors = rows.map(({ point, [kind]: error }, i) => path([places[i], project(point.map((value, axis) => value + scale * (error?.[axis] ?? 0)))]));
        [vectors.join(""), dots.join(""), dots[list.selectedIndex - 1] ?? ""].forEach((d, i) => marks[i].setAttribute("d", d));
    }
    const pick = (/** @type {number} */ row) => {
        list.selectedIndex = row + 1;
        load(row);
    };
    return { element, keys: [], marks, draw, listen: (/** @type {HTMLElement} */ stage, /** @type {Tell} */ tell) =>
        onPick(stage, () => places, pick, (row) => texts[row], tell) };
}
