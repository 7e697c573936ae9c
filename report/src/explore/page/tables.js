// Tables: the error by rows, both poses, and the error Jacobian.

import { html, setText } from "./dom.js";
import { digits, fixed } from "./number.js";

/** @import { Panel } from "./panel.js" */

/**
 * Creates a table with names of rows and columns, and returns its cells.
 * @param {string} caption @param {string[]} columns @param {string[]} rows
 */
function createTable(caption, columns, rows) {
    const cells = rows.map(() => columns.map(() => html("td")));
    const element = html("table", {}, html("caption", {}, caption),
        html("thead", {}, html("tr", {}, html("td"), ...columns.map((name) => html("th", { scope: "col" }, name)))),
        html("tbody", {}, ...rows.map((name, i) => html("tr", {}, html("th", { scope: "row" }, name), ...cells[i]))));
    return { element, cells };
}

/** Creates the tables of ΔX and of the ideal and the real pose. @param {Panel} panel */
export function createPoses(panel) {
    const { report } = panel;
    const units = report.rows.map((_, i) => report.error_unit[i < 3 ? "length" : "angle"]);
    const error = createTable("ΔX of the tool point, real minus ideal, in F₀", ["repeatable", "± random"],
        report.rows.map((row, i) => `${row} (${units[i][0]})`));
    const names = ["x axis", "y axis", "z axis", `position (${report.length})`];
    const poses = ["Ideal pose in F₀", "Real pose, exact chain, repeatable sources"].map((caption) => createTable(caption, names, ["x", "y", "z"]));
    const element = html("section", { class: "poses" }, ...[error, ...poses].map((table) => html("div", {}, table.element)));
    const places = report.length === "m" ? 7 : 4;
    const update = () => {
        const { figures } = panel;
        error.cells.forEach((cells, i) => {
            const [, scale] = units[i];
            const random = i < 3 ? figures.position.random[i] : figures.orientation.random[i - 3];
            setText(cells[0], fixed(scale * figures.displacement[i], 4));
            setText(cells[1], fixed(scale * random, 4));
        });
        [figures.pose, figures.realPose].forEach((pose, which) => poses[which].cells.forEach((cells, r) => cells.forEach((cell, c) =>
            setText(cell, fixed(pose[3 * c + r], c < 3 ? 6 : places)))));
    };
    return { element, update };
}

/** Creates the error Jacobian: a table for each frame, shaded by the size of the entries. @param {Panel} panel */
export function createJacobian(panel) {
    const { report, machine } = panel;
    const { length } = report;
    const frames = report.frames.map(({ name }, i) =>
        createTable(`Frame ${i + 1}: ${name}`, report.columns.slice(6 * i, 6 * i + 6), report.rows));
    const element = html("section", { class: "jacobian" }, html("h3", {}, "Error Jacobian: ΔX = J_e ε"),
        html("p", {}, `Rows x, y, z: ${length} per ${length} (e_x e_y e_z) or per rad (e_s e_r e_p: about y, z, x). `
            + "Other rows: rad per rad. Shading: size, compared with the largest entry of the same unit."),
        html("div", { class: "frames" }, ...frames.map((frame) => frame.element)));
    const update = () => {
        const rows = machine.jacobian(panel.state);
        // Entries with the same unit: block 2 · (row ≥ 3) + (column ≥ 3).
        const block = (/** @type {number} */ i, /** @type {number} */ j) => 2 * Number(i >= 3) + Number(j % 6 >= 3);
        const largest = [0, 0, 0, 0];
        rows.forEach((row, i) => row.forEach((value, j) => (largest[block(i, j)] = Math.max(largest[block(i, j)], Math.abs(value)))));
        frames.forEach(({ cells }, f) => cells.forEach((row, i) => row.forEach((cell, c) => {
            const value = rows[i][6 * f + c];
            const text = Math.abs(value) < 1e-12 ? "·" : digits(value, 3);
            if (cell.textContent === text) return;
            cell.textContent = text;
            cell.style.setProperty("--heat", `${Math.round((100 * Math.abs(value)) / (largest[block(i, c)] || 1))}%`);
        })));
    };
    return { element, update };
}
