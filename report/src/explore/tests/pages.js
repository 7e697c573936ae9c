// Pages in a browser: whatever the user sets, the figures shown are those of the commands shown. Run by `node --test`.

import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import test, { after, before } from "node:test";

import { decimals, digits, exact, fixed, steady } from "../page/number.js";
import { startBrowser } from "./browser.js";
import { SHIPPED, STATES, abbe, explored, otherSpecs, randomNumbers, shell } from "./support.js";

/** Milliseconds after which the page has shown everything, commands and link included. */
const SETTLED = 400;

const folder = mkdtempSync(join(tmpdir(), "abbe-pages-"));
let browser;
before(async () => (browser = await startBrowser({ width: 1400, height: 8000 })));
after(async () => {
    await browser.close();
    rmSync(folder, { recursive: true });
});

/** Writes and opens the page of a spec. */
async function open(name) {
    const path = join(folder, "page.html");
    abbe("explore", name, "--out", path, "--force");
    await browser.open(`file://${path}`);
}

/** Returns what the page shows. */
async function figures() {
    await new Promise((resolve) => setTimeout(resolve, SETTLED));
    return browser.evaluate(`(() => {
        const texts = (selector, from = document) => [...from.querySelectorAll(selector)].map((one) => one.textContent);
        return {
            total: texts(".abbe-panel .total")[0],
            share: texts(".abbe-panel .of")[0],
            parts: texts(".abbe-panel .parts")[0],
            sources: [...document.querySelectorAll(".sources li")].map((row) => ({
                name: texts(".name span span", row)[0],
                value: texts(".number", row)[0].replace("± ", ""),
                share: texts(".share", row)[0],
                factor: row.querySelector("input[type=text]")?.value ?? "1",
            })).sort((a, b) => (a.name < b.name ? -1 : 1)),
            tables: [...document.querySelectorAll(".poses table, .jacobian table")].map((table) =>
                [...table.querySelectorAll("tbody tr")].map((row) => texts("td", row))),
            lines: texts(".same code"),
            problems: texts(".problem").filter((text) => text !== ""),
        };
    })()`);
}

/** Asserts that a number is shown as it is formatted; nothing may have a sign. */
function assertShown(shown, expected, what) {
    assert.equal(Number(shown.replace("·", "0")), Number(expected), what);
}

/** Asserts that the figures shown are those that the commands shown print. Returns the number of figures compared. */
async function assertAgrees(report) {
    const shown = await figures();
    assert.deepEqual(shown.problems, []);
    const [analyze, jacobian] = shown.lines;
    const [text, budget, exact] = [shell(analyze), JSON.parse(shell(`${analyze} --json`)), JSON.parse(shell(`${jacobian} --json`))];
    const rows = new Map(text.split("\n").map((line) => line.trim().split(/ {3,}/)).map(([name, ...cells]) => [name, cells]));
    const [symbol, factor] = report.error_unit.length;
    let compared = 0;

    const judged = report.study.criterion === "rss" ? "radius" : "worst_case_radius";
    const radius = factor * steady(budget.combined?.[judged] ?? 0);
    const [total, share] = rows.get("as built") ?? [`${fixed(0, 3)} ${symbol}`];
    assert.equal(shown.total, total, analyze);
    if (report.study.tolerance !== null) assert.equal(shown.share, `${share} of`, analyze);
    if (rows.has("random only")) assert.ok(shown.parts.endsWith(` ${rows.get("random only")[0]}`), `${shown.parts}: ${analyze}`);
    for (const { name, value, share, factor: own } of shown.sources) {
        const source = budget.sources.find((source) => source.name === name);
        assert.equal(value, fixed(factor * steady(source?.plain_max.norm ?? 0), decimals(radius, 4)), `${name}: ${analyze}`);
        if (!rows.has(name) || own === "0") continue;
        const [printed, printedShare = ""] = rows.get(name);
        assert.deepEqual([value, share], [printed, printedShare], `${name}: ${analyze}`);
        compared += 2;
    }

    const [error, ideal, real, ...frames] = shown.tables;
    const units = report.rows.map((_, i) => report.error_unit[i < 3 ? "length" : "angle"][1]);
    error.forEach(([repeatable], i) => assertShown(repeatable, fixed(units[i] * exact.displacement[i], 4), `ΔX: ${jacobian}`));
    const places = [6, 6, 6, report.length === "m" ? 7 : 4];
    [ideal, real].forEach((pose, k) => pose.forEach((row, i) => row.forEach((cell, j) =>
        assertShown(cell, fixed([exact.pose, exact.real_pose][k][i][j], places[j]), `pose: ${jacobian}`))));
    frames.forEach((frame, f) => frame.forEach((row, i) => row.forEach((cell, j) => {
        const value = exact.error_jacobian[i][6 * f + j];
        assertShown(cell, Math.abs(value) < 1e-9 ? "0" : digits(value, 3), `J_e: ${jacobian}`);
    })));
    return compared + 2 + 6 + 24 + 36 * frames.length;
}

