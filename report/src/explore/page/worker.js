// The search of the worst case in a worker made of the page's own scripts, or in slices where none can run.

import { createMachine } from "./machine.js";
import { worst } from "./search.js";

/** @import { Report, State } from "./state.js" @import { Generated } from "./machine.js" @import { Options, Worst } from "./search.js" */

/** @typedef {{report: Report, index: number, state: State, options: Options}} Task of the machine with this index */

/** Returns the functions of a machine of the page. @param {number} index @returns {Generated} */
export function generatedCode(index) {
    return /** @type {{abbeMachines: Generated[]}} */ (/** @type {unknown} */ (globalThis)).abbeMachines[index];
}

/** Starts the search of a task. @param {Task} task @returns {Generator<number, Worst, void>} */
const start = ({ report, index, state, options }) =>
    worst(createMachine(generatedCode(index), report), report, state, options);

/** Answers a task, in a worker. @param {{postMessage: (message: object) => void, onmessage: unknown}} scope */
export function serve(scope) {
    scope.onmessage = (/** @type {MessageEvent<Task>} */ { data }) => {
        for (const search = start(data); ; ) {
            const { done, value } = search.next();
            scope.postMessage(done ? { result: value } : { part: value });
            if (done) return;
        }
    };
}

/** @param {Task} task @param {(part: number) => void} progress @param {AbortSignal} signal @returns {Promise<Worst>} */
async function inSlices(task, progress, signal) {
    for (const search = start(task); ; ) {
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
