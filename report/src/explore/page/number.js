// Numbers for people, as the command prints them, and values with units, as it parses them.

/**
 * Returns the shorter text, or if the longer one ends in a 5 that is exact, rounds half to even as Rust does.
 * @param {string} shorter @param {string} longer with one digit more @param {boolean} isExact @returns {string}
 */
function halfToEven(shorter, longer, isExact) {
    const down = longer.slice(0, -1).replace(/\.$/, "");
    return isExact && longer.endsWith("5") && Number(down.at(-1)) % 2 === 0 ? down : shorter;
}

/**
 * Returns true if so many decimals are the whole number.
 * @param {number} value @param {number} decimals @returns {boolean}
 */
function hasDecimals(value, decimals) {
    return decimals >= 0 ? Number.isInteger(value * 2 ** decimals) : value % 10 ** -decimals === 0;
}

/** @param {number} value @param {number} decimals @returns {string} */
function toFixed(value, decimals) {
    return halfToEven(value.toFixed(decimals), value.toFixed(decimals + 1), hasDecimals(value, decimals + 1));
}

/** @param {number} value @param {number} decimals @returns {string} such as `1.234e4` */
function toExponential(value, decimals) {
    const [[shorter, power], [longer, exponent]] =
        [decimals, decimals + 1].map((count) => value.toExponential(count).replace("+", "").split("e"));
    const mantissa = halfToEven(shorter, longer, hasDecimals(value, decimals + 1 - Number(exponent)));
    return `${mantissa}e${mantissa === shorter ? power : exponent}`;
}

/**
 * Formats a number with a fixed number of decimals; zero as `0`, numbers from 1e7 in powers of ten.
 * @param {number} value @param {number} decimals @returns {string}
 */
export function fixed(value, decimals) {
    if (value === 0) return "0";
    if (Number.isNaN(value)) return "NaN";
    if (!Number.isFinite(value)) return value > 0 ? "∞" : "-∞";
    if (Math.abs(value) >= 1e7) return toExponential(value, 3);
    const text = toFixed(value, decimals);
    return /[1-9]/.test(text) ? text : text.replace("-", "");
}

/**
 * Formats a number with at most so many decimals, without trailing zeros.
 * @param {number} value @param {number} decimals @returns {string}
 */
export function trimmed(value, decimals) {
    const text = fixed(value, decimals);
    return /^[^e]*\./.test(text) && !text.includes("e") ? text.replace(/\.?0+$/, "") : text;
}

/**
 * Formats a number to seven significant digits, without trailing zeros.
 * @param {number} value @returns {string}
 */
export function short(value) {
    if (!Number.isFinite(value)) return fixed(value, 0);
    const rounded = Number(toExponential(value, 6));
    const size = Math.abs(rounded);
    const isPlain = rounded === 0 || (size >= 1e-5 && size < 1e7);
    return isPlain ? String(rounded + 0) : rounded.toExponential().replace("+", "");
}

/**
 * Formats a number to so many significant digits.
 * @param {number} value @param {number} count @returns {string}
 */
export function digits(value, count) {
    return short(Number.isFinite(value) ? Number(toExponential(value, Math.max(count - 1, 0))) : value);
}

/**
 * Returns the number of decimals that show so many significant digits of a number that is not negative; at most 12.
 * @param {number} value @param {number} count @returns {number}
 */
export function decimals(value, count) {
    const first = value > 0 ? Math.floor(Math.log10(value)) : 0;
    return Math.min(Math.max(count - 1 - first, 0), 12);
}

/** Formats a number with so many decimals, rounded up. @param {number} value @param {number} decimals @returns {string} */
export function roundedUp(value, decimals) {
    const nearest = fixed(value, decimals);
    return Number(nearest) < value ? fixed(value + 0.1 ** decimals, decimals) : nearest;
}

/** Formats a number with so many decimals, rounded down. @param {number} value @param {number} decimals @returns {string} */
export function roundedDown(value, decimals) {
    const nearest = fixed(value, decimals);
    return Number(nearest) > value ? fixed(value - 0.1 ** decimals, decimals) : nearest;
}

/** Formats the ratio of two numbers in whole percent. @param {number} value @param {number} of @returns {string} */
export function percent(value, of) {
    const ratio = (100 * value) / of;
    return `${Number.isFinite(ratio) ? toFixed(ratio, 0) : ratio} %`;
}

/** Formats a number with its unit, if it has one. @param {number} value @param {string} unit @returns {string} */
export function quantity(value, unit) {
    return `${short(value)} ${unit}`.trimEnd();
}

/**
 * Units: exponents of length, mass, time and temperature; exponent of ten; numerator; parts of a degree.
 * @type {Record<string, [number[], number, number?, number?]>}
 */
