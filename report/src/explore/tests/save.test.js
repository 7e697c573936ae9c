// Tables that are saved.

import assert from "node:assert/strict";
import test from "node:test";

import { sourceTable } from "../page/save.js";

test("a name in a table is no formula, and one cell", () => {
    const names = ["=1+1", "+a", "-a", "@a", " =a", "'=a", "＝a", 'a "b", c', "a;b"];
    const sources = names.map((name, k) => ({ name, class: "repeatable", at: "", enabled: true, follows: k }));
    const panel = { report: { sources }, state: { factors: names.map(() => 1) }, measurand: "position", unit: { symbol: "um", factor: 1e3 },
        figures: { position: { norms: names.map(() => -2e-3), shares: names.map(() => -0.5) } } };
    const [heading, ...rows] = sourceTable(panel).trimEnd().split("\n");
    assert.equal(heading, "source,class,at,position error (um),share,factor");
    assert.deepEqual(rows.map((row) => row.replace(",repeatable,,-2,-0.5,1", "")),
        ["'=1+1", "'+a", "'-a", "'@a", "' =a", "''=a", "'＝a", '"a ""b"", c"', '"a;b"']);
});
