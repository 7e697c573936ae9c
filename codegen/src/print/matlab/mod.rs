//! Matlab and Octave: a class of static functions, one configuration at a time.
//!
//! Arrays are matrices in Matlab's column-major order, which is the order of the numbers in the
//! Rust arrays. `functions` prints routines and the corrected commands, `operators` expressions,
//! `procedures` statements.

mod functions;
mod operators;
mod procedures;

use std::collections::HashSet;

use abbe_core::Description;
use abbe_core::compensator::{CHANGE, LARGEST, bound};
use abbe_core::function::COMMANDS;
use abbe_spec::{Spec, Table};

use self::functions::function;
use self::operators::{WORDS, number, spelled};
use self::procedures::{MatlabPrinter, list};
use super::header::header;
use super::lists::lists;
use super::{Flat, Printer, SourceFile, Writer, distinct, escaped, function_of, harmless, renamed, wrapped};
use crate::procedure::{
    Precision, Procedure, clamped, compensated as described, least_and_greatest, look_up, side,
};
use crate::program::Routines;

/// Returns the file of a manipulator's class. Matlab requires the file to have the name of the
/// class.
pub(super) fn class(spec: &Spec, routines: &Routines) -> SourceFile {
    let class = class_name(spec, routines);
    let mut writer = Writer::new("%");
    writer.begin(&format!("classdef {class}"));
    header(&mut writer, spec, routines);
    writer.documentation_line("");
    writer.documentation(&format!(
        "Call functions as `{class}.pose(q, {class}.parameters)`, for one configuration at a time. A pose is a matrix \
         `[x_axis y_axis z_axis position]` of 3 rows and 4 columns; J_e has 6 rows."
    ));
    if let Some(note) = renamed(spec, "class", &class) {
        writer.documentation_line("");
        writer.documentation(&note);
    }
    properties(&mut writer, routines);
    writer.blank();
    writer.begin("methods (Static)");
    writer.paragraphs(HELPERS);
    let mut printer = MatlabPrinter { writer: &mut writer, class: &class, routines };
    for procedure in least_and_greatest().into_iter().chain([side(), clamped()]) {
        printer.helper(&procedure, procedure.name, None);
    }
    for table in routines.used_lookup_tables() {
        let name = spelled(&table.constant_name());
        printer.helper(&described_table(table), &function_of(&name), Some(&name));
    }
    for routine in &routines.list {
        function(&mut writer, &class, spec, Flat { routines, routine });
    }
    functions::compensated(&mut writer, &class, spec, routines);
    writer.close("end");
    writer.close("end");
    SourceFile { name: format!("{class}.m"), text: writer.finish() }
}

/// Returns the name of the class: the manipulator's, unless it is a keyword, or the name of a
/// function, a property, an argument or a local variable.
fn class_name(spec: &Spec, routines: &Routines) -> String {
    let procedures = described(spec, Precision::Double);
    let arrays = routines.list.iter().flat_map(|routine| &routine.arrays).map(|array| array.name);
    let commands = COMMANDS.iter().flat_map(|one| one.arguments.iter().chain(one.results));
    let signature = commands.map(|array| array.name);
    let names = [OWN, PROPERTIES, WORDS].into_iter().flat_map(str::split_whitespace).chain(arrays);
    let names = names.chain(signature).chain(routines.list.iter().map(|routine| routine.name));
    let names: HashSet<&str> = names.chain(procedures.iter().flat_map(Procedure::names)).collect();
    distinct(spelled(&spec.name), "_", |name| names.contains(name))
}

/// Functions with a text of their own, and the variables of these.
const OWN: &str = "only_real side least greatest is_given clamped a b x y name value count lower upper \
     order piece u t c0 c1 c2 c3 starts knots pieces";

const PROPERTIES: &str = "title length_unit orientation variables limits home change largest parameter_names \
     parameters input_names inputs ranges";

/// Prints names, units, limits, values and the tables of the functions.
fn properties(writer: &mut Writer, routines: &Routines) {
    let description = &routines.description;
    writer.blank();
    writer.begin("properties (Constant)");
    comment(writer, "Names, units, limits and nominal values, in the order of the arguments.");
    let texts = [
        ("title", &description.title[..]),
        ("length_unit", description.length.symbol()),
        ("orientation", description.orientation.name()),
    ];
    for (name, text) in texts {
        writer.lines(&format!("{name} = {};", quoted(text)));
    }
    let pair = |[lower, upper]: [f64; 2]| format!("{} {};", number(lower), number(upper));
    let numbers = |values: Vec<f64>| values.into_iter().map(number).collect::<Vec<_>>();
    let Description { variables, parameters, inputs, .. } = description;
    let (variables, parameters, inputs) = (variables.iter(), parameters.iter(), inputs.iter());
    let bounds =
        |bounds| numbers(variables.clone().map(|one| bound(description, one.kind, bounds)).collect());
    let (texts, values) = (["{", "}"], ["[", "]"]);
    let properties: [(&str, [&str; 2], Vec<String>); 10] = [
        ("variables", texts, variables.clone().map(|one| quoted(&one.name)).collect()),
        ("limits", values, variables.clone().map(|one| pair(one.limits)).collect()),
        ("home", values, numbers(variables.clone().map(|one| one.home).collect())),
        ("change", values, bounds(CHANGE)),
        ("largest", values, bounds(LARGEST)),
        ("parameter_names", texts, parameters.clone().map(|one| quoted(&one.name)).collect()),
        ("parameters", values, numbers(parameters.map(|one| one.nominal).collect())),
        ("input_names", texts, inputs.clone().map(|one| quoted(&one.name)).collect()),
        ("inputs", values, numbers(inputs.clone().map(|one| one.nominal).collect())),
        ("ranges", values, inputs.map(|one| pair(one.range)).collect()),
    ];
    properties.iter().for_each(|(name, brackets, entries)| list(writer, name, *brackets, entries));
    for numbers in lists(routines.used_tables(), routines.used_sums()) {
        comment(writer, numbers.documentation);
        list(writer, &numbers.name, ["[", "]"], &numbers.entries(number));
    }
    for table in routines.used_lookup_tables() {
        lookup_table(writer, table);
    }
    writer.close("end");
}

/// Prints the numbers of a lookup table.
fn lookup_table(writer: &mut Writer, table: &Table) {
    let procedure = described_table(table);
    comment(writer, &procedure.documentation);
    writer.begin(&format!("{} = {{ ...", spelled(&table.constant_name())));
    for (_, values) in &procedure.constants {
        let entries: Vec<String> = values.iter().map(|value| number(*value)).collect();
        writer.lines("[ ...");
        entries.chunks(6).for_each(|line| writer.lines(&format!("    {} ...", line.join(" "))));
        writer.lines("], ...");
    }
    writer.close("};");
}

fn described_table(table: &Table) -> Procedure {
    let lookup = table.lookup();
    look_up(&lookup, lookup.scale, table.documentation(&escaped(&table.description)))
}

fn comment(writer: &mut Writer, text: &str) {
    for line in wrapped(&harmless(text), 92) {
        writer.lines(&format!("% {line}"));
    }
}

/// Returns a text as a literal on one line.
fn quoted(text: &str) -> String {
    format!("'{}'", harmless(text).replace('\'', "''"))
}

/// Functions whose behavior differs from that of Matlab's own.
const HELPERS: &str = include_str!("helpers.m");
