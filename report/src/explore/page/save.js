// Files of what a panel shows: its picture, and tables of the sources and of the study.

import { button, html, setText } from "./dom.js";
import { stateAt } from "./search.js";
import { factorOf } from "./state.js";
/** @import { Panel } from "./panel.js" */

/** Properties of a drawing that its style sheet gives; as attributes they mean the same. */
const DRAWN = ["fill", "fill-opacity", "stroke", "stroke-width", "stroke-opacity", "stroke-dasharray", "stroke-linecap", "stroke-linejoin",
    "opacity", "display", "font-family", "font-size", "font-weight", "paint-order"];

/** Returns a cell of CSV; a text that a spreadsheet would execute begins with an apostrophe. @param {string | number} cell */
function cellText(cell) {
    const isFormula = typeof cell === "string" && /^['\s]*[=+\-@|＝＋－＠]/.test(cell);
    const text = isFormula ? `'${cell}` : String(cell);
    return /[",;\n\r\t]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

/** Returns a table as CSV. @param {(string | number)[][]} rows */
const csv = (rows) => `${rows.map((row) => row.map(cellText).join(",")).join("\n")}\n`;

/** Returns the sources at the state. @param {Panel} panel @returns {string} */
export function sourceTable({ report, state, figures, measurand, unit: { symbol, factor } }) {
    const { norms, shares } = figures[measurand];
    const rows = report.sources.map(({ name, class: kind, at }, k) => [name, kind, at, factor * norms[k], shares[k], factorOf(report, state, k)]);
    return csv([["source", "class", "at", `${measurand} error (${symbol})`, "share", "factor"], ...rows]);
}

/** Returns the configurations of the study with their errors, in coherent units. @param {Panel} panel @returns {string} */
export function studyTable({ report, state, cloud }) {
    const { variables, parameters, inputs, length } = report;
    const of = (/** @type {{name: string, unit: string}[]} */ all) => all.map(({ name, unit }) => (unit === "" ? name : `${name} (${unit})`));
    const heading = [...variables.map(({ name, kind }) => `${name} (${kind === "revolute" ? "rad" : length})`), ...of(parameters), ...of(inputs),
        `position error (${length})`, "orientation error (rad)"];
    const rows = report.configurations.q.map((_, i) => {
        const { q, s, u } = stateAt(report, state, i);
        return [...q, ...s, ...u, cloud?.position.radii[i] ?? "", cloud?.orientation.radii[i] ?? ""];
    });
    return csv([heading, ...rows]);
}

/** Returns a drawing with the style it has, as a document of its own, and its size. @param {SVGSVGElement} drawing */
function picture(drawing) {
    const copy = /** @type {SVGSVGElement} */ (drawing.cloneNode(true));
    const own = drawing.querySelectorAll("*");
    copy.querySelectorAll("*").forEach((element, i) => {
        const style = getComputedStyle(own[i]);
        // The policy of the page refuses an attribute `style`.
        DRAWN.forEach((name) => element.setAttribute(name, style.getPropertyValue(name)));
    });
    const { width, height } = drawing.viewBox.baseVal;
    for (const [name, value] of Object.entries({ xmlns: "http://www.w3.org/2000/svg", width, height })) copy.setAttribute(name, String(value));
    copy.removeAttribute("aria-hidden");
    return { text: new XMLSerializer().serializeToString(copy), width, height };
}

/** Returns a picture as PNG, on the background of the page. @param {ReturnType<typeof picture>} drawing @param {string} paper @returns {Promise<Blob | null>} */
async function asPng({ text, width, height }, paper) {
    const image = new Image();
    image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(text)}`;
    await image.decode();
    const canvas = Object.assign(document.createElement("canvas"), { width: 2 * width, height: 2 * height });
    const context = canvas.getContext("2d");
    if (!context) return null;
    context.fillStyle = paper;
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.drawImage(image, 0, 0, canvas.width, canvas.height);
    return new Promise((done) => canvas.toBlob(done, "image/png"));
}

/** Creates the buttons that save files. @param {Panel} panel @param {Element} view with the picture */
export function createSaved(panel, view) {
    const { report } = panel;
    const status = html("span", { role: "status" });
    const drawing = () => picture(/** @type {SVGSVGElement} */ (view.querySelector("svg")));
    const save = (/** @type {string} */ ending, /** @type {Blob | null} */ blob) => {
        if (!blob) return setText(status, "This browser cannot draw the picture.");
        const url = URL.createObjectURL(blob);
        html("a", { href: url, download: `${report.name}.${ending}` }).click();
        setTimeout(() => URL.revokeObjectURL(url), 1000);
        setText(status, `Saved ${report.name}.${ending}.`);
    };
    const text = (/** @type {string} */ content, type = "text/csv") => new Blob([content], { type });
    const files = [
        button("Picture, SVG", () => save("svg", text(drawing().text, "image/svg+xml"))),
        button("Picture, PNG", () => void asPng(drawing(), getComputedStyle(view).backgroundColor).then((blob) => save("png", blob))),
        button("Sources, CSV", () => save("sources.csv", text(sourceTable(panel)))),
        ...(report.configurations.q.length > 0 ? [button("Study, CSV", () => save("study.csv", text(studyTable(panel))))] : []),
    ];
    const element = html("section", { class: "same" }, html("h2", {}, "Files of what is shown"), html("div", { class: "actions" }, ...files, status));
    return { element, update: () => {} };
}
