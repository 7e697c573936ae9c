// The search of the worst case beside the page: in a worker made of the page's own scripts, or in slices where none can run.

import { createMachine } from "./machine.js";
import { worst } from "./search.js";

/**
 * @import { Report, State } from "./state.js"
 * @import { Generated } from "./machine.js"
 * @import { Options, Worst } from "./search.js"
 */

/** @typedef {{report: Report, index: number, state: State, options: Options}} Task of the machine with this index */

/** Milliseconds between reports of progress, after which drawing and input have their turn. */
const SLICE = 12;

/** Returns the functions of a machine of the page. @param {number} index @returns {Generated} */
export function generatedCode(index) {
    return /** @type {{abbeMachines: Generated[]}} */ (/** @type {unknown} */ (globalThis)).abbeMachines[index];
}

/**
 * Runs a task; yields the part that is done after each slice.
 * @param {Task} task @returns {Generator<number, Worst, void>}
 */
function* run({ report, index, state, options }) {
    const search = worst(createMachine(generatedCode(index), report), report, state, options);
    for (let end = performance.now() + SLICE; ; ) {
        const { done, value } = search.next();
        if (done) return value;
        if (performance.now() < end) continue;
        yield value;
        end = performance.now() + SLICE;
    }
}

/** Answers a task, in a worker. @param {{postMessage: (message: object) => void, onmessage: unknown}} scope */
export function serve(scope) {
    scope.onmessage = (/** @type {MessageEvent<Task>} */ { data }) => {
        const search = run(data);
        for (;;) {
            const { done, value } = search.next();
            scope.postMessage(done ? { result: value } : { part: value });
            if (done) return;
        }
    };
}

/** @param {Task} task @param {(part: number) => void} progress @param {AbortSignal} signal @returns {Promise<Worst>} */
async function inSlices(task, progress, signal) {
    const search = run(task);
    for (;;) {
        signal.throwIfAborted();
        const { done, value } = search.next();
        if (done) return value;
        progress(value);
        await new Promise((resolve) => setTimeout(resolve));
    }
}

/**
 * Searches the worst case without blocking the page; the promise is rejected if the signal aborts.
 * @param {Task} task @param {(part: number) => void} progress @param {AbortSignal} signal @returns {Promise<Worst>}
 */
export async function searchWorst(task, progress, signal) {
    const scripts = [...document.scripts].filter(({ type }) => type === "");
    const address = URL.createObjectURL(new Blob(scripts.map(({ text }) => `${text}\n`), { type: "text/javascript" }));
    /** @type {Worker | undefined} */
    let worker;
    try {
        const started = (worker = new Worker(address));
        return await new Promise((resolve, reject) => {
            signal.addEventListener("abort", () => reject(signal.reason));
            started.onmessage = ({ data: { part, result } }) => (result ? resolve(result) : progress(part));
            started.onerror = reject;
            started.postMessage({ ...task, report: { ...task.report, code: "" } });
        });
    } catch {
        // The worker could not be made, or a policy forbids it.
        return await inSlices(task, progress, signal);
    } finally {
        worker?.terminate();
        URL.revokeObjectURL(address);
    }
}
