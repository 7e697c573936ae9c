// node run.mjs MODULE NAMES INPUT OUTPUT: calls functions of a generated module.
//
// NAMES has JSON: the arrays that are given, and of every function its name, the names of its arguments and those of its results. INPUT holds
// doubles, the arrays of one configuration after the other; OUTPUT gets what every function returns, in the order of the names.
import { readFileSync, writeFileSync } from "node:fs";

const [module, names, input, output] = process.argv.slice(2);
const robot = await import(module);
const { arrays, functions } = JSON.parse(readFileSync(names));
const sizes = arrays.map(({ name, shape }) => [name, shape.reduce((a, b) => a * b, 1)]);
const bytes = readFileSync(input);
const numbers = new Float64Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
const results = [];
for (let at = 0; at < numbers.length; ) {
    const given = {};
    for (const [name, size] of sizes) {
        given[name] = numbers.subarray(at, at + size);
        at += size;
    }
    for (const [name, taken] of functions) {
        const result = robot[name](...taken.map((argument) => given[argument]));
        const filled = result instanceof Float64Array ? [result] : Object.values(result);
        for (const array of filled) {
            results.push(...(array instanceof Float64Array ? array : [array]));
        }
    }
}
writeFileSync(output, new Uint8Array(Float64Array.from(results).buffer));
