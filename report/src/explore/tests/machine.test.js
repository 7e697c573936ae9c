import assert from "node:assert/strict";
import test from "node:test";

import { commands } from "../page/command.js";
import { createMachine } from "../page/machine.js";
import { decimals, digits, fixed, percent, roundedDown, steady } from "../page/number.js";
import { factorAt } from "../page/search.js";
import { factorOf, initialState } from "../page/state.js";
import { SHIPPED, STATES, evaluated, explored, otherSpecs, randomNumbers, randomState, shell } from "./support.js";

/** Asserts that numbers agree to rounding, relative to a size. */
function close(found, expected, size, what) {
    const [all, wanted] = [found, expected].map((numbers) => [numbers].flat(2));
    assert.equal(all.length, wanted.length, what);
    all.forEach((value, i) => {
        assert.ok(Math.abs(value - wanted[i]) <= 1e-11 * size, `${what}: ${value} for ${wanted[i]}`);
    });
}

/** Returns the lines of `abbe analyze` that a state's figures lead to. */
function printed({ error_unit: units, study, sources }, { position, orientation }) {
    const [symbol, factor] = units.length;
    const shown = decimals(factor * position.radius, 4);
    const length = (value) => fixed(factor * value, shown);
    const row = (...cells) => cells.filter((cell) => cell !== "").join("   ");
    const times = (value) => `× ${roundedDown(value, decimals(value, 2))}`;
    const share = (value, tolerance) => (tolerance === null ? "" : percent(value, tolerance));
    const lines = [row("as built", `${length(position.radius)} ${symbol}`, share(position.radius, study.tolerance))];
    const root = position.randomNorm;
    if (root > 0 && position.repeatableRadius > 0) {
        lines.push(row(study.criterion === "rss" ? "random only" : "random, rss", `${length(root)} ${symbol}`, share(root, study.tolerance)));
    }
    if (orientation.radius > 0) {
        lines.push(row("orientation", `${digits(1e3 * orientation.radius, 4)} mrad`, share(orientation.radius, study.orientation_tolerance)));
    }
    position.norms.forEach((norm, k) => {
        const alone = study.tolerance === null ? null : factorAt(norm, study.tolerance);
        lines.push(row(sources[k].name, length(norm), percent(steady(position.shares[k]), 1), alone === null ? "" : times(alone)));
    });
    const together = study.tolerance === null ? null : factorAt(position.radius, study.tolerance);
    if (together) lines.push(row("all, as built", length(position.radius), times(together)));
    return lines;
}

/** Asserts that both commands of a state give its numbers, and print them alike. Returns the number of lines compared. */
function assertAgrees(report, machine, state) {
    const [analyze, jacobian] = commands(report, state);
    const evaluation = machine.evaluate(state);
    const { position, orientation } = evaluation;
    if (report.has_loops && !Number.isFinite(position.radius)) {
        assert.throws(() => shell(`${jacobian} 2>&1`), /loop|limits/, jacobian);
        return 0;
    }
    const size = Math.max(...position.norms, 1e-6);
    const about = (what) => `${what} of ${analyze}`;

    const exact = JSON.parse(shell(`${jacobian} --json`));
    assert.deepEqual(exact.q.map((value) => value + 0), state.q, about("q"));
    const matrices = [exact.pose, exact.real_pose].map((rows) => [0, 1, 2, 3].map((j) => [0, 1, 2].map((i) => rows[i][j])));
    const reach = Math.max(...matrices[0].flat().map(Math.abs));
    close(evaluation.pose, matrices[0], reach, about("pose"));
    close(evaluation.realPose, matrices[1], reach, about("real pose"));
    close(machine.jacobian(state), exact.error_jacobian, reach, about("J_e"));
    close(evaluation.displacement, exact.displacement, size, about("ΔX"));

    const budget = JSON.parse(shell(`${analyze} --json`));
    assert.equal(budget.configurations, 1);
    const isOn = report.sources.map(({ enabled, follows }, k) =>
        factorOf(report, state, k) > 0 || (enabled && (follows === null || report.sources[follows].enabled)));
    const active = (numbers) => numbers.filter((_, k) => isOn[k]);
    assert.deepEqual(budget.sources.map(({ name }) => name), active(report.sources.map(({ name }) => name)));
    close(active(position.norms), budget.sources.map(({ plain_max: { norm } }) => norm), size, about("norms"));
    const [byCriterion, turned] = report.study.criterion === "rss" ? [budget.combined.radius, budget.orientation.radius]
        : [budget.combined.worst_case_radius, budget.orientation.worst_case_radius];
    close([position.repeatableRadius, position.radius], [budget.combined.repeatable_radius, byCriterion], size, about("totals"));
    close(active(position.shares), budget.sources.map(({ name }) => budget.ledger.sources.find((one) => one.name === name).share),
        1e3, about("shares"));
    close(position.random, budget.combined.random, size, about("random rows"));
    close(orientation.radius, turned, orientation.radius + 1e-6, about("orientation"));
    if (budget.factor_for_all) {
        const together = factorAt(position.radius, report.study.tolerance);
        close(together, budget.factor_for_all, together, about("all"));
        for (const source of budget.ledger.sources) {
            const k = report.sources.findIndex(({ name }) => name === source.name);
            close(position.norms[k] / report.study.tolerance, source.share_of_tolerance, 1, about("alone"));
        }
    }

    const text = shell(analyze);
    // Where the tolerance is not kept, the command has the factors of an allocation, the page those of each source alone.
    const isAllocated = budget.ledger.sources.some(({ factor }) => factor !== undefined);
    const withoutFactor = (line) => (isAllocated && !line.startsWith("all, as built") ? line.replace(/   × \S+$/, "") : line);
    const lines = text.split("\n").map((line) => withoutFactor(line.trim().replaceAll(/ {3,}/g, "   ")));
    const expected = printed(report, evaluation).map(withoutFactor);
    const named = lines.filter((line) => line.match(/\d/) && expected.some((wanted) => line.startsWith(`${wanted.split("   ")[0]}   `)));
    // Further cells of a line, such as a probability, are not the page's.
    for (const line of named) assert.ok(expected.some((wanted) => `${line}   `.startsWith(`${wanted}   `)), `${line}: none of ${expected.join("\n")}\n${text}`);
    assert.ok(named.some((line) => line.startsWith("as built")) || isOn.every((on) => !on), text);
    return named.length;
}

