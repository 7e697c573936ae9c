// Verdict: total error here, over the study and within the joint limits, against the tolerance.

import { button, html, setText, spans } from "./dom.js";
import { decimals, digits, parseValue, percent, roundedDown, short } from "./number.js";
import { cheapest } from "./cheapest.js";
import { factorAt } from "./search.js";
import { errorOf, times } from "./sources.js";
import { lengthOf } from "./residuals.js";
import { copyState } from "./state.js";
import { searchWorst } from "./worker.js";
/** @import { Panel } from "./panel.js" */

/** Formats an error with the decimals that show `largest` to four digits. @param {Panel} panel @param {number} value @param {number} [largest] */
function errorText({ unit: { factor, symbol } }, value, largest = value) {
    return `${errorOf(factor * value, decimals(factor * largest, 4))} ${symbol}`;
}

/** Creates the verdict here, and the worst cases. @param {Panel} panel */
export function createVerdict(panel) {
    const { report } = panel;
    const over = report.residuals ? "rows" : "study";
    const [status, total, share, stated, largest, parts, before] = spans("status", "total", "of", "of", "largest", "parts", "before");
    const [repeatable, random, mark] = [html("i", { class: "repeatable" }), html("i", { class: "random" }), html("b")];
    const field = html("input", { type: "text", class: "tolerance", placeholder: "type one", autocomplete: "off" });
    const live = html("div", { class: "live", role: "status" });
    const element = html("div", { class: "verdict" },
        html("p", { class: "line" }, status, total, share, html("label", {}, "tolerance ", field), stated),
        html("div", { class: "gauge", "aria-hidden": true }, repeatable, random, mark),
        html("p", { class: "detail" }, largest, parts, before), live);
    const [studyText, boxText, all] = [html("p"), html("p"), html("input", { type: "checkbox", checked: true })];
    const progress = html("progress", { max: 1, value: 0, hidden: true, "aria-label": "Search of the worst case" });
    const start = button("Find", () => void search(), { "aria-label": "Find the worst case within the joint limits" });
    const varied = [...report.inputs, ...report.parameters].filter(({ range }) => range?.[0] != null && range[1] != null).map(({ name }) => name);
    const show = button("Show", () => panel.load(worst()), { "aria-label": `Show the worst case in the ${over}` });
    /** Gives the sources other factors, rounded down to three digits. @param {number[]} factors */
    const scale = (factors) => panel.go({ ...copyState(panel.state), factors: factors.map((one) => Number(roundedDown(one, decimals(one || 1, 3)))) });
    const meet = button("Meet it", () => {
        const factor = factorAt(panel.cloud?.[panel.measurand].radius ?? 0, panel.tolerances[panel.measurand] ?? Infinity);
        scale(panel.state.factors.map((one) => one * (factor ?? 1)));
    }, { hidden: true, "aria-label": "Meet it: scale all sources alike so that the study keeps the tolerance" });
    const cheap = button("At least cost", () => {
        const { state, measurand, tolerances } = panel;
        const factors = cheapest(panel.machine, report, state, measurand, tolerances[measurand] ?? Infinity);
        if (factors) scale(factors);
        else setText(studyText, "No factors keep the tolerance: the errors that have none exceed it.");
    }, { hidden: true, title: "As abbe allocate does it: a factor x of a source costs 1/x and is at most 1, and smaller factors keep the tolerance, too",
        "aria-label": "At least cost: scale each source so that the study keeps the tolerance" });
    const searches = html("div", { class: "searches" }, html("div", {}, html("h2", {}, `Worst in the ${over}`), show, meet, cheap, studyText),
        report.variables.length === 0 ? "" : html("div", {}, html("h2", {}, "Worst within the joint limits"), start, progress, boxText,
            varied.length > 0 ? html("label", {}, all, `vary ${varied.join(", ")} too`) : ""));
    const shareText = (/** @type {number} */ radius, limit = panel.tolerances[panel.measurand]) =>
        (limit === null ? "" : `, ${percent(radius, limit)} of the tolerance`);
    field.addEventListener("change", () => {
        const value = field.value.trim() === "" ? null : parseValue(field.value, panel.unit.symbol, report.length) ?? NaN;
        const isWrong = value !== null && !(value > 0);
        field.setCustomValidity(isWrong ? `expected a positive number in ${panel.unit.symbol}, or nothing` : "");
        field.reportValidity();
        if (!isWrong) panel.tolerances[panel.measurand] = value;
        panel.refresh();
    });
    // Of rows, what was measured is worst, not what the sources of a spec predict.
    const rows = report.residuals?.rows ?? [];
    const measured = rows.map(({ before, after }) => lengthOf(before ?? after));
    const worst = () => measured.length > 0 && panel.measurand === "position" ? measured.indexOf(Math.max(...measured))
        : panel.cloud?.[panel.measurand].worst ?? 0;
    const rowText = () => {
        const { before, after } = rows[worst()];
        const rest = before ? `, ${report.residuals?.after} ${errorText(panel, lengthOf(after), measured[worst()])}` : "";
        return `${report.residuals?.before ?? report.residuals?.after} ${errorText(panel, measured[worst()])}${rest} at line ${rows[worst()].line}`;
    };
    let [running, searched] = [/** @type {AbortController | null} */ (null), ""];
    const key = () => String([panel.measurand, panel.tolerances[panel.measurand], panel.state.s, panel.state.u, panel.state.factors]);
    /** Finds the worst case and shows it; a second click stops the search. */
    async function search() {
        if (running) return running.abort();
        running = new AbortController();
        const [{ signal }, { measurand, index, state }] = [running, panel];
        const task = { report, index, state, options: { measurand, inputs: all.checked, parameters: all.checked } };
        progress.hidden = false;
        setText(start, "Stop");
        try {
            const found = await searchWorst(task, (part) => { progress.value = part; }, signal);
            panel.go(found.state, all.checked ? found.state : undefined);
            searched = key();
            setText(boxText, `${errorText(panel, found.radius)}${shareText(found.radius)}; largest of ${found.evaluations} configurations.`);
        } catch (error) {
            setText(boxText, signal.aborted ? "Stopped." : String(error));
        }
        running = null;
        progress.hidden = true;
        setText(start, "Find again");
    }
    function update() {
        const { figures, reference, measurand, unit, tolerances, cloud } = panel;
        const { radius, repeatableRadius, randomRadius, shares } = figures[measurand];
        const limit = tolerances[measurand];
        const isMet = limit !== null && radius <= limit;
        const isOpen = report.has_loops && !Number.isFinite(figures.position.radius);
        // A study of the compensated machine judges what this page does not compute.
        const isJudged = limit !== null && report.study.judged === "as-built";
        element.classList.toggle("missed", isOpen || (isJudged && !isMet));
        setText(status, isOpen ? "✗ The loops do not close here" : !isJudged ? rows.length > 0 ? "Predicted, here" : "As built, here" : isMet ? "✓ Within tolerance here" : "✗ Above tolerance here");
        setText(total, isOpen ? "" : errorText(panel, radius));
        setText(share, limit === null || isOpen ? "" : `${percent(radius, limit)} of`);
        if (document.activeElement !== field) field.value = limit === null ? "" : `${short(unit.factor * limit)} ${unit.symbol}`;
        const own = measurand === "position" ? report.study.tolerance : report.study.orientation_tolerance;
        const ownText = own === null ? "none" : `${short(unit.factor * own)} ${unit.symbol}`;
        setText(stated, limit === own ? "" : `(of the study: ${ownText})`);
        const end = Math.max(radius, (limit ?? 0) * 1.25) || 1;
        [repeatable.style.width, random.style.width, mark.style.left] =
            [repeatableRadius, randomRadius, limit ?? 0].map((value) => `${(100 * value) / end}%`);
        mark.hidden = limit === null;
        const most = Math.max(...shares);
        setText(largest, radius > 0 ? `largest source: ${report.sources[shares.indexOf(most)].name} (${percent(most, 1)})` : "");
        const by = report.study.criterion === "rss" ? "root sum of squares" : "worst case";
        setText(parts, isOpen ? "" : `${by}: repeatable ${errorText(panel, repeatableRadius, radius)} + others ${errorText(panel, randomRadius, radius)}`);
        const old = reference?.[measurand].radius ?? 0;
        const change = old > 0 ? ` (${radius < old ? "−" : "+"}${digits((100 * Math.abs(radius - old)) / old, 2)} %)` : "";
        setText(before, reference ? `before your changes ${errorText(panel, old, radius)}${change}` : "");
        if (searched !== key()) setText(boxText, "");
        const study = cloud?.[measurand];
        meet.hidden = cheap.hidden = !study || limit === null || !isJudged || rows.length > 0 || study.radius <= limit;
        if (!study) return;
        const scaled = limit === null || !(study.radius > 0) ? "" : ` Tolerance met with all sources ${times(factorAt(study.radius, limit))}.`;
        const count = study.radii.filter((one) => limit !== null && one <= limit).length;
        const within = limit === null || !isJudged ? "" : ` ${count} of ${study.radii.length} within.`;
        if (rows.length > 0 && measurand === "position") return setText(studyText, `${rowText()}. Predicted: at most ${errorText(panel, study.radius)}.`);
        setText(studyText, `${errorText(panel, study.radius)}${shareText(study.radius)} at configuration ${study.worst + 1} of ${study.radii.length}.${within}${scaled}`);
    }
    const settle = () => setText(live, [status, total, share, largest].map(({ textContent }) => textContent).join(" "));
    return { element, searches, update, settle };
}
