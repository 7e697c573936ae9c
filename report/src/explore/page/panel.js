// A panel: one machine with its state, whose parts are drawn again after each change, once per frame.

import { createSweep } from "./charts.js";
import { commands } from "./command.js";
import { createControls } from "./controls.js";
import { button, html, setText } from "./dom.js";
import { createLinked, follow } from "./linked.js";
import { createMachine } from "./machine.js";
import { createResiduals } from "./residuals.js";
import { createPins } from "./pins.js";
import { createSaved } from "./save.js";
import { cloud, stateAt } from "./search.js";
import { createSources } from "./sources.js";
import { copyState, decodeState, encodeState, initialState } from "./state.js";
import { createJacobian, createPoses } from "./tables.js";
import { createVerdict } from "./verdict.js";
import { createView } from "./view.js";
import { createWorkspace } from "./workspace.js";
/** @import { Report, State } from "./state.js" @import { Evaluation, Generated, Machine } from "./machine.js" */
/** @import { Largest, Measurand } from "./search.js" */

/**
 * What the parts of a panel read and call: the errors at the state, those before parameters, inputs or factors were
 * changed, and those at the configurations of the study; the measurand that is shown, with its unit; the joint that was
 * moved last. `go` replaces the state, and that before changes if it is given; `load` loads a configuration of the study.
 * @typedef {{report: Report, generated: Generated, machine: Machine, index: number, state: State, figures: Evaluation,
 *     reference: Evaluation | null, cloud: Record<Measurand, Largest> | null, measurand: Measurand,
 *     unit: {symbol: string, factor: number}, tolerances: Record<Measurand, number | null>, joint: number,
 *     change: (edit: (state: State) => void) => void, go: (state: State, base?: State) => void, load: (configuration: number) => void,
 *     refresh: () => void}} Panel
 */

/** Milliseconds without a change after which slower work is done. */
const SETTLED = 250;
/** Texts of all panels in the address. @type {(() => string)[]} */
const addresses = [];

/** Creates the commands and the link that give the same figures. @param {Panel} panel */
function createSame(panel) {
    const { report, state } = panel;
    const status = html("span", { role: "status" });
    const lines = ["Copy command", "Copy command", "Copy link"].map((name) => {
        const code = html("code");
        const copy = async () => {
            // A sandboxed frame has no clipboard, but its reader can copy what is selected.
            getSelection()?.selectAllChildren(code);
            const isCopied = await navigator.clipboard?.writeText(code.textContent ?? "").then(() => true, () => false);
            setText(status, isCopied ? "Copied." : "Selected: press Ctrl+C.");
        };
        return { code, element: html("div", { class: "copied" }, code, button(name, () => void copy())) };
    });
    // Texts that a program gave have no name that a command could take.
    const isNamed = report.spec !== "";
    const element = html("section", { class: "same" }, html("h2", {}, isNamed ? "The same figures by the command, and as a link" : "The same figures as a link"),
        ...lines.filter((_, i) => isNamed || i === 2).map((line) => line.element), status);
    const settle = () => {
        const link = `${location.href.split("#")[0]}#${addresses.map((address) => address()).filter(Boolean).join("&")}`;
        [...(isNamed ? commands(report, state, panel.tolerances) : ["", ""]), link].forEach((text, i) => setText(lines[i].code, text));
        try {
            history.replaceState(null, "", link);
        } catch {
            // A sandboxed frame has no address of its own.
        }
    };
    return { element, update: () => {}, settle };
}

