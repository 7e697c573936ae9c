// Numbers for people, as the command prints them, and values with units, as it parses them.

/**
 * Formats by `toFixed` or `toExponential`, but rounds exact halves to even, as the command does.
 * @param {number} value @param {number} decimals @param {"toFixed" | "toExponential"} method @returns {string}
 */
function rounded(value, decimals, method) {
    const [number, power = ""] = value[method](decimals + 1).split(/(?=e)/);
    const places = decimals + 1 - Number(power.slice(1));
    const isExact = places >= 0 ? Number.isInteger(value * 2 ** places) : value % 10 ** -places === 0;
    const down = number.slice(0, -1).replace(/\.$/, "");
    const isDown = number.endsWith("5") && isExact && Number(down.at(-1)) % 2 === 0;
    return (isDown ? down + power : value[method](decimals)).replace("+", "");
}

/**
 * Formats a number with a fixed number of decimals; zero as `0`, from 1e7 in powers of ten.
 * @param {number} value @param {number} decimals @returns {string}
 */
export function fixed(value, decimals) {
    if (value === 0) return "0";
    if (!Number.isFinite(value)) return String(value).replace("Infinity", "∞");
    if (Math.abs(value) >= 1e7) return rounded(value, 3, "toExponential");
    const text = rounded(value, decimals, "toFixed");
    return /[1-9]/.test(text) ? text : text.replace("-", "");
}

/** Formats a number with at most so many decimals. @param {number} value @param {number} decimals @returns {string} */
export function trimmed(value, decimals) {
    const text = fixed(value, decimals);
    return text.includes(".") && !text.includes("e") ? text.replace(/\.?0+$/, "") : text;
}

/** Formats a number to seven significant digits. @param {number} value @returns {string} */
export function short(value) {
    if (!Number.isFinite(value)) return fixed(value, 0);
    const seven = Number(rounded(value, 6, "toExponential")) + 0;
    const isPlain = seven === 0 || (Math.abs(seven) >= 1e-5 && Math.abs(seven) < 1e7);
    return isPlain ? String(seven) : seven.toExponential().replace("+", "");
}

/** Formats a number to so many significant digits. @param {number} value @param {number} count @returns {string} */
export const digits = (value, count) => short(Number(rounded(value, count - 1, "toExponential")));

/** Returns how many decimals show so many digits of a number, at most 12. @param {number} value @param {number} count */
export function decimals(value, count) {
    const first = value > 0 ? Math.floor(Math.log10(value)) : 0;
    return Math.min(Math.max(count - 1 - first, 0), 12);
}

/** Formats a number with so many decimals, rounded down. @param {number} value @param {number} decimals @returns {string} */
export function roundedDown(value, decimals) {
    const nearest = fixed(value, decimals);
    return Number(nearest) > value ? fixed(value - 0.1 ** decimals, decimals) : nearest;
}

/** Formats the ratio of two numbers in whole percent. @param {number} value @param {number} of @returns {string} */
export const percent = (value, of) => `${rounded(value === 0 ? 0 : (100 * value) / of, 0, "toFixed")} %`;

/** Rounds to 13 digits, so that the last bits do not decide how a half is rounded. @param {number} value @returns {number} */
export const steady = (value) => Number(value.toPrecision(13));

/** Formats a number with its unit, if it has one. @param {number} value @param {string} unit @returns {string} */
export const quantity = (value, unit) => `${short(value)} ${unit}`.trimEnd();

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
 * Converts a number with a unit such as `mm^2/s` to coherent units, by the steps of the command.
 * @param {number} number @param {string} unit @param {string} length @returns {{value: number, dimension: string} | undefined}
 */
function convert(number, unit, length) {
    const dimension = [0, 0, 0, 0];
    let [above, below, decades, degrees] = [1, 1, 0, 0];
    const factors = `*${unit}`.replace(/\s/g, "").replace(/^\*(?=$|[*/])|^\*1(?=\/)/, "").replace(/[µμ]/g, "u");
    for (const factor of factors.split(/(?=[*/])/).filter((factor) => factor !== "")) {
        const [, sign, name, exponent = "1"] = /^([*/])([a-z%°]+)(?:\^(-?\d+))?$/i.exec(factor) ?? [];
        if (!Object.hasOwn(UNITS, name ?? "")) return undefined;
        const [exponents, ten, times = 1, parts = 0] = UNITS[name];
        const power = Number(exponent) * (sign === "/" ? -1 : 1);
        const [one, other] = [times, parts || 1].map((ratio) => ratio ** Math.abs(power));
        [above, below] = power < 0 ? [above * other, below * one] : [above * one, below * other];
        [decades, degrees] = [decades + ten * power, degrees + (parts > 0 ? power : 0)];
        exponents.forEach((exponent, i) => (dimension[i] += exponent * power));
    }
    decades += (length === "mm" ? 3 : 0) * dimension[0];
    let value = (number * above) / below;
    for (let i = 0; i < Math.abs(degrees); i++) value = degrees > 0 ? (value / 180) * Math.PI : (value / Math.PI) * 180;
    return { value: decades >= 0 ? value * 10 ** decades : value / 10 ** -decades, dimension: String(dimension) };
}

/**
 * Parses a value such as `30 deg`, `0.3 m` or `12.5`; a bare number is in the given unit, in which the value is shown.
 * @param {string} text @param {string} unit such as `deg`, `mm`, `kg` or none @param {string} length unit of the spec
 * @returns {number | undefined} value in coherent units; `undefined` if it is no finite number or has another dimension
 */
export function parseValue(text, unit, length) {
    const [, number, given] = /^\s*([-+−]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)\s*(.*?)\s*$/i.exec(text) ?? [];
    const parsed = convert(Number(number?.replace("−", "-")), given || unit, length);
    const isOfUnit = parsed?.dimension === convert(1, unit, length)?.dimension;
    return parsed && isOfUnit && Number.isFinite(parsed.value) ? parsed.value + 0 : undefined;
}

/**
 * Formats a value in the unit in which it is shown, without this unit.
 * @param {number} value @param {string} unit @param {string} length @returns {string}
 */
export function inUnit(value, unit, length) {
    if (unit === "deg") return trimmed((value * 180) / Math.PI, 4);
    return unit === length ? trimmed(value, length === "m" ? 7 : 4) : short(value);
}

/**
 * Formats a value with its unit and all digits: parsed again, here or by the command, it is the same.
 * @param {number} value @param {string} unit @returns {string}
 */
export function exact(value, unit) {
    if (value === 0) return "0";
    if (unit !== "deg") return `${value}${unit.replace(/^1\//, "/")}`;
    const degrees = (value * 180) / Math.PI;
    const same = [Number(degrees.toPrecision(14)), degrees].find((one) => parseValue(`${one}`, "deg", "m") === value);
    return same === undefined ? `${value}rad` : `${same}deg`;
}
