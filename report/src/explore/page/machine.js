// A machine at a state: the generated code, and errors combined as `abbe analyze` does it.

/**
 * @import { Report, State } from "./state.js"
 */

/**
 * Errors of position (length unit) or orientation (rad): norm per source, Σ of the repeatable, root sum of squares of the
 * random sources, their norms, and the total: the sum of both norms.
 * @typedef {{norms: number[], repeatable: number[], random: number[], repeatableRadius: number, randomRadius: number, radius: number}} Combined
 */

/**
 * Errors at a state. `margin` is cos ρ of Euler angles, 1 for a rotation vector; where it is about 0, the orientation does not
 * exist, and its numbers are NaN.
 * @typedef {object} Errors
 * @property {number[][]} displacements ΔX of each source with its factor, six numbers; of a random source at its bound
 * @property {Combined} position
 * @property {Combined} orientation
 * @property {number[]} displacement Σ of the repeatable sources, six numbers
 * @property {number} margin
 */

/**
 * Errors and poses at a state: ideal, and with the errors of the repeatable sources by the exact chain. Columns are x, y, z
 * axis and position.
 * @typedef {Errors & {pose: number[], realPose: number[]}} Evaluation
 */

/**
 * Functions of the generated code that the page calls.
 * @typedef {object} Generated
 * @property {(q: ArrayLike<number>, s: ArrayLike<number>) => ArrayLike<number>} transforms
 * @property {(q: ArrayLike<number>, s: ArrayLike<number>) => ArrayLike<number>} pose
 * @property {(q: ArrayLike<number>, s: ArrayLike<number>, u: ArrayLike<number>) => ArrayLike<number>} real_pose
 * @property {(q: ArrayLike<number>, s: ArrayLike<number>) => {columns: ArrayLike<number>, margin?: number}} error_jacobian
 * @property {(q: ArrayLike<number>, s: ArrayLike<number>, u: ArrayLike<number>) => ArrayLike<number>} effects
 * @property {(q: ArrayLike<number>, s: ArrayLike<number>, u: ArrayLike<number>) =>
 *     ArrayLike<number> | {displacements: ArrayLike<number>, margin: number}} source_displacements
 */

/** Smallest cos ρ at which rows 4–6 of Euler angles exist. */
export const MINIMUM_MARGIN = 1e-6;

/** @param {ArrayLike<number>} vector @param {number} [first] @returns {number} norm of three entries */
export function norm(vector, first = 0) {
    const [x, y, z] = [vector[first], vector[first + 1], vector[first + 2]];
    return Math.sqrt(x * x + y * y + z * z);
}

/** Returns the product of two poses of twelve numbers. @param {ArrayLike<number>} a @param {ArrayLike<number>} b @returns {number[]} */
export function product(a, b) {
    return Array.from({ length: 12 }, (_, k) => {
        const [row, column] = [k % 3, 3 * Math.floor(k / 3)];
        const turned = a[row] * b[column] + a[3 + row] * b[column + 1] + a[6 + row] * b[column + 2];
        return column === 9 ? turned + a[9 + row] : turned;
    });
}

/**
 * Returns the motion E of six generalized errors: along x, y, z, then about y, z and x.
 * @param {number[]} errors @returns {number[]}
 */
function motion([x, y, z, spin, roll, pitch]) {
    const [s, c] = [Math.sin(spin), Math.cos(spin)];
    const [t, d] = [Math.sin(roll), Math.cos(roll)];
    const [v, e] = [Math.sin(pitch), Math.cos(pitch)];
    return [c * d, t, -s * d, s * v - c * t * e, d * e, c * v + s * t * e, s * e + c * t * v, -d * v, c * e - s * t * v, x, y, z];
}

/** A machine at any state. @typedef {ReturnType<typeof createMachine>} Machine */

/**
 * Joins the generated code and the data of a machine.
 * @param {Generated} generated @param {Report} report
 */
