// Chromium, driven as a user does it: mouse, keyboard, and what is on the screen.

import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

/** Starts a browser with one page, over the DevTools protocol on a pipe. @param {{width: number, height: number}} size */
export async function startBrowser(size) {
    const folder = mkdtempSync(join(tmpdir(), "abbe-browser-"));
    const options = ["--headless", "--no-sandbox", "--disable-gpu", "--remote-debugging-pipe", `--user-data-dir=${folder}`, "about:blank"];
    const browser = spawn("chromium", options, { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    const [input, output] = browser.stdio.slice(3);
    const waiting = new Map();
    const events = [];
    let [rest, last] = ["", 0];
    output.setEncoding("utf8").on("data", (text) => {
        const messages = (rest + text).split("\0");
        rest = messages.pop();
        for (const message of messages.map((one) => JSON.parse(one))) {
            if (message.id === undefined) events.push(message);
            const { resolve, reject } = waiting.get(message.id) ?? {};
            waiting.delete(message.id);
            if (message.error) reject?.(new Error(JSON.stringify(message.error)));
            else resolve?.(message.result);
        }
    });
    let sessionId;
    const send = (method, params = {}) => new Promise((resolve, reject) => {
        waiting.set((last += 1), { resolve, reject });
        input.write(`${JSON.stringify({ id: last, method, params, sessionId })}\0`);
    });
    const { targetInfos } = await send("Target.getTargets");
    const { targetId } = targetInfos.find(({ type }) => type === "page");
    ({ sessionId } = await send("Target.attachToTarget", { targetId, flatten: true }));
    await send("Page.enable");
    await send("Runtime.enable");
    await send("Log.enable");
    await send("Emulation.setDeviceMetricsOverride", { ...size, deviceScaleFactor: 1, mobile: false });

    /** Evaluates an expression in the page, and waits for it if it is a promise. */
    const evaluate = async (expression) => {
        const { result, exceptionDetails } = await send("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
        if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
        return result.value;
    };
    /** Presses and releases the mouse at a point. */
    const click = async (x, y, clickCount = 1) => {
        for (const type of ["mousePressed", "mouseReleased"]) await send("Input.dispatchMouseEvent", { type, x, y, button: "left", clickCount });
    };
    return {
        evaluate,
        click,
        /** Opens a page. */
        async open(url) {
            // Another address with the same path would only change the part behind `#`.
            await send("Page.navigate", { url: "about:blank" });
            await send("Page.navigate", { url });
            await evaluate("new Promise((done) => (document.readyState === 'complete' ? done() : addEventListener('load', done)))");
        },
        /** Returns errors of the console and exceptions so far. */
        errors: () => events.flatMap(({ method, params }) => {
            if (method === "Runtime.exceptionThrown") return [params.exceptionDetails.exception?.description ?? params.exceptionDetails.text];
            return method === "Log.entryAdded" && params.entry.level === "error" ? [params.entry.text] : [];
        }),
        /** Drags the mouse. */
        async drag([x, y], [toX, toY]) {
            await send("Input.dispatchMouseEvent", { type: "mousePressed", x, y, button: "left", clickCount: 1 });
            for (const part of [0.5, 1]) {
                await send("Input.dispatchMouseEvent", { type: "mouseMoved", x: x + part * (toX - x), y: y + part * (toY - y), button: "left", buttons: 1 });
            }
            await send("Input.dispatchMouseEvent", { type: "mouseReleased", x: toX, y: toY, button: "left", clickCount: 1 });
        },
        /** Moves the mouse. */
        hover: ([x, y]) => send("Input.dispatchMouseEvent", { type: "mouseMoved", x, y }),
        /** Presses a key that has a name. */
        async press(key) {
            const windowsVirtualKeyCode = { Tab: 9, Enter: 13, Escape: 27, ArrowLeft: 37, ArrowRight: 39 }[key];
            const text = key === "Enter" ? "\r" : undefined;
            await send("Input.dispatchKeyEvent", { type: text ? "keyDown" : "rawKeyDown", key, code: key, windowsVirtualKeyCode, text });
            await send("Input.dispatchKeyEvent", { type: "keyUp", key, code: key, windowsVirtualKeyCode });
        },
        /** Types a text. */
        type: (text) => send("Input.insertText", { text }),
        /** Closes the browser. */
        async close() {
            const closed = new Promise((done) => browser.on("exit", done));
            await send("Browser.close");
            await closed;
            rmSync(folder, { recursive: true, force: true });
        },
    };
}
