//! JavaScript: an ES module of pure functions on `Float64Array`.
//!
//! Every function allocates its results, flat and in the order of the Rust arrays. A single result
//! is returned as it is, several results as an object. `functions` prints routines and the
//! corrected commands, `operators` expressions, `procedures` statements.

mod functions;
mod operators;
mod procedures;

use abbe_spec::{Spec, Table};

use self::functions::function;
use self::operators::number;
use self::procedures::{JavaScriptPrinter, comment};
use super::header::header;
use super::lists::{lists, records};
use super::{Printer, Writer, escaped, function_of};
use crate::procedure::{clamped, look_up};
use crate::program::Routines;

/// Returns the source of a manipulator's module.
pub(super) fn module(spec: &Spec, routines: &Routines) -> String {
    let mut writer = Writer::new(" *");
    writer.lines("/**");
    header(&mut writer, spec, routines);
    writer.lines(" */");
    writer.blank();
    comment(&mut writer, "Names, units, limits and nominal values, in the order of the arguments.");
    writer.open("export const description =");
    records(&mut writer, &routines.description, str::to_owned, number);
    writer.close("};");
    for list in lists(routines.used_tables(), routines.used_sums()) {
        writer.blank();
        comment(&mut writer, list.documentation);
        writer.array(&format!("const {} = ", list.name), &list.entries(number), ";");
    }
    for table in routines.used_lookup_tables() {
        lookup_table(&mut writer, routines, table);
    }
    if routines.has_commands() || routines.used_lookup_tables().next().is_some() {
        JavaScriptPrinter { writer: &mut writer, routines }.helper(&clamped(), "clamped", None);
    }
    writer.blank();
    writer.paragraphs(functions::HELPERS);
    for routine in &routines.list {
        function(&mut writer, spec, routines, routine);
    }
    functions::compensated(&mut writer, spec, routines);
    writer.finish()
}

/// Prints a lookup table and its function.
fn lookup_table(writer: &mut Writer, routines: &Routines, table: &Table) {
    let (name, lookup) = (table.constant_name(), table.lookup());
    let procedure = look_up(&lookup, lookup.scale, table.documentation(&escaped(&table.description)));
    writer.blank();
    writer.open(&format!("const {name} ="));
    for (list, values) in &procedure.constants {
        let entries: Vec<String> = values.iter().map(|value| number(*value)).collect();
        writer.array(&format!("{list}: "), &entries, ",");
    }
    writer.close("};");
    JavaScriptPrinter { writer, routines }.helper(&procedure, &function_of(&name), Some(&name));
}
