// The tool point at the pointer: joints that take it there in the plane of the picture.

import { jointEnds } from "./controls.js";
import { replaced } from "./search.js";
/** @import { Report } from "./state.js" */

/** Largest number of steps, pixels that are near enough, and part of a joint's range for differences and for a step. */
const [MOST_STEPS, NEAR, DIFFERENCE, LARGEST_STEP] = [20, 0.1, 1e-6, 0.05];
/** Smallest part of a step that is tried, and damping as part of the squared length of the Jacobian. */
const [SMALLEST_PART, DAMPING] = [1 / 32, 1e-4];

/**
 * Returns joints within their limits, with which the picture of the tool point is at a target, or as near to it as steps from
 * `q` come: Δq = W Cᵀ (C Cᵀ + λ)⁻¹ Δ with the ranges W of the joints and the differences C = J W, which is the least motion.
 * @param {Report} report @param {number[]} q @param {(q: number[]) => number[]} place in pixels; NaN where there is none
 * @param {number[]} target @returns {number[]}
 */
export function followed(report, q, place, target) {
    const ends = q.map((_, i) => jointEnds(report, i));
    const away = (/** @type {number[]} */ [x, y]) => Math.hypot(target[0] - x, target[1] - y);
    let [best, at] = [q, place(q)];
    for (let step = 0; step < MOST_STEPS && away(at) > NEAR; step++) {
        const columns = best.map((value, i) => {
            const part = value === ends[i][1] ? -DIFFERENCE : DIFFERENCE;
            const moved = place(replaced(best, i, value + part * (ends[i][1] - ends[i][0])));
            return [0, 1].map((row) => (moved[row] - at[row]) / part || 0);
        });
        // Joints at an end that would go beyond it are held.
        const held = new Set(columns.flatMap(([x, y], i) => (x === 0 && y === 0 ? [i] : [])));
        let parts = /** @type {number[]} */ ([]);
        for (let size = -1; size !== held.size;) {
            size = held.size;
            parts = leastMotion(columns.map((column, i) => (held.has(i) ? [0, 0] : column)), [target[0] - at[0], target[1] - at[1]]);
            parts.forEach((part, i) => { if (best[i] === ends[i][part < 0 ? 0 : 1] && part !== 0) held.add(i); });
        }
        const scale = Math.min(1, LARGEST_STEP / Math.max(...parts.map(Math.abs)));
        let next = best;
        for (let share = 1; next === best && share >= SMALLEST_PART; share /= 2) {
            const trial = best.map((value, i) => Math.min(ends[i][1], Math.max(ends[i][0], value + share * scale * parts[i] * (ends[i][1] - ends[i][0]))));
            if (away(place(trial)) < away(at)) next = trial;
        }
        if (next === best) break;
        [best, at] = [next, place(next)];
    }
    return best;
}

/** Returns Cᵀ (C Cᵀ + λ)⁻¹ Δ. @param {number[][]} columns of C @param {number[]} delta */
function leastMotion(columns, [x, y]) {
    const sum = (/** @type {number} */ i, /** @type {number} */ j) => columns.reduce((all, column) => all + column[i] * column[j], 0);
    const damping = DAMPING * (sum(0, 0) + sum(1, 1)) || 1;
    const [a, b, c] = [sum(0, 0) + damping, sum(0, 1), sum(1, 1) + damping];
    const determinant = a * c - b * b;
    const [u, v] = [(c * x - b * y) / determinant, (a * y - b * x) / determinant];
    return columns.map((column) => column[0] * u + column[1] * v);
}
