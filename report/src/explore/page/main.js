// Start of the page: a panel for each machine; in a worker, the search.

import { mount } from "./panel.js";
import { generatedCode, serve } from "./worker.js";

if (typeof document === "undefined") serve(/** @type {any} */ (globalThis));
else {
    const data = document.querySelectorAll("script.abbe-data");
    document.querySelectorAll("section.abbe-panel").forEach((section, index) =>
        mount(section, generatedCode(index), JSON.parse(data[index].textContent ?? ""), index));
}