/** Scrolls to an element, given by its name for assistive technology, and returns its rectangle. */
async function rectangle(label) {
    const found = await browser.evaluate(`(async () => {
        const element = [...document.querySelectorAll("[aria-label]")].find((one) => one.ariaLabel === ${JSON.stringify(label)});
        element.closest("details")?.setAttribute("open", "");
        // What was changed before is drawn first.
        await new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
        element.scrollIntoView({ block: "center" });
        const { x, y, width, height } = element.getBoundingClientRect();
        return { x, y, width, height };
    })()`);
    assert.ok(found.width > 0 && found.height > 0, label);
    return found;
}

/** Replaces the text of a field, and presses a key that ends it. */
async function type(label, text, key) {
    await rectangle(label);
    await browser.evaluate(`(() => {
        const field = [...document.querySelectorAll("[aria-label]")].find((one) => one.ariaLabel === ${JSON.stringify(label)});
        field.focus();
        field.select();
    })()`);
    await browser.type(text);
    await browser.press(key);
}

/** Drags a slider to a part of its length, and then presses arrow keys. */
async function slide(label, part, keys) {
    const { x, y, width, height } = await rectangle(`${label}, slider`);
    const middle = y + height / 2;
    await browser.drag([x + width / 2, middle], [x + width * (0.02 + 0.96 * part), middle]);
    for (let i = 0; i < Math.abs(keys); i++) await browser.press(keys > 0 ? "ArrowRight" : "ArrowLeft");
}

/** Chooses the measurand that is shown. */
async function choose(measurand) {
    const { x, y } = await browser.evaluate(`[...document.querySelectorAll(".measurand label")].find((label) =>
        label.textContent === ${JSON.stringify(measurand)}).querySelector("input").getBoundingClientRect().toJSON()`);
    await browser.click(x + 5, y + 5);
}

/** Returns one of a list. */
const among = (list, random) => list[Math.floor(random() * list.length)];

/** Changes the factor of a source, or switches it. The list of sources may be sorted again after other changes. */
async function actOnSource(own, random) {
    const { name } = among(own, random);
    const label = `factor of ${name}`;
    if (random() < 0.4) return type(label, among(["0", "1", "0.5", "2.25", "33 %"], random), among(["Enter", "Tab"], random));
    if (random() < 0.5) return slide(label, random(), 1);
    const { x, y } = await browser.evaluate(`[...document.querySelectorAll(".sources li")].find((row) =>
        row.querySelector(".name span span").textContent === ${JSON.stringify(name)}).querySelector("input[type=checkbox]").getBoundingClientRect().toJSON()`);
    return browser.click(x + 5, y + 5);
}

/** Changes some of what the page offers. */
async function act(report, random) {
    const enter = (label, text) => type(label, text, among(["Enter", "Tab"], random));
    const own = report.sources.filter(({ follows }, k) => follows === k);
    if (own.length > 0) await actOnSource(own, random);
    const between = ([lower, upper], value) => (lower ?? value - 1) + random() * ((upper ?? value + 1) - (lower ?? value - 1));
    const other = report.length === "mm" ? ["m", 1e-3] : ["mm", 1e3];
    const joints = report.variables.map(({ name, kind, limits, home }) =>
        ({ name, value: between(limits, home), unit: kind === "revolute" ? "deg" : report.length }));
    const inputs = report.inputs.map(({ name, range, nominal, unit }) => ({ name, value: between(range, nominal), unit }));
    const parameters = report.parameters.map(({ name, range, nominal, unit }) =>
        ({ name, value: range ? between(range, nominal) : nominal * (0.9 + 0.2 * random()), unit, isFree: !range }));
    const values = [joints, joints, inputs, parameters].map((all) => among(all, random)).filter(Boolean);
    for (const { name, value, unit, isFree } of values) {
        // A stiffness of zero, for one, has no figures.
        const part = isFree ? 0.3 + 0.4 * random() : random();
        if (random() < 0.4) await slide(name, part, Math.floor(7 * random()) - 3);
        else if (unit === report.length && random() < 0.5) await enter(name, `${Number((value * other[1]).toPrecision(5))} ${other[0]}`);
        else await enter(name, among([exact(value, unit), `  ${exact(value, unit)} `], random));
    }
}

