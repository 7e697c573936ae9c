import assert from "node:assert/strict";
import test from "node:test";

import { jointEnds } from "../page/controls.js";
import { followed } from "../page/drag.js";
import { SHIPPED, explored, randomNumbers, randomState } from "./support.js";

/** Directions to the right and down in F_0, so that the picture is seen along no axis. */
const [RIGHT, DOWN] = [[0.62, -0.78, 0.05], [0.32, 0.31, -0.9]];

for (const name of SHIPPED) {
    test(`${name}: the tool point follows the pointer, and joints stay within their limits`, () => {
        const { report, generated } = explored(name);
        const random = randomNumbers(4);
        const ends = report.variables.map((_, i) => jointEnds(report, i));
        const size = report.length === "m" ? 1 : 1000;
        const { s } = randomState(report, random);
        const place = (q) => {
            const point = Array.from(generated.pose(q, s)).slice(9);
            return [RIGHT, DOWN].map((axis) => (400 / size) * axis.reduce((sum, part, i) => sum + part * point[i], 0));
        };
        const away = ([x, y], [u, v]) => Math.hypot(x - u, y - v);
        let [tried, reached] = [0, 0];
        for (let i = 0; i < 200; i++) {
            const q = randomState(report, random).q;
            // Where a little motion of the joints would take it, and a place that may be out of reach.
            const moved = q.map((value, j) => Math.min(ends[j][1], Math.max(ends[j][0], value + 0.04 * (random() - 0.5) * (ends[j][1] - ends[j][0]))));
            const anywhere = [1200, 1200].map((length) => length * (random() - 0.5));
            for (const [target, isReached] of [[place(moved), true], [anywhere, false]]) {
                const found = followed(report, q, place, target);
                found.forEach((value, j) => assert.ok(value >= ends[j][0] && value <= ends[j][1], `${report.variables[j].name} = ${value}`));
                const [before, after] = [q, found].map((joints) => away(place(joints), target));
                assert.ok(Number.isFinite(after) ? after <= before : Number.isNaN(before), `${before} became ${after}`);
                // A loop that does not close has no tool point.
                if (isReached && Number.isFinite(before)) [tried, reached] = [tried + 1, reached + Number(after <= 0.1)];
            }
        }
        assert.ok(tried >= 40, `${tried} closed`);
        assert.equal(reached, tried);
    });
}
