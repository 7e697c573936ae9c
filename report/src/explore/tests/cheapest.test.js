import assert from "node:assert/strict";
import test from "node:test";

import { cheapest } from "../page/cheapest.js";
import { cloud } from "../page/search.js";
import { initialState } from "../page/state.js";
import { SHIPPED, abbe, explored } from "./support.js";

for (const name of SHIPPED) {
    test(`${name}: the cheapest factors keep the tolerance, and no other ones that do cost less`, () => {
        const { report, machine } = explored(name);
        if (report.has_loops || report.sources.length === 0) return;
        const state = initialState(report);
        const own = cloud(machine, report, state).position.radius;
        for (const part of [0.4, 1.1]) {
            const found = cheapest(machine, report, state, "position", part * own);
            const { radius } = cloud(machine, report, { ...state, factors: found }).position;
            assert.ok(radius <= part * own, `${radius} > ${part * own}`);
            assert.ok(found.every((factor) => factor >= 0 && factor <= 1), String(found));
            if (part > 1) {
                assert.deepEqual(found, state.factors);
                continue;
            }
            // The page may have fewer configurations than the study.
            const answer = JSON.parse(abbe("allocate", name, "--tolerance", `${part * own} ${report.length}`, "--json"));
            if (answer.configurations !== report.configurations.q.length) continue;
            const factors = answer.sources.map(({ source }) => found[report.sources.findIndex((one) => one.name === source)]);
            const cost = factors.reduce((sum, factor) => sum + 1 / factor, 0);
            assert.ok(Math.abs(cost / answer.cost - 1) < 1e-5, `${cost}, not ${answer.cost}`);
            answer.sources.forEach(({ source, factor }, i) => assert.ok(Math.abs(factors[i] / factor - 1) < 5e-3, `${source}: ${factors[i]}, not ${factor}`));
        }
    });
}

test("a source that is switched off stays so, and the others cost less", () => {
    const { report, machine } = explored("pps");
    const state = initialState(report);
    const all = cheapest(machine, report, state, "position", report.study.tolerance);
    state.factors[0] = 0;
    const others = cheapest(machine, report, state, "position", report.study.tolerance);
    assert.equal(others[0], 0);
    const cost = (factors) => factors.reduce((sum, factor) => sum + (factor > 0 ? 1 / factor : 0), 0);
    assert.ok(cost(others) < cost(all) - 1 / all[0]);
});
