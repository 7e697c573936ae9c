// Picture of the arm in parallel projection, with the exaggerated real machine and the error of the tool point.

import { jointEnds } from "./controls.js";
import { button, html, onResize, path, roundStep, setText, svg } from "./dom.js";
import { quantity } from "./number.js";

/** @import { Panel } from "./panel.js" */

/** Number of random configurations that give the size of the picture, and of points on the path of a joint. */
const [SAMPLES, PATH_POINTS] = [200, 48];
/** Length of the error vector by which the magnification is chosen, as a fraction of the size of the machine. */
const VECTOR = 0.12;
/** Direction to the viewer in degrees: azimuth from the first horizontal axis to the second, and elevation. */
const DIRECTION = [38, 24];
const MAGNIFICATIONS = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000, 100000];

/** @param {ArrayLike<number>} frame @returns {number[]} its origin */
const originOf = (frame) => [frame[9], frame[10], frame[11]];

/** Returns origins of frames and tool points at home and at random configurations. @param {Panel} panel */
function samples({ report, machine, state }) {
    let seed = 1;
    const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647;
    return Array.from({ length: SAMPLES }, (_, i) => {
        const q = report.variables.map(({ home }, joint) => {
            const [least, most] = jointEnds(report, joint);
            return i === 0 ? home : least + (most - least) * random();
        });
        return machine.frames({ ...state, q }, 0).ideal.map(originOf);
    }).flat();
}

