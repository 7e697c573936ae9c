//! PLCopen documents (TC6 XML 2.01), which development environments import with all types, blocks
//! and variables at once.

use std::str::Lines;

use crate::print::fmu::escaped;

/// Returns a file of Structured Text as a document. Comments before units and variables become
/// their documentation.
pub(in crate::print) fn document(name: &str, text: &str) -> String {
    let [mut types, mut units, mut head, mut said] = [const { String::new() }; 4];
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        if line.starts_with("(*") {
            said = comment(line, &mut lines);
        } else if line == "TYPE" {
            head = std::mem::take(&mut said);
            types = declared("dataType", &until("END_TYPE", &mut lines));
        } else if let Some((kind, head)) = line.split_once(' ') {
            let kind = if kind == "FUNCTION" { "function" } else { "functionBlock" };
            units += &unit(kind, head, &mut lines, &std::mem::take(&mut said));
        }
    }
    let inserted = [env!("CARGO_PKG_VERSION"), name, &marked(&head), types.trim_end(), units.trim_end(), ""];
    DOCUMENT.split('$').zip(inserted).flat_map(|(text, inserted)| [text, inserted]).collect()
}

/// Text with a `$` where something is inserted. The same spec gives the same bytes, whenever it is
/// printed.
const DOCUMENT: &str = include_str!("plcopen.xml");

/// Escapes markup, and keeps lines.
fn marked(text: &str) -> String {
    text.lines().map(escaped).collect::<Vec<_>>().join("\n")
}

/// Returns the words of a comment that begins with a line.
fn comment(first: &str, lines: &mut Lines<'_>) -> String {
    let mut text = first.trim_start()[2..].to_owned();
    while !text.ends_with("*)") {
        let Some(line) = lines.next() else { break };
        let line = line.trim_start();
        let line = line.strip_prefix('*').filter(|rest| *rest != ")").unwrap_or(line);
        text += &format!("\n{}", line.trim_start());
    }
    text.trim_end_matches("*)").trim().to_owned()
}

/// Returns the lines before a last one.
fn until(last: &str, lines: &mut Lines<'_>) -> String {
    lines.take_while(|line| line.trim() != last).collect::<Vec<_>>().join("\n")
}

/// Returns a function or function block, whose head is its name, and `: type` of a function.
fn unit(kind: &str, head: &str, lines: &mut Lines<'_>, said: &str) -> String {
    let (name, returned) = head.split_once(" : ").map_or((head, None), |(name, kind)| (name, Some(kind)));
    let returned = returned.map(|kind| format!("<returnType>{}</returnType>\n", type_of(kind)));
    let end = if returned.is_some() { "END_FUNCTION" } else { "END_FUNCTION_BLOCK" };
    let (mut interface, mut body) = (returned.unwrap_or_default(), vec![]);
    while let Some(line) = lines.next().filter(|line| *line != end) {
        let section = match line {
            "VAR_INPUT" => "inputVars",
            "VAR_OUTPUT" => "outputVars",
            "VAR_IN_OUT" => "inOutVars",
            "VAR" | "VAR CONSTANT" => "localVars",
            _ => {
                body.push(line);
                continue;
            }
        };
        let constant = if line.ends_with("CONSTANT") { " constant=\"true\"" } else { "" };
        let variables = declared("variable", &until("END_VAR", lines));
        interface += &format!("<{section}{constant}>\n{variables}</{section}>\n");
    }
    let (body, said) = (formatted("ST", &body.join("\n")), formatted("documentation", said));
    format!(
        "<pou name=\"{name}\" pouType=\"{kind}\">\n<interface>\n{interface}</interface>\n<body>{body}</body>\n{said}\n</pou>\n"
    )
}

/// Returns declarations as elements of a name: comments, and `first, second : type := value;`.
fn declared(element: &str, section: &str) -> String {
    let (mut rest, mut said, mut all) = (section.trim(), String::new(), String::new());
    let tag = if element == "dataType" { "baseType" } else { "type" };
    while !rest.is_empty() {
        if let Some((text, behind)) = rest.strip_prefix("(*").and_then(|text| text.split_once("*)")) {
            let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
            (said, rest) = (formatted("documentation", &words), behind.trim_start());
            continue;
        }
        let (one, behind) = rest.split_once(';').unwrap_or((rest, ""));
        let (names, kind) = one.split_once(" : ").unwrap_or((one, ""));
        let (kind, initial) =
            kind.split_once(" := ").map_or((kind, None), |(kind, value)| (kind, Some(value)));
        let kind = format!("<{tag}>{}</{tag}>", type_of(kind));
        let initial = initial.map(initial_value).unwrap_or_default();
        for name in names.split(", ") {
            all += &format!("<{element} name=\"{name}\">{kind}{initial}{said}</{element}>\n");
        }
        said.clear();
        rest = behind.trim_start();
    }
    all
}

/// Returns a number, or the numbers of an array.
fn initial_value(value: &str) -> String {
    let simple = |value: &str| format!("<simpleValue value=\"{}\"/>", value.trim());
    let value = match value.strip_prefix('[').and_then(|list| list.strip_suffix(']')) {
        Some(list) => {
            let entries = list.split(',').map(|value| format!("<value>{}</value>", simple(value)));
            format!("<arrayValue>{}</arrayValue>", entries.collect::<String>())
        }
        None => simple(value),
    };
    format!("<initialValue>{value}</initialValue>")
}

/// Returns a type: an elementary one, an array, or one of the file.
fn type_of(kind: &str) -> String {
    match kind.strip_prefix("ARRAY[0..").and_then(|array| array.split_once("] OF ")) {
        Some((upper, element)) => format!(
            "<array><dimension lower=\"0\" upper=\"{upper}\"/><baseType>{}</baseType></array>",
            type_of(element)
        ),
        None if ["BOOL", "INT", "DINT", "LREAL"].contains(&kind) => format!("<{kind}/>"),
        None => format!("<derived name=\"{kind}\"/>"),
    }
}

/// Returns an element with text.
fn formatted(name: &str, text: &str) -> String {
    format!("<{name}><xhtml xmlns=\"http://www.w3.org/1999/xhtml\">{}</xhtml></{name}>", marked(text))
}
