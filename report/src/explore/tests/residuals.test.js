// Magnifications of the errors of rows.

import assert from "node:assert/strict";
import test from "node:test";

import { residualViews } from "../page/residuals.js";

/** Rows along an axis of 1000 with errors of these lengths. @param {(number | null)[]} before @param {number[]} after */
const rows = (before, after) => after.map((length, i) => ({ line: i + 2, point: [(1000 * i) / (after.length - 1), 0, 0],
    before: before[i] == null ? null : [0, before[i], 0], after: [0, 0, length] }));

test("the 95 % quantile of the vectors is at most a tenth of the diagonal, by a round factor", () => {
    const lengths = Array.from({ length: 101 }, (_, i) => (i + 1) / 100);
    assert.deepEqual(residualViews({ before: null, after: "ΔX", count: 101, rows: rows([], lengths) }),
        [{ kind: "after", name: "ΔX", scale: 100 }]);
});

test("both errors have the same magnification, and those after also their own", () => {
    const all = rows([2, 2, 2], [0.03, 0.03, 0.03]);
    assert.deepEqual(residualViews({ before: "as commanded", after: "corrected", count: 3, rows: all }), [
        { kind: "before", name: "as commanded", scale: 50 }, { kind: "after", name: "corrected", scale: 50 },
        { kind: "after", name: "corrected", scale: 2000 }]);
    const same = rows([2, 2, 2], [2, 2, 2]);
    assert.equal(residualViews({ before: "a", after: "b", count: 3, rows: same }).length, 2);
});

test("without errors, or at one point, the magnification is 1", () => {
    for (const all of [rows([], [0, 0, 0]), rows([], [1, 1]).map((row) => ({ ...row, point: [1, 2, 3] }))]) {
        assert.deepEqual(residualViews({ before: null, after: "ΔX", count: all.length, rows: all }), [{ kind: "after", name: "ΔX", scale: 1 }]);
    }
});