/** Creates the picture: drag or arrow keys turn it; wheel, pinch, + and − zoom. @param {Panel} panel */
export function createView(panel) {
    const { report, machine } = panel;
    const up = report.up;
    const ground = [(up + 1) % 3, (up + 2) % 3];
    const cloud = samples(panel);
    const ends = [0, 1, 2].map((i) => [Math.min(0, ...cloud.map((p) => p[i])), Math.max(0, ...cloud.map((p) => p[i]))]);
    const centre = ends.map(([least, most]) => (least + most) / 2);
    const size = Math.max(...ends.map(([least, most]) => most - least)) || 1;
    const grid = roundStep(size / 6);
    let [azimuth, elevation] = DIRECTION;
    let [zoom, width, height, scale, offset, magnification] = [1, 0, 0, 1, [0, 0], 0];

    const layer = (/** @type {string} */ name) => svg("path", { class: name });
    const circle = (/** @type {string} */ name, r = 4) => svg("circle", { class: name, r });
    const [floor, reach, ghost, links, vector] = ["floor", "reach", "ghost", "links", "vector"].map(layer);
    const axes = ["x", "y", "z"].map((name) => ({ line: layer(`axis ${name}`), text: svg("text", { class: `axis ${name}` }, name) }));
    const origins = report.frames.map(() => circle("origin"));
    const labels = [...report.frames, 0].map(() => svg("text"));
    const [tolerance, random, tip] = [circle("tolerance"), circle("random"), circle("tip", 4.5)];
    const drawing = svg("svg", { "aria-hidden": true }, floor, reach, tolerance, ghost, links, ...axes.map(({ line }) => line),
        ...origins, random, vector, tip, ...axes.map(({ text }) => text), ...labels);
    const stage = html("div", { class: "stage", tabindex: 0, role: "application",
        "aria-label": "Picture of the manipulator: arrow keys turn it, + and − zoom, 0 resets" }, drawing);
    const automatic = html("option", { value: "" });
    const chosen = html("select", { "aria-label": "Magnification of the errors" }, automatic,
        ...MAGNIFICATIONS.map((factor) => html("option", { value: factor }, `× ${factor}`)));
    const key = (/** @type {string} */ name, /** @type {(string | Node)[]} */ ...text) =>
        html("span", { class: "key" }, html("i", { class: `key-${name}` }), ...text);
    const toleranceKey = key("tolerance", "tolerance");
    const element = html("figure", { class: "view" }, stage, html("figcaption", {}, key("ideal", "ideal"),
        key("real", "real, errors ", chosen), toleranceKey, html("span", {}, `grid ${quantity(grid, report.length)}`),
        html("span", { class: "buttons" }, button("−", () => turn(0, 0, 0.8), { "aria-label": "Zoom out" }),
            button("+", () => turn(0, 0, 1.25), { "aria-label": "Zoom in" }), button("Reset view", reset))));

    /** Returns pixels to the right and down of 1 along each axis, at scale 1. */
    function camera() {
        const [a, b] = [(azimuth * Math.PI) / 180, (elevation * Math.PI) / 180];
        const columns = [[0, 0], [0, 0], [0, 0]];
        columns[ground[0]] = [-Math.sin(a), Math.cos(a) * Math.sin(b)];
        columns[ground[1]] = [Math.cos(a), Math.sin(a) * Math.sin(b)];
        columns[up] = [0, -Math.cos(b)];
        return (/** @type {number[]} */ point) =>
            [0, 1].map((i) => point.reduce((sum, value, k) => sum + (value - centre[k]) * columns[k][i], 0));
    }

    /** Chooses the scale and the offset at which all configurations are visible. */
    function fit() {
        const points = cloud.map(camera());
        const sides = [width, height];
        const bounds = sides.map((_, i) => [Math.min(...points.map((p) => p[i])), Math.max(...points.map((p) => p[i]))]);
        scale = Math.min(...bounds.map(([least, most], i) => (sides[i] - 72) / (most - least || size)));
        offset = bounds.map(([least, most], i) => (sides[i] - scale * (least + most)) / 2);
    }

    /** Turns by degrees and zooms. @param {number} right @param {number} downwards @param {number} [factor] */
    function turn(right, downwards, factor = 1) {
        azimuth -= right;
        elevation = Math.min(90, Math.max(-90, elevation + downwards));
        zoom = Math.min(40, Math.max(0.2, zoom * factor));
        panel.refresh();
    }

    function reset() {
        [[azimuth, elevation], zoom] = [DIRECTION, 1];
        fit();
        panel.refresh();
    }

    /** Chooses the round magnification at which the error, or else the tolerance, has a good length. */
    function magnify() {
        const { figures, tolerances } = panel;
        const length = figures.position.radius || tolerances.position || 0;
        magnification = Number(chosen.value) || (length > 0 ? Math.min(1e5, roundStep((VECTOR * size) / length)) : 1);
        setText(automatic, `× ${magnification} (auto)`);
    }

    /** Returns the path of the grid on the floor. @param {(point: number[]) => number[]} project */
    function floorPath(project) {
        const [across, along] = ground.map((axis) => ends[axis].map((end, i) => (i ? Math.ceil(end / grid) : Math.floor(end / grid))));
        const line = (/** @type {number[][]} */ places) => path(places.map(([i, j]) => {
            const at = [0, 0, 0];
            [at[ground[0]], at[ground[1]]] = [i * grid, j * grid];
            return project(at);
        }));
        const count = ([from, to] = across) => Array.from({ length: to - from + 1 }, (_, i) => from + i);
        return [...count(across).map((i) => line([[i, along[0]], [i, along[1]]])),
            ...count(along).map((j) => line([[across[0], j], [across[1], j]]))].join("");
    }

    /** Returns points of the tool while the joint that was moved last moves between its limits. */
    function toolPath() {
        const { state, joint, generated } = panel;
        if (report.variables.length === 0) return [];
        const [least, most] = jointEnds(report, joint);
        return Array.from({ length: PATH_POINTS + 1 }, (_, i) =>
            originOf(generated.pose(state.q.with(joint, least + ((most - least) * i) / PATH_POINTS), state.s)));
    }

    /** Writes the numbers of the frames beside their origins; frames at one place share a label. @param {number[][]} places */
    function writeLabels(places) {
        const taken = /** @type {{at: number[], names: string[]}[]} */ ([]);
        places.forEach((at, i) => {
            const name = i < report.frames.length ? String(i + 1) : "tool";
            const near = taken.find((other) => Math.hypot(other.at[0] - at[0], other.at[1] - at[1]) < 14);
            if (near) near.names.push(name);
            else taken.push({ at, names: [name] });
        });
        labels.forEach((label, i) => {
            setText(label, taken[i]?.names.join(", ") ?? "");
            moveTo(label, taken[i]?.at ?? [0, 0], 8, -8);
        });
    }

    function update() {
        const { state, figures, tolerances } = panel;
        if (width === 0) return;
        if (magnification === 0) magnify();
        const { ideal, real } = machine.frames(state, magnification);
        const flat = camera();
        const project = (/** @type {number[]} */ point) => flat(point).map((value, i) => {
            const middle = [width, height][i] / 2;
            return middle + zoom * (offset[i] + scale * value - middle);
        });
        const places = ideal.map((frame) => project(originOf(frame)));
        const [end, tool] = [originOf(ideal[ideal.length - 1]), places[places.length - 1]];
        const error = project(end.map((value, i) => value + magnification * figures.displacement[i]));
        const pixels = scale * zoom * magnification;
        floor.setAttribute("d", floorPath(project));
        reach.setAttribute("d", path(toolPath().map(project)));
        links.setAttribute("d", path(places));
        ghost.setAttribute("d", path(real.map((frame) => project(originOf(frame)))));
        vector.setAttribute("d", arrow(tool, error));
        axes.forEach(({ line, text }, k) => {
            const tips = ideal.map((frame) => project(originOf(frame).map((value, r) => value + 0.07 * size * frame[3 * k + r])));
            line.setAttribute("d", tips.map((to, i) => path([places[i], to])).join(""));
            moveTo(text, tips[0], 3, 3);
        });
        origins.forEach((one, i) => moveTo(one, places[i + 1]));
        writeLabels(places.slice(1));
        [tip, tolerance, random].forEach((one, i) => moveTo(one, i === 2 ? error : tool));
        tolerance.setAttribute("r", String(pixels * (tolerances.position ?? 0)));
        random.setAttribute("r", String(pixels * figures.position.randomRadius));
        toleranceKey.hidden = tolerances.position === null;
    }

    /** @type {Map<number, number[]>} */
    const pointers = new Map();
    const spread = ([a, b] = [...pointers.values()]) => Math.hypot(a[0] - b[0], a[1] - b[1]);
    stage.addEventListener("pointerdown", ({ pointerId, clientX, clientY }) => {
        pointers.set(pointerId, [clientX, clientY]);
        stage.setPointerCapture(pointerId);
    });
    stage.addEventListener("pointermove", ({ pointerId, clientX, clientY }) => {
        const last = pointers.get(pointerId);
        if (!last) return;
        const before = pointers.size === 2 ? spread() : 0;
        pointers.set(pointerId, [clientX, clientY]);
        if (before > 0) turn(0, 0, spread() / before);
        else turn(0.4 * (clientX - last[0]), 0.4 * (clientY - last[1]));
    });
    for (const name of /** @type {const} */ (["pointerup", "pointercancel"])) {
        stage.addEventListener(name, ({ pointerId }) => pointers.delete(pointerId));
    }
    stage.addEventListener("wheel", (event) => {
        event.preventDefault();
        turn(0, 0, Math.exp(-0.0015 * event.deltaY));
    }, { passive: false });
    const keys = /** @type {Record<string, number[]>} */ ({ ArrowLeft: [-6, 0], ArrowRight: [6, 0], ArrowUp: [0, 6],
        ArrowDown: [0, -6], "+": [0, 0, 1.25], "-": [0, 0, 0.8] });
    stage.addEventListener("keydown", (event) => {
        if (event.ctrlKey || event.metaKey || !(event.key === "0" || keys[event.key])) return;
        event.preventDefault();
        if (event.key === "0") reset();
        else turn(keys[event.key][0], keys[event.key][1], keys[event.key][2]);
    });
    chosen.addEventListener("change", () => {
        magnify();
        panel.refresh();
    });
    onResize(stage, (newWidth, newHeight) => {
        [width, height] = [newWidth, newHeight];
        drawing.setAttribute("viewBox", `0 0 ${width} ${height}`);
        fit();
        panel.refresh();
    });
    return { element, update, settle: () => { magnify(); update(); } };
}

/** Moves a circle or a text. @param {SVGElement} element @param {number[]} at @param {number} [right] @param {number} [down] */
function moveTo(element, at, right = 0, down = 0) {
    const [x, y] = element instanceof SVGCircleElement ? ["cx", "cy"] : ["x", "y"];
    element.setAttribute(x, (at[0] + right).toFixed(1));
    element.setAttribute(y, (at[1] + down).toFixed(1));
}

/** Returns the path of an arrow. @param {number[]} from @param {number[]} to */
function arrow(from, to) {
    const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
    if (length < 1) return "";
    const [u, v] = [0, 1].map((i) => ((to[i] - from[i]) / length) * Math.min(9, length / 2));
    return path([from, to]) + path([[to[0] - u - v / 2, to[1] - v + u / 2], to, [to[0] - u + v / 2, to[1] - v - u / 2]]);
}