// The other specs only if there is time for many states.
for (const name of STATES < 10 ? SHIPPED : [...SHIPPED, ...otherSpecs()]) {
    test(`${name}: the figures shown are those of the commands shown`, async () => {
        const { report } = explored(name);
        await open(name);
        let compared = await assertAgrees(report);
        const random = randomNumbers(9);
        const count = SHIPPED.includes(name) ? STATES : Math.ceil(STATES / 10);
        for (let i = 0; i < count; i++) {
            await act(report, random);
            compared += await assertAgrees(report);
        }
        await choose("orientation");
        const { total, lines: [analyze] } = await figures();
        const [, printed] = /^ +orientation +(\S+) mrad/m.exec(shell(analyze)) ?? ["", "0"];
        assertShown(total.replace(" mrad", ""), printed, analyze);
        await choose("position");
        // The link shows the same in a new page.
        const shown = await figures();
        await browser.open(shown.lines[2]);
        const again = await figures();
        assert.deepEqual(again, shown);
        assert.deepEqual(browser.errors(), []);
        assert.ok(compared > 60 * (count + 1), `${compared} figures`);
    });
}

test("the worst case is found in a worker, and loaded", async () => {
    const { report } = explored("pps");
    await open("pps");
    const { x, y, width, height } = await rectangle("Find the worst case within the joint limits");
    const before = await figures();
    await browser.click(x + width / 2, y + height / 2);
    await browser.evaluate(`new Promise((done) => {
        const wait = () => (document.querySelector("progress").hidden ? done() : setTimeout(wait, 20));
        wait();
    })`);
    await assertAgrees(report);
    const after = await figures();
    assert.ok(parseFloat(after.total) > parseFloat(before.total), after.total);
    assert.deepEqual(browser.errors(), []);
});

/** Types a tolerance of the panel. */
async function limit(text) {
    await browser.evaluate(`(() => {
        const field = document.querySelector("input.tolerance");
        field.focus();
        field.select();
    })()`);
    await browser.type(text);
    await browser.press("Enter");
}

test("configurations within the tolerance are counted as the command does", async () => {
    await open("pps");
    const { lines: [analyze] } = await figures();
    const out = join(folder, "out");
    shell(`${analyze.replace(/ --q \S+/, "")} --out ${out} --force`);
    const [heading, ...rows] = readFileSync(join(out, "configurations.csv"), "utf8").trim().split("\n").map((line) => line.split(","));
    // The convention of the study: the norms of both are added.
    const norm = (row, part) => Math.hypot(...["x", "y", "z"].map((axis) => Number(row[heading.indexOf(`${part} ${axis} (mm)`)])));
    await limit("3 mm");
    await figures();
    const [within, beyond] = [true, false].map((kind) => rows.filter((row) => norm(row, "repeatable") + norm(row, "random") <= 3 === kind).length);
    assert.ok(within > 0 && beyond > 0, `${within} ${beyond}`);
    const keys = await browser.evaluate(`[...document.querySelectorAll(".view .key:is(.within, .beyond)")].map(({ textContent }) => textContent)`);
    assert.deepEqual(keys, [`${within} of ${rows.length} within`, `${beyond} of ${rows.length} beyond`]);
    assert.deepEqual(browser.errors(), []);
});

test("the tolerance is met over the study by one factor, and by the cheapest ones", async () => {
    const texts = () => browser.evaluate(`[...document.querySelectorAll(".searches p")].map(({ textContent }) => textContent)`);
    for (const name of ["Meet it", "At least cost"]) {
        await open("pps");
        await figures();
        assert.match((await texts())[0], / 0 of 999 within\./);
        await browser.evaluate(`[...document.querySelectorAll("button")].find((one) => one.textContent === "${name}").click()`);
        const { lines: [analyze] } = await figures();
        assert.match((await texts())[0], /^0\.49\d+ mm, .* 999 of 999 within\./);
        // The command agrees: without the joints it analyzes the study.
        assert.match(shell(analyze.replace(/ --q \S+/, "")), /(?:^|\W)MET/m);
    }
    assert.deepEqual(browser.errors(), []);
});

