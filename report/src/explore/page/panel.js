// A panel: one machine with its state, whose parts are drawn again after each change, once per frame.

import { createSweep } from "./charts.js";
import { commands } from "./command.js";
import { createControls } from "./controls.js";
import { button, html, setText } from "./dom.js";
import { createMachine } from "./machine.js";
import { cloud, stateAt } from "./search.js";
import { createSources } from "./sources.js";
import { copyState, decodeState, encodeState, initialState } from "./state.js";
import { createJacobian, createPoses } from "./tables.js";
import { createVerdict } from "./verdict.js";
import { createView } from "./view.js";

/**
 * @import { Report, State } from "./state.js"
 * @import { Evaluation, Generated, Machine } from "./machine.js"
 */

/**
 * What the parts of a panel read and call.
 * @typedef {object} Panel
 * @property {Report} report
 * @property {Generated} generated
 * @property {Machine} machine
 * @property {number} index of the machine in the page
 * @property {State} state
 * @property {Evaluation} figures errors at the state
 * @property {Evaluation | null} reference errors at these joints before parameters, inputs or factors were changed
 * @property {ReturnType<typeof cloud> | null} cloud errors at the configurations of the study
 * @property {"position" | "orientation"} measurand
 * @property {{symbol: string, factor: number}} unit of the errors of the measurand
 * @property {Record<"position" | "orientation", number | null>} tolerances
 * @property {number} joint that was moved last
 * @property {(edit: (state: State) => void) => void} change
 * @property {(state: State) => void} go replaces the state
 * @property {(configuration: number) => void} load replaces the state by a configuration of the study
 * @property {() => void} refresh
 */

/** @typedef {{element: Element, update: () => void, settle?: () => void}} Part */

/** Milliseconds without a change after which slower work is done. */
const SETTLED = 250;

/** @type {{panel: Panel, prefix: string}[]} */
const panels = [];

/** Puts the states of all panels into the address. */
function writeAddress() {
    const parts = panels.map(({ panel: { report, state }, prefix }) => encodeState(report, state, prefix)).filter((part) => part !== "");
    try {
        history.replaceState(null, "", `#${parts.join("&")}`);
    } catch {
        // A sandboxed frame has no address of its own.
    }
}

/** Copies a text, or selects it where the clipboard is not available. @param {string} text @param {HTMLElement} target @param {HTMLElement} status */
async function copy(text, target, status) {
    try {
        await navigator.clipboard.writeText(text);
        setText(status, "copied");
    } catch {
        getSelection()?.selectAllChildren(target);
        setText(status, "selected: press Ctrl+C");
    }
    setTimeout(() => setText(status, ""), 3000);
}

/** Creates the commands and the link that give the same figures. @param {Panel} panel @param {string} prefix */
function createSame(panel, prefix) {
    const lines = ["analyze", "jacobian"].map(() => html("code"));
    const status = html("span", { role: "status" });
    const link = html("code", { class: "link" });
    const element = html("section", { class: "same" }, html("h3", {}, "The same figures by the command"),
        ...lines.map((line, i) => html("div", { class: "copied" }, line,
            button("Copy command", () => void copy(line.textContent ?? "", line, status), { "aria-label": `Copy command ${i + 1}` }))),
        html("div", { class: "copied" }, link, button("Copy link", () => void copy(link.textContent ?? "", link, status))), status);
    const settle = () => {
        commands(panel.report, panel.state).forEach((text, i) => setText(lines[i], text));
        setText(link, `${location.href.split("#")[0]}#${encodeState(panel.report, panel.state, prefix)}`);
    };
    return { element, update: () => {}, settle };
}

/**
 * Builds a panel in an empty section.
 * @param {HTMLElement} section @param {Generated} generated @param {Report} report @param {number} index of the machine in the page
 */