for (const name of new Set([...SHIPPED, "palletizer", "hexapod", ...otherSpecs()])) {
    test(`${name}: numbers and printed figures are those of the commands`, () => {
        const { report, machine } = explored(name);
        const random = randomNumbers(3);
        assert.ok(assertAgrees(report, machine, initialState(report)) > 0 || report.sources.every(({ enabled }) => !enabled));
        for (let i = 0; i < STATES; i++) assertAgrees(report, machine, randomState(report, random));
    });

    test(`${name}: the frames end at the poses of the tool`, () => {
        const { report, machine } = explored(name);
        const random = randomNumbers(4);
        for (let i = 0; i < 20; i++) {
            const state = randomState(report, random);
            const { pose, realPose, displacement, position } = machine.evaluate(state);
            const { ideal, real } = machine.frames(state, 1);
            assert.equal(ideal.length, report.frames.length + 2);
            const reach = Math.max(...pose.map(Math.abs));
            if (report.has_loops) {
                assert.deepEqual(real, []);
                if (!Number.isFinite(reach)) continue;
            }
            close(ideal.at(-1), pose, reach, "ideal");
            if (report.has_loops) continue;
            // Errors elsewhere on a link differ by terms of second order.
            const error = Math.max(...position.norms, ...machine.errors(state).orientation.norms.map((angle) => angle * reach));
            close(real.at(-1), realPose, 1e11 * (1e-12 * reach + 30 * error ** 2 / reach), "real");
            close(machine.frames(state, 0).real, ideal, reach, "without errors");
            // Small errors are magnified in proportion.
            const moved = machine.frames(state, 1e-3).real.at(-1).slice(9).map((value, j) => 1e3 * (value - pose[9 + j]));
            close(moved, displacement.slice(0, 3), 1e11 * (1e-9 * reach + 30e-3 * error ** 2 / reach), "first order");
        }
    });
}

test("a changed formula is noticed", () => {
    const { report } = explored("pps");
    const state = randomState(report, randomNumbers(5));
    state.factors = report.sources.map(() => 1);
    for (const name of ["source_displacements", "pose", "real_pose", "error_jacobian"]) {
        const [before, rest] = report.code.split(`export function ${name}(`);
        for (const mutate of [(text) => text.replace(" + ", " - "), (text) => text.replace(/Math\.sin/, "Math.cos")]) {
            const changed = mutate(rest);
            assert.notEqual(changed, rest);
            const machine = createMachine(evaluated(`${before}export function ${name}(${changed}`), report);
            assert.throws(() => assertAgrees(report, machine, state), assert.AssertionError, name);
        }
    }
    // And so is a combination that is not the command's.
    const machine = createMachine(evaluated(report.code), report);
    const wrong = { ...machine, evaluate: (at) => {
        const evaluation = machine.evaluate(at);
        return { ...evaluation, position: { ...evaluation.position, radius: evaluation.position.norms.reduce((sum, norm) => sum + norm) } };
    } };
    assert.throws(() => assertAgrees(report, wrong, initialState(report)), assert.AssertionError);
});

test("options of the page's own command stay in the copied ones", () => {
    const { report, machine } = explored("pps", "--study", "pps-section6", "--set", "x=100mm", "--disable", "assembly", "--scale", "spin encoder=2", "--set", "patient=70kg");
    const state = initialState(report);
    assert.equal(state.s[report.parameters.findIndex(({ name }) => name === "x")], 100);
    const assembly = report.sources.findIndex(({ name }) => name === "assembly");
    assert.equal(state.factors[assembly], 0);
    assertAgrees(report, machine, state);
    // Here the state switches on what the command switched off.
    state.factors = state.factors.map(() => 0.5);
    state.u[0] = 12.5;
    const [analyze, jacobian] = commands(report, state);
    assert.ok(!analyze.includes("--disable") && analyze.includes("--study pps-section6") && !jacobian.includes("--study"), analyze);
    const [typed, other] = commands(report, state, { position: 0.3, orientation: null });
    assert.ok(typed.includes("--tolerance 0.3mm") && !other.includes("--tolerance"), typed);
    const { tolerance: position, orientation_tolerance: orientation } = report.study;
    assert.equal(commands(report, state, { position, orientation })[0], analyze);
    assertAgrees(report, machine, state);
});
