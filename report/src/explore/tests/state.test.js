import assert from "node:assert/strict";
import test from "node:test";

import { decodeState, encodeState, initialState } from "../page/state.js";
import { SHIPPED, explored, otherSpecs, randomNumbers, randomState } from "./support.js";

test("a state survives the address", () => {
    for (const name of [...SHIPPED, ...otherSpecs()]) {
        const { report } = explored(name);
        assert.equal(encodeState(report, initialState(report)), "", name);
        assert.deepEqual(decodeState(report, ""), initialState(report));
        const random = randomNumbers(2);
        for (let i = 0; i < 100; i++) {
            const state = randomState(report, random);
            const address = new URL(`#${encodeState(report, state)}&${encodeState(report, initialState(report), "2.")}`, "file:///page.html");
            assert.deepEqual(decodeState(report, address.hash), state, address.hash);
            assert.deepEqual(decodeState(report, address.hash, "2."), initialState(report));
        }
    }
});

test("an address is short, and bad parts of it are ignored", () => {
    const { report } = explored("pps");
    const initial = initialState(report);
    const state = decodeState(report, "#q=9,80,987,70deg,0,0&patient=70 kg&x=0.25m&factor.assembly=0.5");
    assert.deepEqual(state, {
        ...initial,
        q: [9, 80, 987, (70 / 180) * Math.PI, 0, 0],
        s: initial.s.map((value, i) => (report.parameters[i].name === "x" ? 250 : value)),
        u: [70, ...initial.u.slice(1)],
        factors: initial.factors.map((factor, k) => (report.sources[k].name === "assembly" ? 0.5 : factor)),
    });
    assert.equal(encodeState(report, state), "q=9mm,80mm,987mm,70deg,0,0&x=250mm&patient=70kg&factor.assembly=0.5");
    const bad = ["q=1,2", "q=a,b,c,d,e,f", "q=,,,,,", "q=1e9,-1,9e9,91deg,4deg,1rad", "patient=-1kg", "patient=137kg", "patient=1mm", "factor.assembly=4",
        "factor.assembly=-1", "factor.nothing=2", "__proto__=1", "nothing", "%E0%A4%A", "q=NaN,Infinity,1e999,0x10,1_0,[]"];
    for (const text of bad) assert.deepEqual(decodeState(report, `#${text}`), initial, text);
    /** @type {string[]} */
    const ignored = [];
    decodeState(report, "#q=9,x,987,70deg,0,0&patient=1mm&nothing=3&tolerances=1,&2.q=1", "", ignored);
    assert.deepEqual(ignored, ["d2=x", "patient=1mm", "nothing=3"]);
    assert.deepEqual(decodeState(report, "#q=9,x,987,70deg,0,0").q, [9, initial.q[1], 987, (70 / 180) * Math.PI, 0, 0]);
});
