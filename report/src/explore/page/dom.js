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

/** Returns the index of the place nearest to a pointer; -1 if none is near. @param {HTMLElement} stage @param {number[][]} places in its pixels @param {MouseEvent} event */
export function nearest(stage, places, { clientX, clientY }) {
    const { left, top } = stage.getBoundingClientRect();
    const away = places.map(([x, y]) => Math.hypot(x + left - clientX, y + top - clientY));
    return away.reduce((best, distance, i) => (distance < (away[best] ?? PICKED) ? i : best), -1);
}

/** Writes a text beside a place in a drawing, or hides it without one. @typedef {(place: number[], text: string) => void} Tell */

/** Creates a text that is written beside a place. @returns {{element: SVGElement, tell: Tell}} */
export function createNote() {
    const element = svg("text", { class: "note", y: -12 });
    return { element, tell: (place, text) => {
        setText(element, text);
        element.setAttribute("text-anchor", place[0] > (element.ownerSVGElement?.clientWidth ?? 0) / 2 ? "end" : "start");
        moveTo(element, text === "" ? [NaN, NaN] : place);
    } };
}

/**
 * Calls `picked` with the index of the nearest place at a click that is not the end of a drag, and tells its text while the
 * pointer is there.
 * @param {HTMLElement} stage @param {() => number[][]} places in its pixels @param {(index: number) => void} picked
 * @param {(index: number) => string} text @param {Tell} tell
 */
export function onPick(stage, places, picked, text, tell) {
    let [x, y] = [0, 0];
    stage.addEventListener("pointerdown", ({ clientX, clientY }) => { [x, y] = [clientX, clientY]; });
    stage.addEventListener("click", (event) => {
        const index = nearest(stage, places(), event);
        if (index >= 0 && Math.hypot(event.clientX - x, event.clientY - y) <= 3) picked(index);
    });
    stage.addEventListener("pointermove", (event) => {
        const index = event.buttons === 0 ? nearest(stage, places(), event) : -1;
        tell(places()[index] ?? [NaN, NaN], index < 0 ? "" : text(index));
    });
    stage.addEventListener("pointerleave", () => tell([NaN, NaN], ""));
}

/** Returns the SVG path through points, with gaps where a number is not finite. @param {number[][]} points */
export const path = (points) => points.map(([x, y], i) => (Number.isFinite(x + y)
    ? `${i && Number.isFinite(points[i - 1][0] + points[i - 1][1]) ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}` : "")).join("");

/** Returns the largest of 1, 2 and 5 times a power of ten that is at most `value`; 1 for zero. @param {number} value */
export function roundStep(value) {
    const power = 10 ** Math.floor(Math.log10(value || 1) + 1e-9);
    return ([5, 2].find((mantissa) => mantissa * power <= value * (1 + 1e-9)) ?? 1) * power;
}
