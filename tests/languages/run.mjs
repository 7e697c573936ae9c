// node run.mjs MODULE FUNCTIONS INPUT OUTPUT: calls functions of a generated module.
//
// FUNCTIONS has JSON: a name, the names of the arguments and those of the results each. INPUT holds doubles, q, s, u, errors, variances and
// magnitudes of one configuration after the other; OUTPUT gets what every function returns, in the order of the names.
import { readFileSync, writeFileSync } from "node:fs";

const [module, functions, input, output] = process.argv.slice(2);
const robot = await import(module);
const { frames, variables, parameters, inputs, sources } = robot.description;
const sizes = {
    q: variables.length,
    s: parameters.length,
    u: inputs.length,
    errors: 6 * frames.length,
    variances: 6 * frames.length,
    magnitudes: sources.length,
};
const bytes = readFileSync(input);
const numbers = new Float64Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
const results = [];
for (let at = 0; at < numbers.length; ) {
    const given = {};
    for (const [name, size] of Object.entries(sizes)) {
        given[name] = numbers.subarray(at, at + size);
        at += size;
    }
    for (const [name, names] of JSON.parse(readFileSync(functions))) {
        const result = robot[name](...names.map((argument) => given[argument]));
        const arrays = result instanceof Float64Array ? [result] : Object.values(result);
        for (const array of arrays) {
            results.push(...(array instanceof Float64Array ? array : [array]));
        }
    }
}
writeFileSync(output, new Uint8Array(Float64Array.from(results).buffer));