test("a tool point of the study is loaded by a click, and changes are undone", async () => {
    await open("ur5");
    await limit("0.06 mm");
    const before = await figures();
    const [x, y] = await browser.evaluate(`(() => {
        const { left, top } = document.querySelector(".view .stage").getBoundingClientRect();
        const places = ["within", "beyond"].map((name) => [...document.querySelector(".view path." + name).getAttribute("d").matchAll(/M(\\S+) (\\S+?)h0/g)]
            .map(([, x, y]) => [Number(x), Number(y)]));
        // One that no other is near.
        const [x, y] = places[0].find(([x, y]) => places[1].every((other) => Math.hypot(other[0] - x, other[1] - y) > 4));
        return [left + x, top + y];
    })()`);
    await browser.click(x, y);
    const loaded = await figures();
    assert.notEqual(loaded.total, before.total);
    assert.ok(parseFloat(loaded.total) <= 0.06, loaded.total);
    const undo = () => browser.evaluate(`document.querySelector(".abbe-panel").dispatchEvent(new KeyboardEvent("keydown", { key: "z", ctrlKey: true, bubbles: true }))`);
    await slide("q2", 0.2, 0);
    await figures();
    for (const { lines } of [loaded, before]) {
        await undo();
        assert.deepEqual((await figures()).lines.slice(0, 2), lines.slice(0, 2));
    }
    assert.deepEqual(browser.errors(), []);
});

