//! Modules of the page, joined to one script.

use super::scripts::{escaped, without_exports};

/// Names and texts of modules in `page/`.
macro_rules! modules {
    ($($name:literal)*) => {
        [$(($name, include_str!(concat!("page/", $name)))),*]
    };
}

/// All modules; each imports from earlier ones only.
const MODULES: &[(&str, &str)] = &modules![
    "number.js" "dom.js" "state.js" "command.js" "worst_case.js" "machine.js" "search.js" "cheapest.js" "worker.js" "controls.js" "sources.js" "residuals.js" "workspace.js"
    "drag.js" "view.js" "charts.js" "tables.js" "pins.js" "linked.js" "save.js" "verdict.js" "panel.js" "main.js"
];

/// Returns the script: every module without its imports and the words `export`. Names are unique
/// over all modules.
pub(super) fn script() -> String {
    let modules = MODULES.iter().map(|(_, module)| without_exports(&without_imports(module)).0);
    format!("(() => {{\n\"use strict\";\n{}}})();", escaped(&modules.collect::<String>()))
}

/// Removes the imports, one line each, at the top.
fn without_imports(module: &str) -> String {
    module.split_inclusive('\n').filter(|line| !line.starts_with("import ")).collect()
}

#[cfg(test)]
mod tests;
