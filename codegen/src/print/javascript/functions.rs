//! Prints routines as functions.
//!
//! Corrected commands in JavaScript.

use abbe_core::function::{BEGIN, Signature};
use abbe_core::{Description, Function};
use abbe_spec::Spec;

use super::{JavaScriptPrinter, operators::JavaScript, procedures::one_or_object};
use crate::print::routine::statements;
use crate::print::{Flat, Printer, Statements, Writer, commands, sizes};
use crate::procedure::Precision;
use crate::program::{Role, Routine, Routines};

/// Prints one function.
pub(super) fn function(writer: &mut Writer, spec: &Spec, routines: &Routines, routine: &Routine) {
    let flat = Flat { routines, routine };
    let Statements { list, .. } = Statements::new(spec, flat, &JavaScript(&spec.tables));
    writer.blank();
    writer.lines("/**");
    match routine.function.map(Function::signature) {
        Some(signature) => {
            let margin = ["margin", "`cos ρ`; where it is 0, rows 4–6 are not finite."];
            let behind = signature.has_margin(routines.description.orientation).then_some(margin);
            documentation(writer, &routines.description, signature, behind);
            if routines.exports(routine) {
                writer.documentation_line("");
                writer.documentation(THROWS);
            }
        }
        None => writer.documentation(routine.documentation),
    }
    writer.lines(" */");
    let given = routine.arrays.iter().filter(|array| array.role == Role::Argument);
    let arguments: Vec<&str> = given.map(|array| array.name).collect();
    let export = if routines.exports(routine) { "export " } else { "" };
    writer.open(&format!("{export}function {}({})", routine.name, arguments.join(", ")));
    if !export.is_empty() {
        let given = routine.arrays.iter().filter(|array| array.role == Role::Argument);
        for (name, count) in given.map(|array| (array.name, array.len(&routines.description))) {
            writer.lines(&match name {
                "u" => "are_inputs(u);".to_owned(),
                name => format!("given('{name}', {name}, {count});"),
            });
        }
    }
    let mut printer = JavaScriptPrinter { writer, routines };
    let margin = statements(&mut printer, flat, &list);
    let result = |index: usize| match flat.len(index) {
        0 => "new Float64Array(0)".to_owned(),
        _ => printer.array(routine, routine.arrays[index].name),
    };
    let arrays = routine.arrays.iter().enumerate().filter(|(_, array)| array.role == Role::Result);
    let results = arrays.map(|(index, array)| (array.name, result(index)));
    let results: Vec<_> = results.chain(margin.map(|value| ("margin", value.to_owned()))).collect();
    writer.lines(&format!("return {};", one_or_object(&results)));
    writer.close("}");
}

/// Prints the documentation of a function: its signature, and what it returns in addition to the
/// results.
pub(super) fn documentation(
    writer: &mut Writer,
    description: &Description,
    signature: &Signature,
    behind: Option<[&str; 2]>,
) {
    writer.documentation(signature.documentation);
    writer.documentation_line("");
    let numbers = |array: &abbe_core::function::Array| {
        let shape = sizes(array, description).join(" × ");
        format!("{} Size: {shape}. Unit: {}.", array.documentation, array.unit)
    };
    for array in signature.arguments {
        let name = match array.name {
            name @ ("last" | "change" | "largest" | "rotations") => format!("[{name}]"),
            name => name.to_owned(),
        };
        writer.documentation(&format!("@param {{Float64Array}} {name} {}", numbers(array)));
    }
    match (signature.results, behind) {
        ([array], None) => writer.documentation(&format!("@returns {{Float64Array}} {}", numbers(array))),
        (several, behind) => {
            let arrays = several.iter().map(|array| format!("{}: Float64Array", array.name));
            let number = behind.map(|[name, _]| format!("{name}: number"));
            let of_type = arrays.chain(number).collect::<Vec<_>>().join(", ");
            writer.documentation(&format!("@returns {{{{ {of_type} }}}} Object with the properties:"));
            for array in several {
                writer.documentation(&format!("- `{}`: {}", array.name, numbers(array)));
            }
            if let Some([name, documentation]) = behind {
                writer.documentation(&format!("- `{name}`: {documentation}"));
            }
        }
    }
}

pub(super) fn compensated(writer: &mut Writer, spec: &Spec, routines: &Routines) {
    let (helpers, commands) = commands(spec, routines, Precision::Double);
    if commands.is_empty() {
        return;
    }
    let mut printer = JavaScriptPrinter { writer, routines };
    helpers.into_iter().for_each(|one| printer.helper(&one.clone().with_loops(), one.name, None));
    let statuses = Precision::Double.statuses();
    for (signature, procedure) in commands {
        let (procedure, is_begin) = (procedure.with_loops(), signature.name == BEGIN.name);
        let writer = &mut *printer.writer;
        writer.blank();
        writer.lines("/**");
        documentation(writer, &routines.description, signature, Some(["status", &statuses]));
        writer.documentation_line("");
        writer.documentation(&format!("{}{WHOLE}{THROWS}", if is_begin { "" } else { WITHOUT_LAST }));
        writer.lines(" */");
        let further = if is_begin { "" } else { ", last, change, largest" };
        writer.open(&format!(
            "export function {}(q, s, u{further}, rotations = Float64Array.of(1, 1, 1))",
            signature.name
        ));
        let Description { variables, parameters, .. } = &routines.description;
        let counts = [("q", variables.len()), ("s", parameters.len()), ("rotations", 3)];
        counts.iter().for_each(|(name, len)| writer.lines(&format!("given('{name}', {name}, {len});")));
        writer.lines("are_inputs(u);");
        if !is_begin {
            writer.lines(CHECKS);
        }
        printer.declarations(&procedure, None);
        printer.statements(&procedure.body);
        let results: Vec<&str> = procedure.results.iter().map(|result| result.name).collect();
        printer.writer.lines(&format!("return {{ {} }};", results.join(", ")));
        printer.writer.close("}");
    }
}

/// Checks of arguments.
pub(super) const HELPERS: &str = include_str!("given.js");

/// Arguments that may be left out.
const WITHOUT_LAST: &str = "Without `last`, no cycle precedes: corrections have any size. With it, `change` and `largest` are \
     those of `description.variables` if they are left out. ";

const WHOLE: &str = "Without `rotations`, the whole pose is reached. ";

const THROWS: &str = "Throws a RangeError if an argument has another length, a number is not finite or an input is outside its range.";

/// Completes and checks what only corrected commands take.
const CHECKS: &str = include_str!("checks.js");