export function createMachine(generated, report) {
    const { sources, effects } = report;
    const isRandom = sources.map((source) => source.class === "random");

    /** Returns the inputs of the code: those of the spec, and the magnitudes of the sources. @param {State} state */
    const inputs = ({ u, factors }) => {
        const all = [...u];
        sources.forEach(({ magnitude, value }, k) => {
            if (magnitude !== null) all[magnitude] = factors[k] * (value ?? 1);
        });
        return all;
    };

    /** Returns six numbers per source, without the factors of the random ones. @param {State} state */
    const displacementsOf = (state) => {
        const result = generated.source_displacements(state.q, state.s, inputs(state));
        return "displacements" in result ? result : { displacements: result, margin: 1 };
    };

    /** @param {number[][]} displacements @param {number} first @returns {Combined} */
    const combine = (displacements, first) => {
        const [repeatable, squares] = [[0, 0, 0], [0, 0, 0]];
        displacements.forEach((row, k) => {
            for (let i = 0; i < 3; i++) {
                if (isRandom[k]) squares[i] += row[first + i] ** 2;
                else repeatable[i] += row[first + i];
            }
        });
        const random = squares.map(Math.sqrt);
        const [repeatableRadius, randomRadius] = [norm(repeatable), Math.sqrt(squares[0] + squares[1] + squares[2])];
        const norms = displacements.map((row) => norm(row, first));
        return { norms, repeatable, random, repeatableRadius, randomRadius, radius: repeatableRadius + randomRadius };
    };

    /** Returns the errors at a state. @param {State} state @returns {Errors} */
    const errors = (state) => {
        const { displacements: flat, margin } = displacementsOf(state);
        const rows = margin >= MINIMUM_MARGIN ? 6 : 3;
        const displacements = state.factors.map((factor, k) => Array.from({ length: 6 }, (_, i) => {
            if (i >= rows) return NaN;
            if (factor === 0) return 0;
            return (isRandom[k] ? factor : 1) * flat[6 * k + i] + 0;
        }));
        const [position, orientation] = [combine(displacements, 0), combine(displacements, 3)];
        return { displacements, position, orientation, displacement: [...position.repeatable, ...orientation.repeatable], margin };
    };

    return {
        errors,

        /** Returns errors and poses at a state. @param {State} state @returns {Evaluation} */
        evaluate(state) {
            const pose = Array.from(generated.pose(state.q, state.s));
            const realPose = Array.from(generated.real_pose(state.q, state.s, inputs(state)));
            return { ...errors(state), pose, realPose };
        },

        /** Returns the total of position (`first` 0) or orientation (3), and nothing else. @param {State} state @param {number} first @returns {number} */
        radius(state, first) {
            const { displacements: flat, margin } = displacementsOf(state);
            if (first === 3 && !(margin >= MINIMUM_MARGIN)) return 0;
            let [x, y, z, squares] = [0, 0, 0, 0];
            for (let k = 0; k < isRandom.length; k++) {
                const [at, factor] = [6 * k + first, state.factors[k]];
                if (factor === 0) continue;
                if (isRandom[k]) squares += factor * factor * (flat[at] ** 2 + flat[at + 1] ** 2 + flat[at + 2] ** 2);
                else [x, y, z] = [x + flat[at], y + flat[at + 1], z + flat[at + 2]];
            }
            return Math.sqrt(x * x + y * y + z * z) + Math.sqrt(squares);
        },

        /** Returns J_e: 6 rows of 6 columns per frame. @param {State} state @returns {number[][]} */
        jacobian({ q, s }) {
            const { columns } = generated.error_jacobian(q, s);
            return Array.from({ length: 6 }, (_, i) =>
                Array.from({ length: columns.length / 6 }, (_, j) => columns[6 * j + i] + 0));
        },

        /**
         * Returns F_0, F_1 … F_n and the tool, of the ideal and the real machine, as poses of twelve numbers. The errors of
         * the real machine, those of its repeatable sources, are magnified; those on a link are as if at its frame.
         * @param {State} state @param {number} magnification @returns {{ideal: number[][], real: number[][]}}
         */
        frames(state, magnification) {
            const errors = report.frames.map(() => [0, 0, 0, 0, 0, 0]);
            const values = generated.effects(state.q, state.s, inputs(state));
            effects.forEach(([source, frame, component], k) => {
                if (!isRandom[source] && state.factors[source] !== 0) errors[frame][component] += magnification * values[k];
            });
            const transforms = generated.transforms(state.q, state.s);
            const start = [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0];
            const [ideal, real] = [[start], [start]];
            for (let i = 0; i <= errors.length; i++) {
                const local = Array.prototype.slice.call(transforms, 12 * i, 12 * i + 12);
                ideal.push(product(ideal[i], local));
                const next = product(real[i], local);
                real.push(i < errors.length ? product(next, motion(errors[i])) : next);
            }
            return { ideal, real };
        },
    };
}