const UNITS = {
    m: [[1, 0, 0, 0], 0], cm: [[1, 0, 0, 0], -2], mm: [[1, 0, 0, 0], -3], um: [[1, 0, 0, 0], -6],
    nm: [[1, 0, 0, 0], -9], inch: [[1, 0, 0, 0], -4, 254],
    kg: [[0, 1, 0, 0], 0], g: [[0, 1, 0, 0], -3], t: [[0, 1, 0, 0], 3], lb: [[0, 1, 0, 0], -8, 45359237],
    s: [[0, 0, 1, 0], 0], min: [[0, 0, 1, 0], 0, 60], h: [[0, 0, 1, 0], 0, 3600], K: [[0, 0, 0, 1], 0],
    N: [[1, 1, -2, 0], 0], kN: [[1, 1, -2, 0], 3], mN: [[1, 1, -2, 0], -3],
    Pa: [[-1, 1, -2, 0], 0], kPa: [[-1, 1, -2, 0], 3], MPa: [[-1, 1, -2, 0], 6], GPa: [[-1, 1, -2, 0], 9],
    rad: [[0, 0, 0, 0], 0], mrad: [[0, 0, 0, 0], -3], urad: [[0, 0, 0, 0], -6], ppm: [[0, 0, 0, 0], -6],
    "%": [[0, 0, 0, 0], -2], deg: [[0, 0, 0, 0], 0, 1, 1], "°": [[0, 0, 0, 0], 0, 1, 1],
    arcmin: [[0, 0, 0, 0], 0, 1, 60], arcsec: [[0, 0, 0, 0], 0, 1, 3600],
};

/**
 * A product of powers of units, as in the spec.
 * @typedef {{dimension: number[], above: number, below: number, decades: number, degrees: number}} Unit
 */

/** Parses a unit such as `mm^2/s`; `undefined` if it is none. @param {string} text @returns {Unit | undefined} */
function parseUnit(text) {
    const unit = { dimension: [0, 0, 0, 0], above: 1, below: 1, decades: 0, degrees: 0 };
    const factors = /\s*([*/]?)\s*([A-Za-zµμ%°]+)(?:\s*\^\s*(-?\d+))?\s*/y;
    let rest = text.trim().replace(/^1\s*(?=\/)/, "");
    for (let isFirst = true; rest !== ""; isFirst = false) {
        factors.lastIndex = 0;
        const found = factors.exec(rest);
        const name = found?.[2].replace(/[µμ]/, "u") ?? "";
        if (!found || !Object.hasOwn(UNITS, name) || (!isFirst && found[1] === "")) return undefined;
        const [dimension, decades, number = 1, parts = 0] = UNITS[name];
        const power = Number(found[3] ?? 1) * (found[1] === "/" ? -1 : 1);
        const [above, below] = [number, parts || 1].map((one) => one ** Math.abs(power));
        unit.above *= power < 0 ? below : above;
        unit.below *= power < 0 ? above : below;
        unit.decades += decades * power;
        unit.degrees += parts > 0 ? power : 0;
        dimension.forEach((exponent, i) => (unit.dimension[i] += exponent * power));
        rest = rest.slice(found[0].length);
    }
    return unit;
}

/** Converts a number to coherent units, by the steps of the command. @param {number} value @param {Unit} unit @param {string} length @returns {number} */
function convert(value, unit, length) {
    const decades = unit.decades + (length === "mm" ? 3 : 0) * unit.dimension[0];
    let number = (value * unit.above) / unit.below;
    for (let i = 0; i < Math.abs(unit.degrees); i++) {
        number = unit.degrees > 0 ? (number / 180) * Math.PI : (number / Math.PI) * 180;
    }
    return decades >= 0 ? number * 10 ** decades : number / 10 ** -decades;
}

/**
 * Parses a value such as `30 deg`, `0.3 m` or `12.5`; a bare number is in the unit in which the value is shown.
 * @param {string} text @param {string} unit of a bare number: `deg`, `mm`, `kg` or none @param {string} length unit of the spec
 * @returns {number | undefined} the value in coherent units; `undefined` if it is no finite number or has another dimension
 */
export function parseValue(text, unit, length) {
    const found = /^\s*([-+−]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*?)\s*$/.exec(text);
    const [expected, given] = [parseUnit(unit), parseUnit(found?.[2] || unit)];
    if (!found || !expected || !given || String(expected.dimension) !== String(given.dimension)) return undefined;
    const value = convert(Number(found[1].replace("−", "-")), given, length);
    return Number.isFinite(value) ? value + 0 : undefined;
}

/** Formats a value in the unit in which it is shown, without this unit. @param {number} value @param {string} unit @param {string} length @returns {string} */
export function inUnit(value, unit, length) {
    if (unit === "deg") return trimmed((value * 180) / Math.PI, 4);
    return unit === length ? trimmed(value, length === "m" ? 7 : 4) : short(value);
}

/** Formats a value with its unit and without rounding: parsed again, it is the same. @param {number} value @param {string} unit @returns {string} */
export function exact(value, unit) {
    if (value === 0) return "0";
    if (unit !== "deg") return `${value}${unit.replace(/^1\//, "/")}`;
    const degrees = (value * 180) / Math.PI;
    const same = [Number(degrees.toPrecision(14)), degrees].find((one) => parseValue(String(one), "deg", "m") === value);
    return same === undefined ? `${value}rad` : `${same}deg`;
}