export function mount(section, generated, report, index) {
    const prefix = index === 0 ? "" : `${index + 1}.`;
    const machine = createMachine(generated, report);
    const initial = initialState(report);
    const { tolerance: position, orientation_tolerance: orientation } = report.study;
    const state = decodeState(report, location.hash, prefix);
    let baseline = initial;
    /** @type {State | null} */
    let previous = null;
    let [frame, timer] = [0, 0];

    /** @type {Panel} */
    const panel = {
        report, generated, machine, index, state, figures: machine.evaluate(state), reference: null, cloud: null,
        measurand: "position", unit: { symbol: "", factor: 1 }, tolerances: { position, orientation }, joint: 0,
        change(edit) {
            edit(panel.state);
            panel.refresh();
        },
        go(next) {
            previous = copyState(panel.state);
            Object.assign(panel.state, copyState(next));
            panel.refresh();
        },
        load(configuration) {
            const next = stateAt(report, panel.state, configuration);
            baseline = { ...next, factors: initial.factors };
            panel.go(next);
        },
        refresh() {
            frame ||= requestAnimationFrame(() => draw(false));
            clearTimeout(timer);
            timer = setTimeout(settle, SETTLED);
        },
    };
    panels.push({ panel, prefix });

    const [verdict, sources] = [createVerdict(panel), createSources(panel)];
    const controls = createControls(panel);
    const [view, sweep] = [createView(panel), createSweep(panel)];
    const [poses, jacobian, same] = [createPoses(panel), createJacobian(panel), createSame(panel, prefix)];
    /** @type {Part[]} */
    const parts = [verdict, controls, view, sources, sweep, poses, jacobian, same];
    const reset = button("Reset", () => {
        baseline = initial;
        panel.go(initial);
    });
    const back = button("Back", () => previous && panel.go(previous), { hidden: true });
    section.append(html("div", { class: "top" }, verdict.element, verdict.searches),
        html("div", { class: "body" }, html("div", { class: "side" }, controls.element, html("div", { class: "actions" }, back, reset)),
            html("div", { class: "main" }, html("div", { class: "first" },
                html("div", {}, view.element, report.variables.length > 0 ? sweep.element : ""),
                html("div", {}, sources.element, poses.element)), jacobian.element, same.element)));

    /** Parts that are on the screen; the others are drawn when they come into view. @type {Set<Element>} */
    const visible = new Set();
    const observer = new IntersectionObserver((entries) => entries.forEach(({ target, isIntersecting }) => {
        if (isIntersecting) visible.add(target);
        else visible.delete(target);
        if (isIntersecting) panel.refresh();
    }));
    parts.forEach(({ element }) => observer.observe(element));

    function evaluate() {
        const { state } = panel;
        panel.figures = machine.evaluate(state);
        const isChanged = (/** @type {"s" | "u" | "factors"} */ list) => state[list].some((value, i) => value !== baseline[list][i]);
        panel.reference = isChanged("s") || isChanged("u") || isChanged("factors") ? machine.evaluate({ ...baseline, q: state.q }) : null;
        const [symbol, factor] = report.error_unit[panel.measurand === "position" ? "length" : "angle"];
        panel.unit = { symbol, factor };
    }

    /** @param {boolean} all also what is not on the screen */
    function draw(all) {
        frame = 0;
        evaluate();
        back.hidden = previous === null;
        parts.filter(({ element }) => all || visible.has(element)).forEach((part) => part.update());
    }

    let factors = "";
    function settle() {
        const key = JSON.stringify([panel.state.factors, panel.state.s, panel.state.u]);
        if (key !== factors) {
            factors = key;
            panel.cloud = cloud(machine, report, panel.state);
        }
        draw(false);
        parts.forEach((part) => part.settle?.());
        writeAddress();
    }

    addEventListener("beforeprint", () => draw(true));
    addEventListener("hashchange", () => panel.go(decodeState(report, location.hash, prefix)));
    draw(true);
    settle();
}
