// Builds elements without markup, so that texts of specs inject nothing.

/** @typedef {Record<string, string | number | boolean>} Attributes */

/** @template {Element} E @param {E} element @param {Attributes} attributes @param {(Node | string)[]} children @returns {E} */
function filled(element, attributes, children) {
    for (const [name, value] of Object.entries(attributes)) {
        if (value !== false) element.setAttribute(name, value === true ? "" : String(value));
    }
    element.append(...children);
    return element;
}

/** Creates an HTML element. @template {keyof HTMLElementTagNameMap} T @param {T} tag @param {Attributes} attributes @param {(Node | string)[]} children */
export const html = (tag, attributes = {}, ...children) => filled(document.createElement(tag), attributes, children);

/** Creates an SVG element. @template {keyof SVGElementTagNameMap} T @param {T} tag @param {Attributes} attributes @param {(Node | string)[]} children */
export const svg = (tag, attributes = {}, ...children) =>
    filled(document.createElementNS("http://www.w3.org/2000/svg", tag), attributes, children);

/** Creates spans, one for each class. @param {string[]} names */
export const spans = (...names) => names.map((name) => html("span", { class: name }));

/** Creates paths, one for each class. @param {string[]} names */
export const paths = (...names) => names.map((name) => svg("path", { class: name }));

/** Moves an element of a drawing, or hides it where there is no such place. @param {SVGElement} element @param {number[]} to */
export function moveTo(element, [x, y]) {
    const isThere = Number.isFinite(x + y);
    element.style.display = isThere ? "" : "none";
    if (isThere) element.setAttribute("transform", `translate(${x.toFixed(1)} ${y.toFixed(1)})`);
}

/** Sets the text of an element, if it differs. @param {Element} element @param {string} text */
export function setText(element, text) {
    if (element.textContent !== text) element.textContent = text;
}

/** Creates a button. @param {string} text @param {() => void} action @param {Attributes} [attributes] */
export function button(text, action, attributes = {}) {
    const element = html("button", { type: "button", ...attributes }, text);
    element.addEventListener("click", action);
    return element;
}

/** Keeps the view box of a drawing in pixels. @param {SVGElement} drawing @param {(size: [number, number]) => void} resized */
export function onResize(drawing, resized) {
    new ResizeObserver(([{ contentRect: { width, height } }]) => {
        drawing.setAttribute("viewBox", `0 0 ${width} ${height}`);
        if (width > 0) resized([width, height]);
    }).observe(drawing);
}

/** Distance in pixels at which a point is picked. */
const PICKED = 10;

/** Calls a function with the index of the nearest place at a click that is not the end of a drag. @param {HTMLElement} stage @param {() => number[][]} places in its pixels @param {(index: number) => void} picked */
export function onPick(stage, places, picked) {
    let [x, y] = [0, 0];
    stage.addEventListener("pointerdown", ({ clientX, clientY }) => { [x, y] = [clientX, clientY]; });
    stage.addEventListener("click", ({ clientX, clientY }) => {
        const { left, top } = stage.getBoundingClientRect();
        const away = places().map((place) => Math.hypot(place[0] + left - clientX, place[1] + top - clientY));
        const index = away.reduce((best, distance, i) => (distance < (away[best] ?? PICKED) ? i : best), -1);
        if (index >= 0 && Math.hypot(clientX - x, clientY - y) <= 3) picked(index);
    });
}

/** Returns the SVG path through points, with gaps where a number is not finite. @param {number[][]} points */
export const path = (points) => points.map(([x, y], i) => (Number.isFinite(x + y)
    ? `${i && Number.isFinite(points[i - 1][0] + points[i - 1][1]) ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}` : "")).join("");

/** Returns the largest of 1, 2 and 5 times a power of ten that is at most `value`; 1 for zero. @param {number} value */
export function roundStep(value) {
    const power = 10 ** Math.floor(Math.log10(value || 1) + 1e-9);
    return ([5, 2].find((mantissa) => mantissa * power <= value * (1 + 1e-9)) ?? 1) * power;
}
