//! Prints routines as functions.
//!
//! Corrected commands in Matlab.

use abbe_core::function::{self, BEGIN, Signature};
use abbe_core::{Description, Function};
use abbe_spec::Spec;

use super::{MatlabPrinter, operators::Matlab};
use crate::print::routine::statements;
use crate::print::{Flat, Printer, Statements, Writer, commands, sizes};
use crate::procedure::Precision;
use crate::program::{Role, Routines};

/// Prints one function.
pub(super) fn function(writer: &mut Writer, class: &str, spec: &Spec, flat: Flat<'_>) {
    let Flat { routines, routine } = flat;
    let Statements { list, .. } = Statements::new(spec, flat, &Matlab { class, spec });
    let names = |role| routine.arrays.iter().filter(move |array| array.role == role).map(|array| array.name);
    let arguments: Vec<&str> = names(Role::Argument).collect();
    let results: Vec<&str> = names(Role::Result).chain(names(Role::Margin)).collect();
    writer.blank();
    let (name, arguments) = (routine.name, arguments.join(", "));
    writer.begin(&format!("function [{}] = {name}({arguments})", results.join(", ")));
    match routine.function.map(Function::signature) {
        Some(signature) => {
            let margin = ["margin", "cos(rho); where it is 0, rows 4-6 are not finite."];
            let behind = signature.has_margin(routines.description.orientation).then_some(margin);
            documentation(writer, &routines.description, signature, behind);
        }
        None => writer.documentation(routine.documentation),
    }
    if routine.function.is_some() {
        let given = routine.arrays.iter().filter(|array| array.role == Role::Argument);
        checks(writer, class, given.map(|array| (array.name, array.len(&routines.description))));
    }
    let margin = statements(&mut MatlabPrinter { writer, class, routines }, flat, &list);
    if let Some(margin) = margin.filter(|margin| *margin != "margin") {
        writer.lines(&format!("margin = {margin};"));
    }
    matrices(writer, flat);
    writer.close("end");
}

/// Prints the conversion of results to matrices.
fn matrices(writer: &mut Writer, flat: Flat<'_>) {
    let arrays = flat.routine.arrays.iter().enumerate();
    for (index, array) in arrays.filter(|(_, array)| array.role == Role::Result) {
        let counts = array.shape.iter().rev();
        let shape: Vec<String> =
            counts.map(|count| count.value(&flat.routines.description).to_string()).collect();
        let (name, is_empty) = (array.name, flat.len(index) == 0);
        match &shape[..] {
            [_] if !is_empty => {}
            [_] => writer.lines(&format!("{name} = zeros(1, 0);")),
            _ if is_empty => writer.lines(&format!("{name} = zeros({});", shape.join(", "))),
            _ => writer.lines(&format!("{name} = reshape({name}, {});", shape.join(", "))),
        }
    }
}

/// Prints the arguments and results of a function, and an additional result if given.
pub(super) fn documentation(
    writer: &mut Writer,
    description: &Description,
    signature: &Signature,
    behind: Option<[&str; 2]>,
) {
    let shape = |array: &function::Array| {
        let mut shape = sizes(array, description);
        shape.reverse();
        if shape.len() == 1 { format!("{} numbers", shape[0]) } else { shape.join(" x ") }
    };
    writer.documentation(signature.documentation);
    let arrays = signature.arguments.iter().map(|array| (array, "argument"));
    for (array, role) in arrays.chain(signature.results.iter().map(|array| (array, "result"))) {
        writer.documentation_line("");
        writer.documentation(&format!(
            "{role} {}: {} Size: {}. Unit: {}.",
            array.name,
            array.documentation,
            shape(array),
            array.unit
        ));
    }
    if let Some([name, documentation]) = behind {
        writer.documentation_line("");
        writer.documentation(&format!("result {name}: {documentation}"));
    }
}

/// Prints the checks of sizes and of the ranges of inputs.
pub(super) fn checks<'a>(writer: &mut Writer, class: &str, given: impl Iterator<Item = (&'a str, usize)>) {
    for (name, count) in given {
        writer.lines(&format!("{class}.is_given('{name}', {name}, {count});"));
        if name == "u" && count > 0 {
            let outside = format!("u(:) < {class}.ranges(:, 1) | u(:) > {class}.ranges(:, 2)");
            writer.begin(&format!("if any({outside})"));
            writer.lines("error('abbe:range', 'an input is outside its range');");
            writer.close("end");
        }
    }
}

pub(super) fn compensated(writer: &mut Writer, class: &str, spec: &Spec, routines: &Routines) {
    let (helpers, commands) = commands(spec, routines, Precision::Double);
    if commands.is_empty() {
        return;
    }
    let (description, statuses) = (&routines.description, Precision::Double.statuses());
    let mut printer = MatlabPrinter { writer, class, routines };
    for (signature, procedure) in commands {
        let is_begin = signature.name == BEGIN.name;
        let writer = &mut *printer.writer;
        writer.blank();
        let names: Vec<&str> = signature.arguments.iter().map(|array| array.name).collect();
        let results: Vec<&str> = procedure.results.iter().map(|result| result.name).collect();
        let (name, results) = (signature.name, results.join(", "));
        writer.begin(&format!("function [{results}] = {name}({})", names.join(", ")));
        documentation(writer, description, signature, Some(["status", &statuses]));
        writer.documentation_line("");
        writer.documentation(&format!("{}{RAISES}", if is_begin { "" } else { WITHOUT_LAST }));
        let count = spec.variables.len().to_string();
        let defaults = if is_begin { "" } else { DEFAULTS };
        writer.lines(&defaults.replace("COUNT", &count).replace("CLASS", class));
        writer.lines(&format!("if nargin < {}\n    rotations = [1 1 1];\nend", names.len()));
        checks(writer, class, signature.arguments.iter().map(|array| (array.name, array.len(description))));
        let each = |names: &[&&str], end: &str| -> Vec<String> {
            names.iter().map(|name| format!("{name}{end}")).collect()
        };
        let finite: Vec<_> = names.iter().filter(|name| !matches!(**name, "change" | "largest")).collect();
        let rows: Vec<_> = names.iter().filter(|name| !matches!(**name, "s" | "u" | "rotations")).collect();
        let text = FINITE.replace("NUMBERS", &each(&finite, "(:)").join("; "));
        let text = text.replace("NAMES", &each(&rows, "").join(", "));
        writer.lines(text.replace("ROWS", &each(&rows, "(:)'").join(", ")).trim_end());
        printer.declarations(&procedure, None);
        printer.statements(&procedure.body);
        printer.writer.close("end");
    }
    helpers.iter().for_each(|procedure| printer.helper(procedure, procedure.name, None));
}

/// Arguments that may be left out.
const WITHOUT_LAST: &str = "Without last, no cycle precedes: corrections have any size. With it, change and largest are those \
     of the class if they are left out. ";

const RAISES: &str = "Without rotations, the whole pose is reached. Raises an error if an argument has another number of \
     elements, a number is not finite or an input is outside its range.";

const DEFAULTS: &str = include_str!("defaults.m");

const FINITE: &str = include_str!("finite.m");
