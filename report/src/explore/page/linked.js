// Machines of one page whose joints of the same name and kind move together.

import { html, setText } from "./dom.js";
import { decimals, exact, parseValue } from "./number.js";
import { errorOf } from "./sources.js";
import { isWithin, variableUnit } from "./state.js";
/** @import { Panel } from "./panel.js" */

/** Panels of the page with their joints when they were last looked at, and what writes their differences. @type {{panel: Panel, seen: number[], write: () => void}[]} */
const members = [];
/** Names of joints move together if this is checked. */
let isLinked = false;

/** Moves joints of the other machines as those of this one were moved. @param {Panel} panel */
export function follow(panel) {
    const own = members.find((member) => member.panel === panel);
    if (!own) return;
    const { report, state } = panel;
    const moved = state.q.flatMap((value, i) => (value === own.seen[i] ? [] : [i]));
    own.seen = [...state.q];
    if (!isLinked) return;
    for (const member of members) {
        const { report: other, state: theirs, refresh } = member.panel;
        const isMoved = member !== own && moved.map((i) => {
            const { name, kind } = report.variables[i];
            const j = other.variables.findIndex((one) => one.name === name && one.kind === kind);
            const value = j < 0 || other.length === report.length ? state.q[i]
                : parseValue(exact(state.q[i], variableUnit(report, i)), variableUnit(other, j), other.length) ?? NaN;
            if (j < 0 || !isWithin(value, other.variables[j].limits)) return false;
            theirs.q[j] = member.seen[j] = value;
            return true;
        }).some(Boolean);
        if (isMoved) refresh();
    }
}

/** Creates the choice whether joints move together; the first panel has none. @param {Panel} panel */
export function createLinked(panel) {
    const first = members[0]?.panel;
    members.push({ panel, seen: [...panel.state.q], write });
    const [box, text] = [html("input", { type: "checkbox" }), html("span", { role: "status" })];
    box.addEventListener("change", () => {
        isLinked = box.checked;
        if (isLinked) members[0].seen = [];
        first.refresh();
        panel.refresh();
    });
    const names = new Set(first?.report.variables.map(({ name, kind }) => `${kind} ${name}`));
    const common = panel.report.variables.filter(({ name, kind }) => names.has(`${kind} ${name}`)).map(({ name }) => name);
    const element = html("div", { class: "linked", hidden: common.length === 0 },
        html("label", {}, box, `joints together with ${first?.report.title}: ${common.join(", ")}`), text);
    function write() {
        if (!first) return;
        box.checked = isLinked;
        const kind = panel.measurand === "position" ? "length" : "angle";
        const [own, other] = [panel, first].map(({ report, machine, state }) =>
            report.error_unit[kind][1] * machine.evaluate(state)[panel.measurand].radius);
        setText(text, !isLinked ? "" : `${errorOf(Math.abs(own - other), decimals(own, 4))} ${panel.unit.symbol} ${own < other ? "less" : "more"} than there`);
    }
    // A change of either machine changes the difference.
    return { element, update: () => members.forEach((member) => member.write()) };
}
