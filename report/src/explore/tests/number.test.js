import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";

import { decimals, digits, exact, fixed, inUnit, parseValue, percent, quantity, roundedDown, short, trimmed } from "../page/number.js";
import { randomNumbers } from "./support.js";

test("numbers are formatted as by the command", () => {
    assert.deepEqual([0, -0, 1e-9, -1e-9, Infinity, -Infinity, 12345678, -0.5].map((value) => fixed(value, 4)),
        ["0", "0", "0.0000", "0.0000", "∞", "-∞", "1.235e7", "-0.5000"]);
    assert.deepEqual([12.5, 12, 0.12345, -3.1, 0, 100].map((value) => trimmed(value, 4)), ["12.5", "12", "0.1235", "-3.1", "0", "100"]);
    assert.deepEqual([123456.75, 0.1 + 0.2, 1e-5, 9.9e-6, 1e7, -2.5e21, -0, NaN].map(short),
        ["123456.8", "0.3", "0.00001", "9.9e-6", "1e7", "-2.5e21", "0", "NaN"]);
    assert.deepEqual([digits(0.012344, 3), digits(1234.5, 2), digits(0, 4)], ["0.0123", "1200", "0"]);
    assert.deepEqual([5.48, 0.0993, 0, 1e-20, 1e9].map((value) => decimals(value, 4)), [3, 5, 3, 12, 0]);
    assert.deepEqual([roundedDown(0.0912, 3), roundedDown(0.0918, 3), roundedDown(12.5, 1)], ["0.091", "0.091", "12.5"]);
    assert.deepEqual([percent(5.48, 0.5), percent(0, 0.5)], ["1096 %", "0 %"]);
    assert.deepEqual([quantity(70, "kg"), quantity(0.5, "")], ["70 kg", "0.5"]);
});

test("thousands of numbers are formatted as by the command", { skip: !process.env.ABBE_NUMBERS && "ABBE_NUMBERS: no file of the command's texts" }, () => {
    const numbers = JSON.parse(readFileSync(process.env.ABBE_NUMBERS ?? "", "utf8"));
    assert.ok(numbers.length > 10000);
    for (const [value, count, texts] of numbers) {
        const size = Math.abs(value);
        assert.equal(decimals(size, 4), count, value);
        assert.deepEqual([fixed(value, count), fixed(value, 1), trimmed(value, 4), short(value), digits(value, 4),
            roundedDown(size, decimals(size, 2)), percent(size, 3)], texts, value);
    }
});

test("halves are rounded to even", () => {
    assert.deepEqual([0.125, 0.375, -0.125, 0.135].map((value) => fixed(value, 2)), ["0.12", "0.38", "-0.12", "0.14"]);
    assert.deepEqual([0.5, 1.5, 2.5].map((value) => fixed(value, 0)), ["0", "2", "2"]);
    assert.deepEqual([12345, 12355, 122.25, 122.35].map((value) => digits(value, 4)), ["12340", "12360", "122.2", "122.3"]);
    assert.equal(percent(0.125, 1), "12 %");
});

test("values are parsed with their units", () => {
    const angle = [["90", Math.PI / 2], ["90 deg", Math.PI / 2], ["90°", Math.PI / 2], ["-1e-3rad", -1e-3], ["5400 arcmin", Math.PI / 2], ["2 mrad", 2e-3]];
    for (const [text, value] of angle) assert.equal(parseValue(text, "deg", "m"), value, text);
    const length = [["12.5", 12.5], [" 0.3 m ", 300], ["1 inch", 25.4], ["−5", -5], ["7µm", 0.007], [".5", 0.5], ["5.", 5], ["1e+2cm", 1000]];
    for (const [text, value] of length) assert.equal(parseValue(text, "mm", "mm"), value, text);
    assert.equal(parseValue("70", "kg", "mm"), 70);
    assert.equal(parseValue("1 t", "kg", "mm"), 1000);
    assert.equal(parseValue("1 lb", "kg", "m"), 0.45359237);
    assert.equal(parseValue("5 N", "mm*kg/s^2", "mm"), 5000);
    assert.equal(parseValue("2 kN*m^2", "mm^3*kg/s^2", "mm"), 2e12);
    assert.equal(parseValue("3 / s", "1/s", "mm"), 3);
    assert.equal(parseValue("1 mm^2/N", "m*s^2/kg", "m"), 1e-6);
    assert.equal(parseValue("7 %", "", "mm"), 0.07);
    const bad = ["", "x", "1 kg", "1 mm mm", "1 furlong", "1e", "--1", "1,5", "NaN", "Infinity", "1e999", "1 constructor", "1 mm/"];
    for (const text of bad) assert.equal(parseValue(text, "mm", "mm"), undefined, text);
});

test("what is formatted exactly is parsed to the same bits", () => {
    const random = randomNumbers(1);
    for (let i = 0; i < 10000; i++) {
        const value = (random() - 0.5) * 10 ** Math.floor(20 * random() - 10);
        for (const unit of ["deg", "mm", "kg", "mm^3*kg/s^2", "1/K", ""]) {
            const text = exact(value, unit);
            assert.equal(parseValue(text, unit, "mm"), value, text);
        }
    }
    assert.deepEqual([exact((70 / 180) * Math.PI, "deg"), exact(0, "kg"), exact(70, "kg"), exact(3, "1/K")], ["70deg", "0", "70kg", "3/K"]);
    assert.deepEqual([inUnit(Math.PI / 2, "deg", "m"), inUnit(0.123456789, "m", "m"), inUnit(12, "kg", "m")], ["90", "0.1234568", "12"]);
});