/** Builds a panel in a section. @param {Element} section @param {Generated} generated @param {Report} report @param {number} index in the page */
export function mount(section, generated, report, index) {
    const prefix = index === 0 ? "" : `${index + 1}.`;
    /** Values of the address that the machine does not take. @type {string[]} */
    const ignored = [];
    const [machine, initial, state] = [createMachine(generated, report), initialState(report), decodeState(report, location.hash, prefix, ignored)];
    const { tolerance: position, orientation_tolerance: orientation } = report.study;
    let [frame, timer, reference, evaluated, seen] = [0, 0, initial, "", copyState(state)];
    /** States before the last changes, the oldest first. @type {State[]} */
    const past = [];
    /** @type {Panel} */
    const panel = { report, generated, machine, index, state, figures: machine.evaluate(state), reference: null, cloud: null,
        measurand: "position", unit: { symbol: "", factor: 1 }, tolerances: { position, orientation }, joint: 0,
        refresh() {
            follow(panel);
            frame ||= requestAnimationFrame(() => draw(false));
            clearTimeout(timer);
            timer = setTimeout(settle, SETTLED);
        },
        change(edit) {
            edit(state);
            panel.refresh();
        },
        go(next, base = reference) {
            remember();
            reference = { ...base, factors: initial.factors };
            panel.change(() => Object.assign(state, copyState(next)));
        },
        load(configuration) {
            panel.go(stateAt(report, state, configuration), stateAt(report, reference, configuration));
        } };
    const back = button("Back", undo, { hidden: true, title: "Undo the last change (Ctrl+Z)" });
    const reset = button("Reset", () => panel.go(initial, initial));
    /** Keeps the state before a change. */
    function remember() {
        if (JSON.stringify(seen) !== JSON.stringify(state)) past.push(seen);
        [seen, back.hidden] = [copyState(state), past.length === 0];
    }
    /** Takes the last change back. */
    function undo() {
        remember();
        const before = past.pop();
        if (!before) return;
        seen = copyState(before);
        panel.change(() => Object.assign(state, before));
    }
    section.addEventListener("keydown", (event) => {
        const { key, ctrlKey, metaKey, shiftKey, target } = /** @type {KeyboardEvent} */ (event);
        // A field of text undoes what was typed in it.
        const isText = target instanceof HTMLInputElement && target.type === "text";
        if (key !== "z" || !(ctrlKey || metaKey) || shiftKey || isText) return;
        event.preventDefault();
        undo();
    });
    const limits = () => String([panel.tolerances.position ?? "", panel.tolerances.orientation ?? ""]);
    const studied = limits();
    const refused = html("p", { class: "detail", role: "status" });
    /** Takes the tolerances of the address, or those of the study, with what it shows, and says what of it is not taken. */
    const arrive = () => {
        const address = new URLSearchParams(location.hash.slice(1));
        const [rows, along] = (address.get(`${prefix}shown`) ?? "").split(",");
        panel.measurand = rows === "orientation" ? rows : "position";
        panel.joint = Math.max(0, report.variables.findIndex(({ name }) => name === along));
        const given = address.get(`${prefix}tolerances`)?.split(",").map(Number);
        const limit = (/** @type {number} */ value) => (value > 0 && value < Infinity ? value : null);
        panel.tolerances = given ? { position: limit(given[0]), orientation: limit(given[1]) } : { position, orientation };
        setText(refused, ignored.length === 0 ? "" : `Not taken from the link, because this machine has no such value: ${ignored.join(", ")}.`);
    };
    arrive();
    const shown = () => (panel.measurand === "position" && panel.joint === 0 ? ""
        : `${prefix}shown=${panel.measurand},${encodeURIComponent(report.variables[panel.joint]?.name ?? "")}`);
    addresses.push(() => [encodeState(report, state, prefix), limits() === studied ? "" : `${prefix}tolerances=${limits()}`, shown()]
        .filter(Boolean).join("&"));
    const measured = report.residuals ? [createResiduals(panel, report.residuals)] : [];
    const [verdict, controls, view, sources] = [createVerdict(panel), createControls(panel),
        createView(panel, report.residuals ? measured : [createWorkspace(panel)]), createSources(panel)];
    const [pins, linked] = [createPins(panel), createLinked(panel)];
    const [poses, jacobian, same, saved] = [createPoses(panel), createJacobian(panel), createSame(panel), createSaved(panel, view.element)];
    const sweep = report.variables.length > 0 ? [createSweep(panel)] : [];
    /** @type {{element: Element, update: () => void, settle?: () => void}[]} */
    const parts = [verdict, controls, linked, view, sources, ...sweep, poses, pins, jacobian, same, saved];
    const box = (/** @type {string} */ name, /** @type {(Node | string)[]} */ ...children) => html("div", { class: name }, ...children);
    if (document.querySelector(".abbe-panel ~ .abbe-panel")) section.append(html("h2", { class: "title" }, report.title));
    section.append(box("top", refused, verdict.element, verdict.searches), box("body",
        box("side", controls.element, linked.element, box("actions", back, reset)),
        box("main", box("columns", box("column", view.element, ...[...measured, ...sweep].map((part) => part.element)),
            box("column", sources.element, poses.element)), pins.element, jacobian.element, same.element, saved.element)));
    /** Parts on the screen; the others are drawn when they come into view. @type {Set<Element>} */
    const visible = new Set();
    const observer = new IntersectionObserver((entries) => entries.forEach(({ target, isIntersecting }) => {
        visible[isIntersecting ? "add" : "delete"](target);
        if (isIntersecting) panel.refresh();
    }));
    parts.forEach(({ element }) => observer.observe(element));
    /** @param {boolean} all also what is not on the screen */
    function draw(all) {
        frame = 0;
        panel.figures = machine.evaluate(state);
        const isChanged = String([state.s, state.u, state.factors]) !== String([reference.s, reference.u, reference.factors]);
        panel.reference = isChanged ? machine.evaluate({ ...reference, q: state.q }) : null;
        const [symbol, factor] = report.error_unit[panel.measurand === "position" ? "length" : "angle"];
        panel.unit = { symbol, factor };
        parts.filter(({ element }) => all || visible.has(element)).forEach((part) => part.update());
    }
    function settle() {
        remember();
        const changes = String([state.factors, state.s, state.u]);
        if (changes !== evaluated) panel.cloud = cloud(machine, report, state);
        evaluated = changes;
        draw(true);
        parts.forEach((part) => part.settle?.());
    }
    addEventListener("beforeprint", () => draw(true));
    addEventListener("hashchange", () => {
        ignored.length = 0;
        const arrived = decodeState(report, location.hash, prefix, ignored);
        arrive();
        panel.go(arrived);
    });
    draw(true);
    settle();
    // Where no link says otherwise, the page opens at the largest error of the study.
    if (!report.residuals && panel.cloud && report.configurations.q.length > 0 && encodeState(report, state, prefix) === "") {
        panel.load(panel.cloud.position.worst);
    }
}
