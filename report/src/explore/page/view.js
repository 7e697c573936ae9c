// Picture of the arm in parallel projection, with the exaggerated real machine and the error of the tool point.

import { jointEnds } from "./controls.js";
import { followed } from "./drag.js";
import { button, createNote, html, moveTo, nearest, onResize, path, paths, roundStep, setText, svg } from "./dom.js";
import { quantity } from "./number.js";
import { replaced } from "./search.js";
/** @import { Tell } from "./dom.js" @import { Panel } from "./panel.js" */

/** Points in the picture, with their key. @typedef {{keys: Element[], marks: SVGElement[], draw: (project: (point: number[]) => number[]) => void, listen: (stage: HTMLElement, tell: Tell) => void}} Points */

/** Number of configurations of the study that give the size of the picture, and of points on the path of a joint. */
const [SAMPLES, PATH_POINTS] = [200, 48];
/** Lengths of the error vector, by which the magnification is chosen, and of axes; parts of the machine's size. */
const [VECTOR, AXIS] = [0.12, 0.07];
/** Direction to the viewer in degrees: azimuth from the first horizontal axis to the second, and elevation. */
const DIRECTION = [38, 24];
/** Degrees to the right and down, and zoom factor. @type {Record<string, number[]>} */
const KEYS = { ArrowLeft: [-6, 0, 1], ArrowRight: [6, 0, 1], ArrowUp: [0, 6, 1], ArrowDown: [0, -6, 1], "+": [0, 0, 1.25], "-": [0, 0, 0.8] };

/** @param {number[]} frame @returns {number[]} its origin */
const originOf = (frame) => [frame[9], frame[10], frame[11]];

