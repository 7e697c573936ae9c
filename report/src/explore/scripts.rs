//! Scripts and data inside of HTML.
//!
//! A script element ends at `</script`, and after `<!--` the browser looks for `<script` as well,
//! wherever they stand: also in a string or a comment.

use abbe_spec::visible::visible;
use abbe_study::explore::Report;

/// Returns the script of a machine, which adds the exports of its module to `abbeMachines`.
pub(super) fn machine(code: &str) -> String {
    let (code, exports) = without_exports(code);
    format!(
        "(globalThis.abbeMachines ??= []).push((() => {{\n\"use strict\";\n{}\nreturn {{ {} }};\n}})());",
        escaped(&code),
        exports.join(", ")
    )
}

/// Returns an element with a script that [`escaped`] was applied to.
pub(super) fn inline(script: &str) -> String {
    format!("<script>{script}</script>\n")
}

/// Returns an element with the data of a machine.
pub(super) fn data(report: &Report) -> String {
    // Infallible: maps have strings as keys, and infinite numbers are null.
    let json = report.data().expect("a report is JSON");
    // `<` stands in strings alone.
    let json = visible(&json).replace('<', "\\u003c");
    format!("<script type=\"application/json\" class=\"abbe-data\">{json}</script>\n")
}

/// Removes the word `export` from the lines of a module, and returns the exported names.
pub(super) fn without_exports(module: &str) -> (String, Vec<&str>) {
    let mut names = Vec::new();
    let mut code = String::with_capacity(module.len());
    for line in module.split_inclusive('\n') {
        let Some(declaration) = line.strip_prefix("export ") else {
            code += line;
            continue;
        };
        let words = declaration.split(|c: char| !(c.is_alphanumeric() || matches!(c, '_' | '$')));
        let declared =
            words.skip_while(|word| matches!(*word, "async" | "const" | "function" | "class" | ""));
        names.extend(declared.take(1));
        code += declaration;
    }
    (code, names)
}

/// Escapes JavaScript for a script element: no text in it ends the element. `\/`, `\s` and `\!` in
/// a string are `/`, `s` and `!`, and in a comment they mean nothing. Outside of both, `<` is
/// followed by none of them in the scripts of a page.
pub(super) fn escaped(script: &str) -> String {
    let mut escaped = String::with_capacity(script.len());
    let mut rest = script;
    while let Some(at) = rest.find('<') {
        let (before, after) = rest.split_at(at + 1);
        escaped += before;
        let begins =
            |text: &str| after.get(..text.len()).is_some_and(|begin| begin.eq_ignore_ascii_case(text));
        if begins("/script") || begins("script") || begins("!--") {
            escaped.push('\\');
        }
        rest = after;
    }
    escaped + rest
}

#[cfg(test)]
mod tests;
