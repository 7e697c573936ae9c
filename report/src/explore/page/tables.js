// Tables: the error by rows, both poses, and the error Jacobian.

import { html, setText } from "./dom.js";
import { digits, fixed } from "./number.js";
import { errorOf } from "./sources.js";

/** @import { Panel } from "./panel.js" */

/** Creates a table and returns it with its cells. @param {string} caption @param {string[]} columns @param {string[]} rows */
function createTable(caption, columns, rows) {
    const cells = rows.map(() => columns.map(() => html("td")));
    const element = html("table", {}, html("caption", {}, caption),
        html("thead", {}, html("tr", {}, html("td"), ...columns.map((name) => html("th", { scope: "col" }, name)))),
        html("tbody", {}, ...rows.map((name, i) => html("tr", {}, html("th", { scope: "row" }, name), ...cells[i]))));
    return { element, cells };
}

/** Creates the tables of ΔX and of both poses. @param {Panel} panel */
export function createPoses(panel) {
    const { report } = panel;
    const units = report.rows.map((_, i) => report.error_unit[i < 3 ? "length" : "angle"]);
    const error = createTable("ΔX of the tool point, real minus ideal, in F_0", ["repeatable", "± random"],
        report.rows.map((row, i) => `${row} (${units[i][0]})`));
    const poses = ["Ideal pose in F_0", "Real pose: exact chain, repeatable sources"].map((caption) =>
        createTable(caption, ["x axis", "y axis", "z axis", `position (${report.length})`], ["x", "y", "z"]));
    const element = html("section", { class: "poses" }, ...[error, ...poses].map((table) => html("div", {}, table.element)));
    const places = [6, 6, 6, report.length === "m" ? 7 : 4];
    const update = () => {
        const { position, orientation, displacement, pose, realPose } = panel.figures;
        const random = [...position.random, ...orientation.random];
        error.cells.forEach((cells, i) => [displacement, random].forEach((values, c) =>
            setText(cells[c], errorOf(units[i][1] * values[i], 4))));
        [pose, realPose].forEach((one, which) => poses[which].cells.forEach((cells, r) =>
            cells.forEach((cell, c) => setText(cell, fixed(one[3 * c + r], places[c])))));
    };
    return { element, update };
}

/** Creates the error Jacobian: a table for each frame, shaded by the size of the entries. @param {Panel} panel */
export function createJacobian(panel) {
    const { report, machine } = panel;
    const { length } = report;
    const frames = report.frames.map(({ name }, i) =>
        createTable(`Frame ${i + 1}: ${name}`, report.columns.slice(6 * i, 6 * i + 6), report.rows));
    const element = html("section", { class: "jacobian" }, html("h2", {}, "Error Jacobian J_e: ΔX = J_e ε"),
        html("p", {}, `Rows x, y, z: ${length} per ${length} (e_x e_y e_z) or ${length} per rad (e_s e_r e_p, about y, z, x). Other rows: `
            + "rad per rad. Shaded by size, compared with the largest entry in the same unit."),
        html("div", { class: "frames" }, ...frames.map((frame) => frame.element)));
    const update = () => {
        const rows = machine.jacobian(panel.state);
        const unitOf = (/** @type {number} */ i, /** @type {number} */ j) => 2 * Number(i > 2) + Number(j % 6 > 2);
        const largest = [0, 0, 0, 0];
        rows.forEach((row, i) => row.forEach((value, j) => {
            largest[unitOf(i, j)] = Math.max(largest[unitOf(i, j)], Math.abs(value));
        }));
        frames.forEach(({ cells }, f) => cells.forEach((row, i) => row.forEach((cell, c) => {
            const value = rows[i][6 * f + c];
            setText(cell, Math.abs(value) > 1e-12 * largest[unitOf(i, c)] ? digits(value, 3) : "·");
            cell.style.setProperty("--heat", `${Math.round((100 * Math.abs(value)) / (largest[unitOf(i, c)] || 1))}%`);
        })));
    };
    return { element, update };
}
