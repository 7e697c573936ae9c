// Tables: the error by rows, both poses, and the error Jacobian.

import { html, setText } from "./dom.js";
import { digits } from "./number.js";
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
    const { rows, length, error_unit } = panel.report;
    const units = rows.map((_, i) => error_unit[i < 3 ? "length" : "angle"]);
    const error = createTable("ΔX of the tool point, real minus ideal, in F_0", ["repeatable", "± random"],
        rows.map((row, i) => `${row} (${units[i][0]})`));
    const poses = ["Ideal pose in F_0", "Real pose: exact chain, repeatable sources"].map((caption) =>
        createTable(caption, ["x axis", "y axis", "z axis", `position (${length})`], ["x", "y", "z"]));
    const element = html("section", { class: "poses" }, ...[error, ...poses].map((table) => html("div", {}, table.element)));
    const update = () => {
        const { position, orientation, displacement, pose, realPose } = panel.figures;
        error.cells.forEach((cells, i) => [displacement, [...position.random, ...orientation.random]].forEach((values, c) =>
            setText(cells[c], errorOf(units[i][1] * values[i], 4))));
        [pose, realPose].forEach((one, which) => poses[which].cells.forEach((cells, r) => cells.forEach((cell, c) =>
            setText(cell, errorOf(one[3 * c + r], c < 3 ? 6 : length === "m" ? 7 : 4)))));
    };
    return { element, update };
}

/** Creates the error Jacobian: a table for each frame, shaded by the size of the entries. @param {Panel} panel */
export function createJacobian({ report: { length, frames, rows, columns }, machine, state }) {
    const tables = frames.map(({ name }, i) => createTable(`Frame ${i + 1}: ${name}`, columns.slice(6 * i, 6 * i + 6), rows));
    const element = html("details", { class: "jacobian" }, html("summary", {}, "Error Jacobian J_e: ΔX = J_e ε"),
        html("p", {}, `Rows x, y, z: ${length} per ${length} (e_x e_y e_z) or ${length} per rad (e_s e_r e_p, about y, z, x). `
            + "Other rows: rad per rad. Shaded by size, compared with the largest entry in the same unit."),
        html("div", { class: "frames" }, ...tables.map((table) => table.element)));
    const update = () => {
        const values = machine.jacobian(state);
        // Entries in the same unit: rows and columns of the same kind.
        const largest = [0, 3].map((first) => [0, 3].map((column) => Math.max(...values.slice(first, first + 3).map((row) =>
            Math.max(...row.filter((_, j) => Math.floor(j / 3) % 2 === column / 3).map(Math.abs))))));
        tables.forEach(({ cells }, f) => cells.forEach((row, i) => row.forEach((cell, c) => {
            const share = Math.abs(values[i][6 * f + c]) / largest[Number(i > 2)][Number(c > 2)];
            setText(cell, !Number.isFinite(values[i][6 * f + c]) ? "–" : share > 1e-12 ? digits(values[i][6 * f + c], 3) : "·");
            cell.style.setProperty("--heat", `${Math.round(100 * share) || 0}%`);
        })));
    };
    return { element, update };
}