test("what is saved is what is shown", async () => {
    await open("ur5");
    const shown = await figures();
    /** Presses a button, and returns the text or the first bytes of the file. */
    const saved = (name) => browser.evaluate(`(async () => {
        const file = new Promise((done) => (URL.createObjectURL = (blob) => (done(blob), "blob:none")));
        HTMLAnchorElement.prototype.click = function () { globalThis.savedAs = this.download; };
        [...document.querySelectorAll(".same button")].find((one) => one.textContent === ${JSON.stringify(name)}).click();
        const blob = await file;
        return [globalThis.savedAs, blob.type === "image/png" ? [...new Uint8Array(await blob.slice(0, 24).arrayBuffer())] : await blob.text()];
    })()`);
    const [name, sources] = await saved("Sources, CSV");
    assert.equal(name, "ur5.sources.csv");
    const rows = sources.trim().split("\n").map((line) => line.split(","));
    assert.deepEqual(rows[0], ["source", "class", "at", "position error (mm)", "share", "factor"]);
    for (const { name, value } of shown.sources) {
        const row = rows.find((row) => row[0] === name);
        assert.ok(Math.abs(Number(row[3]) - Number(value)) < 1e-3, name);
    }
    const [, study] = await saved("Study, CSV");
    const [heading, ...configurations] = study.trim().split("\n").map((line) => line.split(","));
    const largest = Math.max(...configurations.map((row) => Number(row[heading.indexOf("position error (mm)")])));
    const [worst] = await browser.evaluate(`[...document.querySelectorAll(".searches p")].map(({ textContent }) => textContent)`);
    assert.ok(worst.startsWith(`${digits(largest, 4)} mm`), `${worst} ${largest}`);
    const [, svg] = await saved("Picture, SVG");
    assert.match(svg, /^<svg[^>]* xmlns="http:\/\/www.w3.org\/2000\/svg"/);
    assert.match(svg, / stroke="rgb\(/);
    const [, png] = await saved("Picture, PNG");
    assert.deepEqual(png.slice(0, 8), [0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);
    assert.ok(png[18] * 256 + png[19] > 800, `${png}`);
    assert.deepEqual(browser.errors(), []);
});

test("pinned cases keep their errors beside those now", async () => {
    await open("ur5");
    await slide("q2", 0.3, 0);
    const pinned = await figures();
    const press = (name) => browser.evaluate(`[...document.querySelectorAll(".pins button")].find((one) => one.textContent === ${JSON.stringify(name)}).click()`);
    const rows = () => browser.evaluate(`[...document.querySelectorAll(".pins tr")].map((row) => [...row.children].map(({ textContent }) => textContent))`);
    await press("Pin this case");
    await slide("q3", 0.8, 0);
    const { name } = explored("ur5").report.sources[0];
    await type(`factor of ${name}`, "2", "Enter");
    const now = await figures();
    const table = await rows();
    assert.deepEqual(table[0], ["", "now", "case 1×"]);
    const [, total, before] = table.find(([title]) => title === "position error (mm)");
    assert.equal(Number(total), parseFloat(now.total));
    const [, value, sign, difference] = /^(\S+) \(([−+])(\S+)\)$/.exec(before);
    assert.equal(Number(value), Number(parseFloat(pinned.total).toFixed(value.split(".")[1].length)));
    assert.ok(Math.abs((sign === "+" ? 1 : -1) * Number(difference) - (Number(value) - Number(total))) < 2e-4, before);
    const differing = table.map(([title]) => title).filter((title) => /^q\d$/.test(title) || title.startsWith("factor"));
    assert.deepEqual(differing, ["q3", `factor of ${name}`]);
    await press("case 1");
    assert.deepEqual((await figures()).lines.slice(0, 2), pinned.lines.slice(0, 2));
    await press("×");
    await figures();
    assert.equal(await browser.evaluate(`document.querySelector(".pins table").hidden`), true);
    assert.deepEqual(browser.errors(), []);
});

/** Returns the middle of the circle of the tool point in the picture, on the screen. */
const toolPoint = () => browser.evaluate(`(() => {
    const stage = document.querySelector(".view .stage");
    stage.scrollIntoView({ block: "center" });
    const { x, y, width, height } = document.querySelector(".view .tip").getBoundingClientRect();
    return [x + width / 2, y + height / 2];
})()`);

test("the tool point follows the mouse, values are told under it, and a field is left as it was", async () => {
    const { report } = explored("ur5");
    await open("ur5");
    const before = await figures();
    const [x, y] = await toolPoint();
    await browser.hover([x, y]);
    const note = (where) => browser.evaluate(`document.querySelector("${where} .note").textContent`);
    assert.equal(await note(".view"), "tool point: drag it");
    await browser.drag([x, y], [x - 30, y + 20]);
    const after = await figures();
    assert.notEqual(after.lines[0], before.lines[0]);
    await assertAgrees(report);
    const moved = await toolPoint();
    assert.ok(Math.hypot(moved[0] - x + 30, moved[1] - y - 20) < 1, `${moved} ${x} ${y}`);
    // Over the curve the value is that which the panel then shows.
    const { left, top, width, height } = await browser.evaluate(`(() => {
        const stage = document.querySelector(".chart");
        stage.scrollIntoView({ block: "center" });
        return stage.getBoundingClientRect().toJSON();
    })()`);
    const over = [left + 0.4 * width, top + height - 40];
    await browser.hover(over);
    const [, told] = /^(\S+ mm) at /.exec(await note(".chart"));
    await browser.click(...over);
    assert.equal((await figures()).total, told);
    await rectangle("q2");
    const value = `[...document.querySelectorAll("[aria-label]")].find((one) => one.ariaLabel === "q2")`;
    const kept = await browser.evaluate(`(${value}.focus(), ${value}.select(), ${value}.value)`);
    await browser.type("12345");
    await browser.press("Escape");
    assert.equal(await browser.evaluate(`${value}.value`), kept);
    assert.deepEqual(browser.errors(), []);
});

test("joints of two machines move together", async () => {
    const path = join(folder, "two.html");
    abbe("explore", "ur5", "puma560", "--out", path, "--force");
    await browser.open(`file://${path}`);
    await figures();
    const joints = () => browser.evaluate(`[...document.querySelectorAll(".abbe-panel")].map((panel) =>
        [...panel.querySelectorAll("fieldset:first-child input[type=text]")].map(({ value }) => value))`);
    const text = () => browser.evaluate(`document.querySelectorAll(".linked span")[1].textContent`);
    const apart = await joints();
    assert.notDeepEqual(apart[0], apart[1]);
    assert.equal(await text(), "");
    await browser.evaluate(`document.querySelectorAll(".linked input")[1].click()`);
    await figures();
    // The other machine does not go beyond its limits.
    for (const [q2, theirs] of [["23°", "23°"], ["115°", "115°"], ["-69°", "115°"]]) {
        await browser.evaluate(`(() => {
            const field = [...document.querySelectorAll("[aria-label]")].find((one) => one.ariaLabel === "q2");
            field.value = "${q2}";
            field.dispatchEvent(new Event("change"));
        })()`);
        await figures();
        assert.deepEqual((await joints()).map((values) => values[1]), [q2, theirs]);
    }
    const totals = await browser.evaluate(`[...document.querySelectorAll(".verdict .total")].map(({ textContent }) => parseFloat(textContent))`);
    const [, difference, word] = /^(\S+) mm (less|more) than there$/.exec(await text());
    assert.ok(Math.abs((word === "more" ? 1 : -1) * Number(difference) - (totals[1] - totals[0])) < 2e-3, `${totals} ${difference} ${word}`);
    assert.deepEqual(browser.errors(), []);
});
