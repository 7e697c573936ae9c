// A machine at a state: its generated code, and errors combined as `abbe analyze` does it.

import { steady } from "./number.js";
import { factorOf } from "./state.js";
import { largestNorm, worstCase } from "./worst_case.js";

/** @import { Report, State } from "./state.js" */

/**
 * Errors of position (length unit) or orientation (rad): norm of each source and its signed share of the total, Σ of the
 * repeatable sources, vectors of the others, sum of the largest norms of errors with several parts, root sum of squares by rows and of norms, and the norm of the former sum. The total is the worst case over all signs, or the sum of both norms if
 * the study is judged by root sum of squares; the others have the rest of it.
 * @typedef {{norms: number[], shares: number[], repeatable: number[], unknown: number[][], ofParts: number,
 *     random: number[], randomNorm: number, repeatableRadius: number, randomRadius: number,
 *     radius: number}} Combined
 */

/**
 * Errors at a state: ΔX of each source with its factor, of a random one at its bound, and of the repeatable ones
 * together, six numbers each. `margin` is cos ρ of Euler angles, or 1; where it is about 0 there is no orientation, and
 * its numbers are NaN.
 * @typedef {{displacements: number[][], position: Combined, orientation: Combined, displacement: number[],
 *     margin: number}} Errors
 */

/**
 * Errors at a state, the ideal pose, and that of the exact chain with the repeatable sources: x, y, z axis and position.
 * @typedef {Errors & {pose: number[], realPose: number[]}} Evaluation
 */

/** @typedef {ArrayLike<number>} Numbers */

/**
 * Functions of the generated code; those of sources exist only if there are sources.
 * @typedef {{transforms: (q: Numbers, s: Numbers) => Numbers, pose: (q: Numbers, s: Numbers) => Numbers,
 *     error_jacobian: (q: Numbers, s: Numbers) => {columns: Numbers}, real_pose?: (q: Numbers, s: Numbers, u: Numbers) => Numbers,
 *     effects?: (q: Numbers, s: Numbers, u: Numbers) => Numbers,
 *     source_displacements?: (q: Numbers, s: Numbers, u: Numbers) => Numbers | {displacements: Numbers, margin: number}}} Generated
 */

/** Smallest cos ρ at which the orientation exists. */
const MINIMUM_MARGIN = 1e-6;

/** Returns the product of two poses. @param {Numbers} a @param {Numbers} b @returns {number[]} */
function product(a, b) {
    return Array.from({ length: 12 }, (_, k) => {
        const [row, from] = [k % 3, k - (k % 3)];
        return a[row] * b[from] + a[3 + row] * b[from + 1] + a[6 + row] * b[from + 2] + (from === 9 ? a[9 + row] : 0);
    });
}

/** Returns E of six generalized errors: along x, y, z, then about y, z, x. @param {number[]} errors @returns {number[]} */
function motion([x, y, z, ...angles]) {
    const [[s, t, v], [c, d, e]] = [angles.map(Math.sin), angles.map(Math.cos)];
    const columns = [c * d, t, -s * d, s * v - c * t * e, d * e, c * v + s * t * e, s * e + c * t * v, -d * v, c * e - s * t * v];
    return [...columns, x, y, z];
}

/** @param {number[]} vector @returns {number} */
const norm = ([x, y, z]) => Math.sqrt(x * x + y * y + z * z);

/** A machine at any state. @typedef {ReturnType<typeof createMachine>} Machine */

