// Pinned cases: states that are kept beside the one that is shown, with their errors and what differs.

import { shown } from "./controls.js";
import { button, html } from "./dom.js";
import { decimals } from "./number.js";
import { errorOf } from "./sources.js";
import { copyState, variableUnit } from "./state.js";
/** @import { Panel } from "./panel.js" @import { State } from "./state.js" @import { Evaluation } from "./machine.js" */

/** Largest number of pinned cases. */
const MOST_PINS = 6;

/** Creates the section of pinned cases. @param {Panel} panel */
export function createPins(panel) {
    const { report, machine, state } = panel;
    const { variables, parameters, inputs, sources, error_unit, length } = report;
    /** @type {{name: string, state: State, figures: Evaluation}[]} */
    const pins = [];
    let last = 0;
    const table = html("table", { hidden: true });
    const pin = button("Pin this case", () => {
        pins.push({ name: `case ${(last += 1)}`, state: copyState(state), figures: machine.evaluate(state) });
        settle();
    });
    const element = html("section", { class: "pins" }, html("h2", {}, "Cases side by side"), pin, table);
    /** Returns the name of each number of a state, and its text. @param {State} one @returns {[string, string][]} */
    const values = ({ q, s, u, factors }) => [
        ...variables.map(({ name }, i) => /** @type {[string, string]} */ ([name, shown(q[i], variableUnit(report, i), length)])),
        ...[...parameters, ...inputs].map(({ name, unit }, i) => /** @type {[string, string]} */ ([name, shown([...s, ...u][i], unit, length)])),
        ...sources.map(({ name }, k) => /** @type {[string, string]} */ ([`factor of ${name}`, `× ${factors[k]}`])),
    ];
    /** Returns a row of errors, with their differences from those now. @param {string} title @param {number[]} all the first one now @param {"length" | "angle"} kind */
    function errorRow(title, all, kind) {
        const [symbol, factor] = error_unit[kind];
        const places = decimals(factor * Math.max(...all), 4);
        const cells = all.map((value, i) => {
            const change = factor * (value - all[0]);
            const difference = i === 0 || change === 0 ? "" : ` (${change < 0 ? "−" : "+"}${errorOf(Math.abs(change), places)})`;
            return html("td", {}, errorOf(factor * value, places), html("small", {}, difference));
        });
        return html("tr", {}, html("th", { scope: "row" }, `${title} (${symbol})`), ...cells);
    }
    function settle() {
        pin.disabled = pins.length === MOST_PINS;
        table.hidden = pins.length === 0;
        const cases = [{ name: "now", state, figures: machine.evaluate(state) }, ...pins];
        const headings = cases.map(({ name, state: kept }, i) => html("th", { scope: "col" }, ...(i === 0 ? [name]
            : [button(name, () => panel.go(kept), { "aria-label": `Load ${name}` }),
                button("×", () => { pins.splice(i - 1, 1); settle(); }, { "aria-label": `×: remove ${name}` })])));
        const of = (/** @type {(figures: Evaluation) => number} */ value) => cases.map(({ figures }) => value(figures));
        const { measurand } = panel;
        const own = measurand === "position" ? "length" : "angle";
        const errors = [errorRow("position error", of(({ position }) => position.radius), "length"),
            errorRow("orientation error", of(({ orientation }) => orientation.radius), "angle"),
            ...sources.flatMap(({ name }, k) => (of((figures) => figures[measurand].norms[k]).every((norm) => norm === 0) ? []
                : [errorRow(name, of((figures) => figures[measurand].norms[k]), own)]))];
        const texts = cases.map((one) => values(one.state));
        const differing = texts[0].flatMap(([name, text], i) => (texts.every((all) => all[i][1] === text) ? []
            : [html("tr", {}, html("th", { scope: "row" }, name), ...texts.map((all) => html("td", {}, all[i][1])))]));
        table.replaceChildren(html("thead", {}, html("tr", {}, html("td"), ...headings)), html("tbody", {}, ...errors, ...differing));
    }
    return { element, update: () => {}, settle };
}
