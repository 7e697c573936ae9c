// The cheapest factors at which the study keeps its tolerance: the convex program of `abbe allocate` without `[allocation]`,
// where a factor x of a source costs 1/x and is at most 1.

import { stateAt } from "./search.js";
import { copyState, factorOf } from "./state.js";
import { worstCase } from "./worst_case.js";

/** @import { Report, State } from "./state.js" @import { Machine } from "./machine.js" @import { Measurand } from "./search.js" */

/** Errors of the sources at a configuration at factor 1, as shares of the tolerance. @typedef {{vectors: number[][], norms: number[]}} Row */

/** Plane that every cheaper choice is beyond: `a·x ≤ 1`, and its multiplier. @typedef {{slopes: number[], multiplier: number}} Cut */

/** Largest numbers of rounds, of cuts that a round adds, and of steps towards the multipliers of the cuts. */
const [ROUNDS, CUTS, STEPS] = [60, 4, 3000];
/** Largest error in the program, as a share of the tolerance, and excess over a cut at which it ends: together less than 1. */
const [TARGET, END] = [1 - 2e-6, 1e-6];

/**
 * Returns the gradient of the largest error at a row by the factors, where those of repeatable sources may be less: their
 * product is that error (Euler). @param {Report} report @param {Row} row @param {number[]} factors
 */
function slopesOf(report, { vectors, norms }, factors) {
    const isSum = report.study.criterion === "rss";
    const isRepeatable = report.sources.map((source) => source.class === "repeatable");
    const hasParts = report.sources.map(({ parts }) => parts.length > 1);
    const half = (/** @type {number} */ k) => vectors[k].map((row) => (factors[k] * row) / 2);
    const all = vectors.map((_, k) => k);
    const repeatable = all.filter((k) => isRepeatable[k]).map(half);
    const center = repeatable.reduce((sum, edge) => sum.map((row, i) => row + edge[i]), [0, 0, 0]);
    const others = isSum ? [] : all.filter((k) => !isRepeatable[k] && !hasParts[k]).map((k) => half(k).map((row) => 2 * row));
    const longest = worstCase(center, [...repeatable, ...others]);
    const length = Math.hypot(...longest) || 1;
    const root = Math.hypot(...all.map((k) => (isRepeatable[k] ? 0 : factors[k] * norms[k]))) || 1;
    return all.map((k) => {
        const along = vectors[k].reduce((sum, row, i) => sum + row * longest[i], 0) / length;
        if (isRepeatable[k]) return Math.max(along, 0);
        return isSum ? (factors[k] * norms[k] ** 2) / root : hasParts[k] ? norms[k] : Math.abs(along);
    });
}

/** @param {number[]} a @param {number[]} b */
const dot = (a, b) => a.reduce((sum, value, k) => sum + value * b[k], 0);

/**
 * Returns the factors of the sources that are switched on, and those of others as they are; `null` where the errors that have
 * no factor exceed the tolerance, or where rows have no orientation.
 * @param {Machine} machine @param {Report} report @param {State} state @param {Measurand} measurand @param {number} tolerance
 * @returns {number[] | null}
 */
export function cheapest(machine, report, state, measurand, tolerance) {
    const first = measurand === "position" ? 0 : 3;
    const whole = { ...copyState(state), factors: state.factors.map((factor) => Number(factor !== 0)) };
    const isFree = report.sources.map(({ follows }, k) => follows === k && state.factors[k] !== 0);
    const rows = report.configurations.q.map((_, index) => {
        const { displacements, [measurand]: { norms } } = machine.errors(stateAt(report, whole, index));
        const vectors = displacements.map((one) => one.slice(first, first + 3).map((row) => row / tolerance));
        return { vectors, norms: norms.map((norm) => norm / tolerance) };
    });
    if (rows.some(({ norms }) => norms.some(Number.isNaN))) return null;
    /** Factors that apply to the sources. @param {number[]} factors */
    const applied = (factors) => report.sources.map((_, k) => factorOf(report, { ...whole, factors }, k));
    /** Largest error at a row, or more if that is less than 1, and the slopes by each factor. @param {Row} row @param {number[]} all */
    const errorAt = (row, all) => {
        const bound = dot(row.norms, all);
        const slopes = bound < 1 ? [] : slopesOf(report, row, all);
        return { slopes, total: bound < 1 ? bound : dot(slopes, all) };
    };
    const largest = (/** @type {number[]} */ all) => rows.map((row) => errorAt(row, all)).sort((a, b) => b.total - a.total);
    if (largest(applied(isFree.map(() => 0)))[0].total >= TARGET) return null;
    /** @type {Cut[]} */
    const cuts = [];
    let factors = whole.factors;
    for (let round = 0; round < ROUNDS; round++) {
        const all = applied(factors);
        const worst = largest(all).slice(0, CUTS).filter(({ total }) => total > 1);
        if (worst.length === 0) return state.factors.map((factor, k) => (isFree[k] ? factors[k] : factor));
        for (const { slopes } of worst) {
            const own = factors.map(() => 0);
            let rest = TARGET;
            slopes.forEach((slope, k) => {
                const { follows } = report.sources[k];
                if (follows !== null && isFree[follows]) own[follows] += slope;
                else rest -= slope * all[k];
            });
            cuts.push({ slopes: own.map((slope) => slope / rest), multiplier: 1 });
        }
        factors = solved(cuts, factors, isFree);
    }
    return null;
}

/**
 * Minimizes Σ 1/x over `a·x ≤ 1` and x ≤ 1: x = 1/√(λᵀa), or 1, while each multiplier λ grows with the square of its a·x.
 * @param {Cut[]} cuts @param {number[]} before @param {boolean[]} isFree
 */
function solved(cuts, before, isFree) {
    for (let step = 0; ; step++) {
        const forces = before.map((_, k) => cuts.reduce((sum, { slopes, multiplier }) => sum + multiplier * slopes[k], 0));
        const factors = before.map((factor, k) => (isFree[k] ? 1 / Math.sqrt(Math.max(forces[k], 1)) : factor));
        let excess = 0;
        for (const cut of cuts) {
            const total = dot(cut.slopes, factors);
            excess = Math.max(excess, total > 1 ? total - 1 : cut.multiplier * (1 - total));
            cut.multiplier *= total * total;
        }
        if (excess < END || step === STEPS) return factors;
    }
}
