import assert from "node:assert/strict";
import test from "node:test";

import { worst } from "../page/search.js";
import { searchWorst, serve } from "../page/worker.js";
import { initialState } from "../page/state.js";
import { explored } from "./support.js";

const { report, generated, machine } = explored("pps");
const task = { report, index: 1, state: initialState(report), options: { samples: 3000 } };
globalThis.abbeMachines = [undefined, generated];

function expected() {
    const search = worst(machine, report, task.state, task.options);
    for (;;) {
        const { done, value } = search.next();
        if (done) return value;
    }
}

test("a worker answers with the result of the search", () => {
    const messages = [];
    const scope = { postMessage: (message) => messages.push(structuredClone(message)), onmessage: undefined };
    serve(scope);
    scope.onmessage({ data: structuredClone({ ...task, report: { ...report, code: "" } }) });
    assert.deepEqual(messages.at(-1), { result: expected() });
    assert.ok(messages.slice(0, -1).every(({ part }) => part >= 0 && part <= 1));
});

test("without workers the search runs in slices, and can be cancelled", async () => {
    globalThis.document = { scripts: [] };
    const parts = [];
    assert.deepEqual(await searchWorst(task, (part) => parts.push(part), new AbortController().signal), expected());
    const long = { ...task, options: { samples: 1e9 } };
    const controller = new AbortController();
    await assert.rejects(searchWorst(long, () => controller.abort(), controller.signal), { name: "AbortError" });
});