/** Joins the generated code and the data of a machine. @param {Generated} generated @param {Report} report */
export function createMachine(generated, report) {
    const { real_pose = generated.pose, effects: effectsOf = () => [], source_displacements = () => [] } = generated;
    const isRandom = report.sources.map((source) => source.class !== "repeatable");

    /** Returns whether an error has several parts, and any direction. @param {number} k */
    const hasParts = (k) => report.sources[k].parts.length > 1;

    /** Returns the inputs of the code: those of the spec, then the magnitudes of sources. @param {State} state */
    const inputs = (state) => {
        const all = [...state.u];
        report.sources.forEach(({ magnitude, value }, k) => {
            if (magnitude !== null) all[magnitude] = factorOf(report, state, k) * value;
        });
        return all;
    };

    /** Returns what multiplies the numbers that the code returns for a source. @param {State} state @param {number} k */
    const sizeOf = (state, k) => {
        const factor = factorOf(report, state, k);
        return isRandom[k] ? factor * report.sources[k].bound : Number(factor !== 0);
    };

    /** @param {number[][]} displacements @param {number[][][]} parts of each source @param {number} first of three rows @returns {Combined} */
    const combine = (displacements, parts, first) => {
        const [repeatable, squares] = [[0, 0, 0], [0, 0, 0]];
        const unknown = /** @type {number[][]} */ ([]);
        let ofParts = 0;
        let square = 0;
        const lengths = displacements.map((displacement, k) => {
            const rows = displacement.slice(first, first + 3);
            const length = hasParts(k) ? largestNorm(parts[k].map((part) => part.slice(first, first + 3))) : norm(rows);
            if (hasParts(k)) ofParts += length;
            else if (isRandom[k]) unknown.push(rows);
            if (isRandom[k]) square += length * length;
            rows.forEach((row, i) => (isRandom[k] ? (squares[i] += row * row) : (repeatable[i] += row)));
            return length;
        });
        const random = squares.map(Math.sqrt);
        const [own, root] = [norm(repeatable), Math.sqrt(square)];
        const isSum = report.study.criterion === "rss";
        const longest = isSum ? repeatable : worstCase(repeatable, unknown);
        const total = isSum ? own + root : norm(longest) + ofParts;
        const along = (/** @type {number[]} */ rows) => (longest[0] * rows[0] + longest[1] * rows[1] + longest[2] * rows[2]) / norm(longest);
        const shares = displacements.map((displacement, k) => {
            const rows = displacement.slice(first, first + 3);
            const part = !isRandom[k] ? along(rows) : isSum ? lengths[k] ** 2 / root : hasParts(k) ? lengths[k] : Math.abs(along(rows));
            return (part || 0) / total || 0;
        });
        const [all, one, other] = [total, own, total - own].map(steady);
        return { norms: lengths.map(steady), shares, repeatable, unknown, ofParts, random, randomNorm: root, repeatableRadius: one, randomRadius: other, radius: all };
    };

    /**
     * Returns the total with another factor of a source, relative to its size now.
     * @param {Combined} errors @param {number} k @param {number[]} rows of the source @param {number} factor
     */
    const rescaled = ({ norms, repeatable, unknown, ofParts, randomNorm }, k, rows, factor) => {
        const sum = isRandom[k] ? repeatable : repeatable.map((row, i) => row + (factor - 1) * rows[i]);
        const square = isRandom[k] ? (factor * factor - 1) * norms[k] ** 2 : 0;
        if (report.study.criterion === "rss") return norm(sum) + Math.sqrt(Math.max(0, randomNorm ** 2 + square));
        if (hasParts(k)) return norm(worstCase(sum, unknown)) + ofParts + (factor - 1) * norms[k];
        const at = isRandom[k] ? unknown.findIndex((vector) => vector.every((row, i) => row === rows[i])) : -1;
        const others = at < 0 ? unknown : unknown.map((vector, i) => (i === at ? vector.map((row) => factor * row) : vector));
        return norm(worstCase(sum, others)) + ofParts;
    };

    /** @param {State} state @returns {Errors} */
    const errors = (state) => {
        const result = source_displacements(state.q, state.s, inputs(state));
        const { displacements: flat, margin } = "margin" in result ? result : { displacements: result, margin: 1 };
        const rows = margin >= MINIMUM_MARGIN ? 6 : 3;
        const parts = report.sources.map((source, k) => {
            const size = sizeOf(state, k);
            return source.parts.map((part) => [0, 1, 2, 3, 4, 5].map((i) => (i >= rows ? NaN : size === 0 ? 0 : size * flat[6 * part + i])));
        });
        const displacements = parts.map((own) => (own.length === 1 ? own[0] : own[0].map((_, i) => Math.hypot(...own.map((part) => part[i])))));
        const [position, orientation] = [combine(displacements, parts, 0), combine(displacements, parts, 3)];
        const displacement = [...position.repeatable, ...orientation.repeatable];
        return { displacements, position, orientation, displacement, margin };
    };

    /** Returns the errors of the report's effects, of a random source at its bound. @param {State} state @returns {number[]} */
    const effects = (state) => {
        const [values, sizes] = [effectsOf(state.q, state.s, inputs(state)), report.sources.map((_, k) => sizeOf(state, k))];
        return report.effects.map(([source], k) => (sizes[source] === 0 ? 0 : sizes[source] * values[k]));
    };

    return {
        rescaled,
        errors,
        effects,

        /** Returns the errors and poses at a state. @param {State} state @returns {Evaluation} */
        evaluate: (state) => ({
            ...errors(state),
            pose: Array.from(generated.pose(state.q, state.s)),
            realPose: Array.from(real_pose(state.q, state.s, inputs(state))),
        }),

        /** Returns J_e: six rows, and six columns per frame. @param {State} state @returns {number[][]} */
        jacobian: ({ q, s }) => {
            const columns = Array.from(generated.error_jacobian(q, s).columns);
            return Array.from({ length: 6 }, (_, row) => columns.filter((_, k) => k % 6 === row));
        },

        /**
         * Returns the poses of F_0, F_1 … F_n and the tool, of the ideal machine, and of the real one with the errors of its
         * repeatable sources magnified. Errors elsewhere on a link are shown by their first-order effect at its frame. The
         * real one is empty for closed loops, which magnified errors would open.
         * @param {State} state @param {number} magnification @returns {{ideal: number[][], real: number[][]}}
         */
        frames: (state, magnification) => {
            const errors = report.frames.map(() => [0, 0, 0, 0, 0, 0]);
            const values = effects(state);
            report.effects.forEach(([source, frame, component], k) => {
                if (!isRandom[source]) errors[frame][component] += magnification * values[k];
            });
            const transforms = Array.from(generated.transforms(state.q, state.s));
            const poses = [false, true].map((isReal) => {
                const all = [[1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0]];
                for (let i = 0; i <= errors.length; i++) {
                    const next = product(all[report.links[i][0]], transforms.slice(12 * i, 12 * i + 12));
                    all.push(isReal && i < errors.length ? product(next, motion(errors[i])) : next);
                }
                return all;
            });
            return { ideal: poses[0], real: report.has_loops ? [] : poses[1] };
        },
    };
}
