//! Python: a module of functions on NumPy arrays with any number of leading axes for
//! configurations.
//!
//! Every function consists of a public part, which checks its arguments, reports mistakes and gives
//! results the usual shapes, and a routine on flat arrays behind it. `functions` prints both,
//! and the corrected commands, `operators` expressions, `procedures` statements.

mod functions;
mod operators;
mod procedures;

use abbe_spec::{Spec, Table, literal::quoted};

use self::functions::{MARGIN, face, kernel};
use self::operators::number;
use self::procedures::PythonPrinter;
use super::header::header;
use super::lists::{lists, records};
use super::{Printer, SourceFile, Writer, escaped, file_name, function_of, harmless, renamed};
use crate::{procedure::look_up, program::Routines};

/// Modules that NumPy imports: a file of the same name would hide them.
const MODULES: &str = "abc ast asyncio builtins codecs collections concurrent contextlib copy csv ctypes datetime decimal enum \
     fractions functools glob inspect io itertools json linecache locale logging math numbers numpy operator os pathlib \
     pickle platform random re shutil socket stat statistics string struct subprocess sys tempfile textwrap threading \
     time token tokenize traceback types typing unittest urllib uuid warnings weakref zipfile";

/// Returns the file of a manipulator.
pub(super) fn file(spec: &Spec, routines: &Routines) -> SourceFile {
    let name = file_name(spec, MODULES);
    SourceFile { text: module(spec, routines, &name), name: name + ".py" }
}

/// Returns the source of a manipulator's module.
fn module(spec: &Spec, routines: &Routines, name: &str) -> String {
    let mut writer = Writer::new("");
    writer.lines("r\"\"\"");
    header(&mut writer, spec, routines);
    writer.blank();
    writer.documentation(
        "Arrays can have any number of leading axes for configurations, written as `...`. Matrices have their rows in the \
         second-to-last axis, as usual in NumPy: a pose is `[x_axis y_axis z_axis position]`, 3 rows and 4 columns. \
         `None` for `s` or `u` stands for the nominal values.",
    );
    if let Some(note) = renamed(spec, "module", name) {
        writer.blank();
        writer.documentation(&note);
    }
    writer.lines("\"\"\"");
    writer.blank();
    writer.lines("import numpy as np");
    writer.blank();
    comment(&mut writer, "Names, units, limits and nominal values, in the order of the arguments.");
    writer.begin("description = {");
    records(&mut writer, &routines.description, quoted, number);
    writer.end();
    writer.lines("}");
    for list in lists(routines.used_tables(), routines.used_sums()) {
        writer.blank();
        comment(&mut writer, list.documentation);
        writer.array(&format!("{} = ", list.name), &list.entries(number), "");
    }
    writer.blank();
    writer.blank();
    writer.paragraphs(GIVEN);
    if routines.has_commands() || routines.used_lookup_tables().next().is_some() {
        writer.blank();
        writer.blank();
        writer.lines(CLAMPED);
    }
    routines.used_lookup_tables().for_each(|table| lookup_table(&mut writer, routines, table));
    for routine in &routines.list {
        if let Some(function) = routine.function.filter(|_| routines.exports(routine)) {
            let (description, signature) = (&routines.description, function.signature());
            let behind = signature.has_margin(description.orientation).then_some(MARGIN);
            face(&mut writer, description, signature, behind, None);
        }
        kernel(&mut writer, spec, routines, routine);
    }
    functions::compensated(&mut writer, spec, routines);
    writer.finish()
}

/// Prints a lookup table and its function.
fn lookup_table(writer: &mut Writer, routines: &Routines, table: &Table) {
    let (name, lookup) = (table.constant_name(), table.lookup());
    let procedure = look_up(&lookup, lookup.scale, table.documentation(&escaped(&table.description)));
    writer.blank();
    writer.blank();
    writer.begin(&format!("{name} = ["));
    for (_, values) in &procedure.constants {
        let entries: Vec<String> = values.iter().map(|value| number(*value)).collect();
        writer.array("np.array(", &entries, "),");
    }
    writer.close("]");
    let mut printer = PythonPrinter { writer, routines, cases: Vec::new() };
    printer.helper(&procedure, &function_of(&name), Some(&name));
}

/// Prints a comment of one or more lines.
fn comment(writer: &mut Writer, text: &str) {
    for line in super::layout::wrapped(&harmless(text), 96) {
        writer.lines(&format!("# {line}"));
    }
}

/// Checks arguments and broadcasts them.
const GIVEN: &str = include_str!("given.py");

const CLAMPED: &str = include_str!("clamped.py");
