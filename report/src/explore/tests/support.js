// The command, reports of the shipped machines, and random states.

import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

import { createMachine } from "../page/machine.js";
import { initialState } from "../page/state.js";

/** Path of the command to compare with. */
const ABBE = process.env.ABBE ?? new URL("../../../../target/debug/abbe", import.meta.url).pathname;

/** Number of states per machine. */
export const STATES = Number(process.env.ABBE_STATES ?? 3);

/** Runs the command. @param {string[]} options @returns {string} */
export function abbe(...options) {
    return execFileSync(ABBE, options, { encoding: "utf8", maxBuffer: 1e9, stdio: ["ignore", "pipe", "ignore"] });
}

/** Runs a copied command in a shell. @param {string} line @returns {string} */
export function shell(line) {
    const path = `${new URL(".", `file://${ABBE}`).pathname}:${process.env.PATH}`;
    return execFileSync("sh", ["-c", line], { encoding: "utf8", env: { ...process.env, PATH: path }, stdio: ["ignore", "pipe", "inherit"] });
}

/** Names of the shipped machines, or of those to be tested. */
export const SHIPPED = process.env.ABBE_MACHINES?.split(" ") ?? JSON.parse(abbe("list", "--json")).map(({ name }) => name);

/** A machine without limits, in metres, to which sources may be added. */
const PLAIN = `[manipulator]
name = "plain"
title = "A turn"
length = "m"

[[frame]]
name = "turn"
variable = { name = "q1", kind = "revolute" }
transform = "Rz(q1) Tx(1 m)"
`;
const RANDOM = '\n[[source]]\nname = "encoder"\nclass = "random"\ndistribution = "normal"\njoint = "q1"\nerror = "1 mrad"\n';
const BALLS = '\n[[source]]\nname = "bearing"\nclass = "tolerance"\ndistribution = "ball"\nframe = "turn"\ne_x = "0.2 mm"\ne_y = "0.3 mm"\ne_z = "0.3 mm"\n'
    + '\n[[source]]\nname = "tilt"\nclass = "random"\ndistribution = "disc"\nframe = "turn"\ne_s = "1 mrad"\ne_p = "1 mrad"\n';
const FIXED = PLAIN.replace(/variable.*\n/, "").replace("Rz(q1)", "Rz(1)");
const REPEATABLE = '\n[[source]]\nname = "foot"\nclass = "repeatable"\nframe = "turn"\ne_x = "1 mm"\n';

/**
 * Specs with what the shipped ones lack: tables, compliances, normal random sources, uncertain inputs and magnitudes, a
 * calibration, balls, angles of IEC 61217, and names that a shell or an address could misread; no source, no joint, no limits.
 */
export function otherSpecs() {
    const root = new URL("../../../../", import.meta.url);
    const [, everything] = readFileSync(new URL("docs/reference/spec.md", root), "utf8").split(/^```(?:toml)?\n/m);
    const uncalibrated = everything
        .split("[covariance]")[0]
        .replace('"rotation-vector"', '"iec-61217"')
        .replaceAll("elbow_pull", "q")
        .replaceAll("gear of the turn", `it's 50 % of \\"a\\" & b=c; $HOME #1+1`);
    // Its weight loads other sources only if it is enabled.
    const beam = 'name = "bending of the upper arm"';
    const disabled = uncalibrated.replace(beam, `${beam}\nenabled = false`);
    const folder = mkdtempSync(join(tmpdir(), "abbe-"));
    process.on("exit", () => rmSync(folder, { recursive: true }));
    return [new URL("tests/specs/measured.toml", root).pathname].concat([everything, uncalibrated, disabled, PLAIN, PLAIN + RANDOM, PLAIN + RANDOM + REPEATABLE + BALLS, FIXED + REPEATABLE].map((text, i) => {
        const path = join(folder, `the ${i}.toml`);
        writeFileSync(path, text);
        return path;
    }));
}

/** Returns the functions of generated code. @param {string} code */
export function evaluated(code) {
    const names = [...code.matchAll(/^export (?:function|const) (\w+)/gm)].map(([, name]) => name);
    return new Function(`"use strict"; ${code.replace(/^export /gm, "")}\nreturn { ${names.join(", ")} };`)();
}

/** Returns report, code and machine of a spec. @param {string[]} options */
export function explored(...options) {
    const [report] = JSON.parse(abbe("explore", ...options, "--json"));
    const generated = evaluated(report.code);
    return { report, generated, machine: createMachine(generated, report) };
}

/** Returns a generator of numbers from 0 to 1 (mulberry32). @param {number} seed @returns {() => number} */
export function randomNumbers(seed) {
    return () => {
        seed = (seed + 0x6d2b79f5) | 0;
        let t = Math.imul(seed ^ (seed >>> 15), seed | 1);
        t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
        return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
    };
}

/** Returns a state as a user might set it: within limits, with parameters near their values, nearer where loops must close at home. */
export function randomState(report, random) {
    const part = report.has_loops ? 0.01 : 0.1;
    const state = initialState(report);
    const between = ([lower, upper]) => (lower ?? -2) + random() * ((upper ?? 2) - (lower ?? -2));
    state.q = report.variables.map(({ limits }) => between(limits));
    state.s = report.parameters.map(({ nominal }) => (random() < 0.5 ? nominal : nominal * between([1 - part, 1 + part])));
    state.u = report.inputs.map(({ range, nominal }) => (range.includes(null) ? nominal + between([-1, 1]) * (nominal || 1) : between(range)));
    state.factors = report.sources.map(({ follows }, k) =>
        follows === k ? [0, state.factors[k], 1, 3 * random()][Math.floor(4 * random())] : state.factors[k]);
    return state;
}
