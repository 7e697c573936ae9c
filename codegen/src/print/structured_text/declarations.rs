//! Declarations of variables in Structured Text.

use abbe_core::{Description, function::Array};
use abbe_spec::Spec;

use super::initial;
use crate::print::layout::harmless as on_one_line;
use crate::print::{Writer, width};

/// Maximum length of a line.
const LINE: usize = 100;

/// Opens a section of declarations: `VAR_INPUT` and so on.
pub(super) fn section(writer: &mut Writer, head: &str, body: impl FnOnce(&mut Writer)) {
    writer.begin(head);
    body(writer);
    writer.close("END_VAR");
}

/// Makes a text safe for a comment: without the beginning or end of one.
pub(super) fn harmless(text: &str) -> String {
    text.replace("*)", "* )").replace("(*", "( *")
}

/// Prints a comment.
pub(super) fn comment(writer: &mut Writer, text: &str) {
    let text = &harmless(&on_one_line(text));
    if writer.indent() + width(text) + 6 <= LINE {
        return writer.lines(&format!("(* {text} *)"));
    }
    writer.lines("(*");
    writer.documentation(text);
    writer.lines(" *)");
}

/// Returns the name of the type of an array, which the file declares: to some compilers every type
/// without a name is another one.
pub(super) fn array_type(writer: &mut Writer, prefix: &str, count: usize, element: &str) -> String {
    let kind = if element == "LREAL" { "array" } else { "counts" };
    let name = format!("{prefix}_{kind}_{count}");
    writer.arrays.insert(name.clone(), format!("ARRAY[0..{}] OF {element}", count - 1));
    name
}

/// Prints `name : type := [first, second, …];`.
pub(super) fn array(writer: &mut Writer, prefix: &str, name: &str, element: &str, values: &[String]) {
    let head = format!("{name} : {} := ", array_type(writer, prefix, values.len(), element));
    filled(writer, &format!("{head}["), values, "];");
}

/// Prints an array of numbers with initial values.
pub(super) fn numbers(writer: &mut Writer, prefix: &str, name: &str, values: &[f64]) {
    let values: Vec<String> = values.iter().map(|value| initial(*value)).collect();
    array(writer, prefix, name, "LREAL", &values);
}

/// Prints variables of one type, as many as fit on a line.
pub(super) fn variables(writer: &mut Writer, names: &[String], type_name: &str) {
    let mut rest = names;
    while !rest.is_empty() {
        let room = LINE.saturating_sub(writer.indent() + width(type_name) + 4);
        let mut length = 0;
        let fits = |name: &&String| {
            length += width(name) + 2;
            length <= room
        };
        let (line, others) = rest.split_at(rest.iter().take_while(fits).count().max(1));
        writer.lines(&format!("{} : {type_name};", line.join(", ")));
        rest = others;
    }
}

/// Prints entries between a beginning and an end, on as many lines as they need.
fn filled(writer: &mut Writer, begin: &str, entries: &[String], end: &str) {
    let mut line = begin.to_owned();
    for (k, entry) in entries.iter().enumerate() {
        let behind = if k + 1 < entries.len() { "," } else { end };
        let space = if line.ends_with('[') || line.trim().is_empty() { "" } else { " " };
        if writer.indent() + width(&line) + width(entry) + 3 > LINE && !line.trim().is_empty() {
            writer.lines(line.trim_end());
            line = format!("    {entry}{behind}");
        } else {
            line.push_str(&format!("{space}{entry}{behind}"));
        }
    }
    writer.lines(&line);
}

/// Returns the name of an array of a function: `S` is an operator of the instruction list.
pub(super) fn array_name(name: &'static str) -> &'static str {
    match name {
        "s" => "parameters",
        "u" => "inputs",
        name => name,
    }
}

/// Prints an argument, with the nominal values of parameters and inputs as initial ones.
pub(super) fn argument(
    writer: &mut Writer,
    prefix: &str,
    spec: &Spec,
    description: &Description,
    array: &Array,
) {
    let count = array.len(description);
    if count == 0 {
        return;
    }
    document(writer, description, array);
    let nominal: Option<Vec<f64>> = match array.name {
        "s" => Some(spec.parameters.iter().map(|one| one.value).collect()),
        "u" => Some(spec.inputs.iter().map(|one| one.value).collect()),
        "magnitudes" => Some(vec![0.0; count]),
        _ => None,
    };
    let name = array_name(array.name);
    match nominal {
        Some(values) => numbers(writer, prefix, name, &values),
        None => {
            let array = array_type(writer, prefix, count, "LREAL");
            writer.lines(&format!("{name} : {array};"));
        }
    }
}

/// Prints the meaning, order and unit of an array.
pub(super) fn document(writer: &mut Writer, description: &Description, array: &Array) {
    let with_unit = |name: &str, unit: &str| match unit {
        "" => name.to_owned(),
        unit => format!("{name} ({unit})"),
    };
    let length = description.length.symbol();
    let names: Vec<String> = match array.name {
        "q" => {
            let joints = description.variables.iter();
            joints.map(|one| with_unit(&one.name, one.kind.either("rad", length))).collect()
        }
        "s" => description.parameters.iter().map(|one| with_unit(&one.name, &one.unit)).collect(),
        "u" => description.inputs.iter().map(|one| with_unit(&one.name, &one.unit)).collect(),
        "magnitudes" => description.sources.iter().map(|one| one.name.to_string()).collect(),
        _ => Vec::new(),
    };
    let order = if names.is_empty() { String::new() } else { format!(" Order: {}.", names.join(", ")) };
    let unit = match array.unit {
        "coherent" => "those given; rad, or a pure number, without one",
        unit => unit,
    };
    comment(writer, &format!("{}{order} Unit: {unit}.", array.documentation));
}
