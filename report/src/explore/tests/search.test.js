import assert from "node:assert/strict";
import test from "node:test";

import { allowed, cloud, factorAt, stateAt, sweep, worst } from "../page/search.js";
import { initialState } from "../page/state.js";
import { SHIPPED, STATES, abbe, explored, randomNumbers, randomState } from "./support.js";

/** Runs a search to its end. */
function finish(search) {
    for (let last = 0; ; ) {
        const { done, value } = search.next();
        if (done) return value;
        assert.ok(value >= last && value <= 1, "progress");
        last = value;
    }
}

for (const name of SHIPPED) {
    test(`${name}: the search finds more than 20,000 random samples, and the same again`, () => {
        const { report, machine } = explored(name);
        for (const measurand of ["position", "orientation"]) {
            const random = randomNumbers(6);
            const state = randomState(report, random);
            state.factors = state.factors.map((factor) => factor || 1);
            const options = { measurand, inputs: true };
            const found = finish(worst(machine, report, state, options));
            assert.equal(machine.errors(found.state)[measurand].radius, found.radius);
            assert.equal(found.evaluation[measurand].radius, found.radius);
            let most = 0;
            for (let i = 0; i < 20000; i++) {
                const other = { ...randomState(report, random), s: state.s, factors: state.factors };
                most = Math.max(most, machine.errors(other)[measurand].radius || 0);
            }
            assert.ok(found.radius >= most * (1 - 1e-12), `${measurand}: ${found.radius} < ${most}`);
            assert.deepEqual(finish(worst(machine, report, state, options)), found);
            found.state.q.forEach((value, i) => {
                const [lower, upper] = report.variables[i].limits;
                assert.ok(value >= lower && value <= upper, `${report.variables[i].name} = ${value}`);
            });
            assert.deepEqual(found.state.s, state.s);
            assert.deepEqual(finish(worst(machine, report, state, { measurand })).state.u, state.u);
        }
    });

    test(`${name}: a sweep has the errors of its states`, () => {
        const { report, machine } = explored(name);
        const state = randomState(report, randomNumbers(7));
        report.variables.forEach(({ limits }, joint) => {
            const curves = sweep(machine, report, state, joint, 11, "orientation");
            assert.deepEqual([curves.values[0], curves.values[10]], limits);
            curves.values.forEach((value, i) => {
                const { orientation } = machine.errors({ ...state, q: state.q.map((old, j) => (j === joint ? value : old)) });
                assert.deepEqual([curves.total[i], curves.repeatable[i], curves.random[i]],
                    [orientation.radius, orientation.repeatableRadius, orientation.randomRadius]);
                assert.deepEqual(curves.sources.map((source) => source[i]), orientation.norms);
            });
        });
    });
}

test("the errors over a study's configurations, and the factors for its tolerance, are those of the command", () => {
    const { report, machine } = explored("pps");
    const { position, orientation } = cloud(machine, report, initialState(report));
    const budget = JSON.parse(abbe("analyze", "pps", "--json"));
    assert.equal(position.radii.length, budget.configurations);
    const close = (found, expected) => assert.ok(Math.abs(found - expected) <= 1e-11 * expected, `${found} for ${expected}`);
    close(position.radius, budget.combined.radius);
    close(orientation.radius, budget.orientation.radius);
    assert.equal(budget.sources.length, report.sources.filter(({ enabled }) => enabled).length);
    for (const { name, plain_max: { norm } } of budget.sources) {
        close(position.norms[report.sources.findIndex((source) => source.name === name)], norm);
    }
    const worst = stateAt(report, initialState(report), position.worst);
    report.variables.forEach(({ name }, i) => close(Math.abs(worst.q[i]), Math.abs(budget.combined.worst[name])));
    assert.equal(machine.errors(worst).position.radius, position.radius);
    close(factorAt(position.radius, report.study.tolerance), budget.factor_for_all);
    for (const { name, share_of_tolerance: share } of budget.ledger.sources) {
        close(position.norms[report.sources.findIndex((source) => source.name === name)], share * report.study.tolerance);
    }
});

test("the factors meet the tolerance, and no source without effect has one", () => {
    const { report, machine } = explored("pps");
    const random = randomNumbers(8);
    for (let i = 0; i < 10 * STATES; i++) {
        const state = randomState(report, random);
        const { position } = machine.errors(state);
        const [together, ...alone] = [position.radius, ...position.norms].map((size) => factorAt(size, 0.5));
        position.norms.forEach((norm, k) => assert.equal(alone[k] === null, norm === 0));
        if (together === null) continue;
        const all = machine.errors({ ...state, factors: state.factors.map((factor) => factor * together) });
        assert.ok(Math.abs(all.position.radius - 0.5) < 1e-9, `${all.position.radius}`);
        alone.forEach((factor, k) => {
            const single = state.factors.map((other, i) => (i === k ? other * (factor ?? 1) : 0));
            assert.ok(factor === null || Math.abs(machine.errors({ ...state, factors: single }).position.radius - 0.5) < 1e-9);
        });
    }
    assert.equal(factorAt(0, 1), null);
});

test("a source at its allowed factor uses up the tolerance, and one that is not allowed cannot", () => {
    for (const name of ["pps", "puma560"]) {
        const { report, machine } = explored(name);
        const state = initialState(report);
        const { position, displacements } = machine.errors(state);
        for (const tolerance of [0.3, 0.7, 0.98, 1.2, 3].map((ratio) => ratio * position.radius)) {
            report.sources.forEach(({ follows }, k) => {
                if (follows !== k || !(position.norms[k] > 0)) return;
                const [least, factor] = allowed(machine, position, k, displacements[k].slice(0, 3), tolerance) ?? [null, null];
                const total = (scale) => machine.errors({ ...state, factors: state.factors.map((one, i) => (i === k ? scale : one)) }).position.radius;
                if (factor === null) return assert.ok(total(0) > tolerance, report.sources[k].name);
                assert.ok(Math.abs(total(factor) - tolerance) < 1e-9 * tolerance, report.sources[k].name);
                assert.ok(total(1.01 * factor) > tolerance, report.sources[k].name);
                // Each factor between both meets it.
                for (const share of [0, 0.3, 0.7, 1]) assert.ok(total(least + share * (factor - least)) <= tolerance * (1 + 1e-9));
                assert.ok(least === 0 || total(0.99 * least) > tolerance, report.sources[k].name);
            });
        }
    }
});
