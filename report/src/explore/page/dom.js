// Builds elements without markup, so that texts of specs inject nothing.

/** @typedef {Record<string, string | number | boolean>} Attributes */

/**
 * Sets the attributes of an element and appends its children.
 * @template {Element} E
 * @param {E} element @param {Attributes} attributes @param {(Node | string)[]} children @returns {E}
 */
function filled(element, attributes, children) {
    for (const [name, value] of Object.entries(attributes)) {
        if (value !== false) element.setAttribute(name, value === true ? "" : String(value));
    }
    element.append(...children);
    return element;
}

/**
 * Creates an HTML element.
 * @template {keyof HTMLElementTagNameMap} T
 * @param {T} tag @param {Attributes} attributes @param {(Node | string)[]} children @returns {HTMLElementTagNameMap[T]}
 */
export function html(tag, attributes = {}, ...children) {
    return filled(document.createElement(tag), attributes, children);
}

/**
 * Creates an SVG element.
 * @template {keyof SVGElementTagNameMap} T
 * @param {T} tag @param {Attributes} attributes @param {(Node | string)[]} children @returns {SVGElementTagNameMap[T]}
 */
export function svg(tag, attributes = {}, ...children) {
    return filled(document.createElementNS("http://www.w3.org/2000/svg", tag), attributes, children);
}

/** Sets the text of an element, if it differs. @param {Element} element @param {string} text */
export function setText(element, text) {
    if (element.textContent !== text) element.textContent = text;
}

/** Creates a button. @param {string} text @param {() => void} action @param {Attributes} attributes */
export function button(text, action, attributes = {}) {
    const element = html("button", { type: "button", ...attributes }, text);
    element.addEventListener("click", action);
    return element;
}

/**
 * Calls a function with the width and height of an element, now and when they change.
 * @param {Element} element @param {(width: number, height: number) => void} resized
 */
export function onResize(element, resized) {
    new ResizeObserver(() => {
        if (element.clientWidth > 0) resized(element.clientWidth, element.clientHeight);
    }).observe(element);
}

/** Returns the SVG path through points. @param {number[][]} points */
export function path(points) {
    return points.map(([x, y], i) => `${i ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`).join("");
}

/** Returns the largest of 1, 2 and 5 times a power of ten that is at most `value`. @param {number} value */
export function roundStep(value) {
    const power = 10 ** Math.floor(Math.log10(value));
    const mantissa = value / power;
    return (mantissa >= 5 ? 5 : mantissa >= 2 ? 2 : 1) * power;
}