/** Creates the picture: the tool point is dragged to move the joints; elsewhere drag or arrow keys turn it; pinch, + and -, and with the focus the wheel zoom. @param {Panel} panel @param {Points[]} measured */
export function createView(panel, measured) {
    const { report, machine, generated } = panel;
    const { up, frames, variables } = report;
    const [ground, all] = [[(up + 1) % 3, (up + 2) % 3], report.configurations.q];
    const chosen = [panel.state.q, ...all.filter((_, i) => i % Math.ceil(all.length / SAMPLES) === 0)];
    const samples = chosen.flatMap((q) => machine.frames({ ...panel.state, q }, 0).ideal.map(originOf)).filter((point) => point.every(Number.isFinite));
    const ends = [0, 1, 2].map((i) => [Math.min(...samples.map((point) => point[i])), Math.max(...samples.map((point) => point[i]))]);
    const size = Math.max(...ends.map(([least, most]) => most - least)) || 1;
    const grid = roundStep(size / 6);
    let [azimuth, elevation] = DIRECTION;
    let [zoom, scale, magnification, sides, middle, tool] = [1, 1, 0, [0, 0], [0, 0], [0, 0]];
    /** Pointer that drags the tool point. @type {number | null} */
    let dragging = null;
    const circle = (/** @type {string} */ name) => svg("circle", { class: name, r: 4 });
    const [floor, reach, ghost, links, vector] = paths("floor", "reach", "ghost", "links", "vector");
    const axes = paths("axis x", "axis y", "axis z");
    const names = ["x", "y", "z"].map((name) => svg("text", { class: `axis ${name}`, x: 3, y: 3 }, name));
    const [origins, labels] = [frames.map(() => circle("origin")), [...frames, 0].map(() => svg("text", { x: 8, y: -8 }))];
    const note = createNote();
    const [tolerance, bound, tip] = [circle("tolerance"), circle("random"), circle("tip")];
    const drawing = svg("svg", { "aria-hidden": true }, floor, reach, tolerance, ghost, links, ...measured.flatMap(({ marks }) => marks), ...axes,
        ...origins, bound, vector, tip, ...names, ...labels, note.element);
    const stage = html("div", { class: "stage", tabindex: 0, role: "application",
        "aria-label": "Picture of the manipulator: arrow keys turn it, + and - zoom, 0 resets; the joints move the tool point" }, drawing);
    const [ideal, real, limit] = ["ideal", "real", "tolerance"].map((name) => html("span", { class: `key ${name}` }, html("i"), html("span", {}, name)));
    const element = html("figure", { class: "view" }, stage, html("figcaption", {}, ideal, real, limit, ...measured.flatMap(({ keys }) => keys),
        `grid ${quantity(grid, report.length)}`, html("span", { class: "buttons" },
            button("−", () => turn(0, 0, 0.8), { "aria-label": "Zoom out" }),
            button("+", () => turn(0, 0, 1.25), { "aria-label": "Zoom in" }), button("Reset view", reset))));

    /** Returns the projection to pixels from the middle, at scale 1. @returns {(point: number[]) => number[]} */
    function camera() {
        const [a, b] = [azimuth, elevation].map((angle) => (angle * Math.PI) / 180);
        const columns = [[0, 0], [0, 0], [0, 0]];
        [columns[ground[0]], columns[ground[1]], columns[up]] = [[-Math.sin(a), Math.cos(a) * Math.sin(b)],
            [Math.cos(a), Math.sin(a) * Math.sin(b)], [0, -Math.cos(b)]];
        return (point) => [0, 1].map((i) => point[0] * columns[0][i] + point[1] * columns[1][i] + point[2] * columns[2][i]);
    }
    /** Turns by degrees and zooms. @param {number} right @param {number} down @param {number} factor */
    function turn(right, down, factor) {
        [azimuth, elevation] = [azimuth - right, Math.min(90, Math.max(-90, elevation + down))];
        zoom = Math.min(40, Math.max(0.2, zoom * factor));
        panel.refresh();
    }
    /** Chooses direction, scale and middle so that all samples are visible. */
    function reset() {
        [[azimuth, elevation], zoom] = [DIRECTION, 1];
        const points = samples.map(camera());
        const bounds = [0, 1].map((i) => [Math.min(...points.map((point) => point[i])), Math.max(...points.map((point) => point[i]))]);
        scale = Math.min(...bounds.map(([least, most], i) => (sides[i] - 40) / (most - least + VECTOR * size)));
        middle = bounds.map(([least, most]) => (least + most) / 2);
        panel.refresh();
    }
    /** Returns the path of the grid on the floor. @param {(point: number[]) => number[]} project */
    function floorPath(project) {
        const [across, along] = ground.map((axis) => [Math.floor(ends[axis][0] / grid), Math.ceil(ends[axis][1] / grid)]);
        const line = (/** @type {number[][]} */ cells) => path(cells.map((cell) =>
            project([0, 1, 2].map((axis) => (axis === up ? 0 : cell[ground.indexOf(axis)] * grid)))));
        const steps = ([from, to] = across) => Array.from({ length: to - from + 1 }, (_, i) => from + i);
        return [...steps(across).map((i) => line(along.map((j) => [i, j]))), ...steps(along).map((j) => line(across.map((i) => [i, j])))].join("");
    }
    /** Writes the numbers of the frames beside their origins; frames at one place share a label. @param {number[][]} places */
    function writeLabels(places) {
        const first = places.map(([x, y]) => places.findIndex((other) => Math.hypot(other[0] - x, other[1] - y) < 14));
        labels.forEach((label, i) => {
            setText(label, [...frames.map((_, k) => k + 1), "tool"].filter((_, k) => first[k] === i).join(", "));
            moveTo(label, places[i]);
        });
    }
    /** Returns the projection to pixels. @returns {(point: number[]) => number[]} */
    function projection() {
        const flat = camera();
        return (point) => flat(point).map((value, i) => sides[i] / 2 + zoom * scale * (value - middle[i]));
    }
    function update() {
        if (sides[0] === 0) return;
        const { state, figures, tolerances, joint } = panel;
        if (magnification === 0) magnify();
        const [project, poses] = [projection(), machine.frames(state, magnification)];
        const places = poses.ideal.map((frame) => project(originOf(frame)));
        tool = places[places.length - 1];
        const error = project(originOf(figures.pose).map((value, i) => value + magnification * figures.displacement[i]));
        // Path of the tool point while the joint that was moved last moves between its limits.
        const [least, most] = variables.length > 0 ? jointEnds(report, joint) : [0, 0];
        const moved = Array.from({ length: PATH_POINTS + 1 }, (_, i) =>
            Array.from(generated.pose(replaced(state.q, joint, least + ((most - least) * i) / PATH_POINTS), state.s)));
        floor.setAttribute("d", floorPath(project));
        const lines = (/** @type {number[][]} */ all) => path(report.links.flatMap(([from, to]) => [all[from], all[to], [NaN, NaN]]));
        links.setAttribute("d", lines(places));
        reach.setAttribute("d", path(moved.map((pose) => project(originOf(pose)))));
        ghost.setAttribute("d", poses.real.length > 0 ? lines(poses.real.map((pose) => project(originOf(pose)))) : "");
        vector.setAttribute("d", arrow(tool, error));
        axes.forEach((line, k) => {
            const tips = poses.ideal.map((frame) => project(originOf(frame).map((value, r) => value + AXIS * size * frame[3 * k + r])));
            line.setAttribute("d", tips.map((to, i) => path([places[i], to])).join(""));
            moveTo(names[k], tips[0]);
        });
        origins.forEach((one, i) => moveTo(one, places[i + 1]));
        writeLabels(places.slice(1));
        [tip, tolerance, bound].forEach((one) => moveTo(one, one === bound ? error : tool));
        tolerance.setAttribute("r", String(scale * zoom * magnification * (tolerances.position ?? 0)));
        bound.setAttribute("r", String(scale * zoom * magnification * figures.position.randomRadius));
        limit.hidden = tolerances.position === null;
        measured.forEach(({ draw }) => draw(project));
    }
    /** Chooses the round magnification at which the error, or else the tolerance, has a good length. */
    function magnify() {
        const length = panel.figures.position.radius || panel.tolerances.position || Infinity;
        magnification = Math.max(1, roundStep((VECTOR * size) / length));
        setText(real.children[1], `${report.has_loops ? "error of the tool point" : "real, errors"} × ${magnification}`);
    }
    /** Where the tool point was when it was taken, from the pointer. */
    let grip = tool;
    const isAtTool = (/** @type {MouseEvent} */ event) => variables.length > 0 && nearest(stage, [tool], event) === 0;
    /** Moves the joints so that the tool point is at a place, in pixels. @param {number} x @param {number} y */
    function drag(x, y) {
        stage.classList.add("dragged");
        const project = projection();
        panel.change((state) => {
            state.q = followed(report, state.q, (q) => project(originOf(Array.from(generated.pose(q, state.s)))), [x, y]);
        });
    }
    /** @type {Map<number, number[]>} */
    const pointers = new Map();
    const spread = ([a, b] = [...pointers.values()]) => (b ? Math.hypot(a[0] - b[0], a[1] - b[1]) : 0);
    stage.addEventListener("pointermove", ({ pointerId, clientX, clientY }) => {
        const [last, before] = [pointers.get(pointerId), spread()];
        if (!last) return;
        pointers.set(pointerId, [clientX, clientY]);
        if (pointerId === dragging) drag(clientX - grip[0], clientY - grip[1]);
        else if (before > 0) turn(0, 0, spread() / before);
        else turn(0.4 * (clientX - last[0]), 0.4 * (clientY - last[1]), 1);
    });
    stage.addEventListener("pointerdown", (event) => {
        if (isAtTool(event) && pointers.size === 0) [dragging, grip] = [event.pointerId, [event.clientX - tool[0], event.clientY - tool[1]]];
        stage.setPointerCapture(event.pointerId);
    });
    stage.addEventListener("gotpointercapture", ({ pointerId, clientX, clientY }) => pointers.set(pointerId, [clientX, clientY]));
    stage.addEventListener("lostpointercapture", ({ pointerId }) => {
        pointers.delete(pointerId);
        if (pointerId === dragging) dragging = null;
        stage.classList.remove("dragged");
    });
    stage.addEventListener("wheel", (event) => {
        // Without the focus the page scrolls.
        if (document.activeElement !== stage) return;
        event.preventDefault();
        turn(0, 0, Math.exp(-0.0015 * event.deltaY));
    }, { passive: false });
    stage.addEventListener("keydown", (event) => {
        const [right, down, factor] = KEYS[event.key] ?? [];
        if (event.key === "0") reset();
        if (factor === undefined || event.ctrlKey || event.metaKey) return;
        event.preventDefault();
        turn(right, down, factor);
    });
    measured.forEach(({ listen }) => listen(stage, note.tell));
    stage.addEventListener("pointermove", (event) => {
        if (event.buttons === 0 && isAtTool(event)) note.tell(tool, "tool point: drag it");
    });
    onResize(drawing, (resized) => (sides = resized, reset()));
    return { element, update, settle: () => (magnify(), update()) };
}

/** Returns the path of an arrow. @param {number[]} from @param {number[]} to */
function arrow(from, to) {
    const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
    if (length < 1) return "";
    const [u, v] = [0, 1].map((i) => ((to[i] - from[i]) / length) * Math.min(9, length / 2));
    return path([from, to]) + path([[to[0] - u - v / 2, to[1] - v + u / 2], to, [to[0] - u + v / 2, to[1] - v - u / 2]]);
}
