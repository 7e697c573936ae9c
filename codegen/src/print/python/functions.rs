//! Prints routines as functions.
//!
//! Corrected commands on NumPy arrays of configurations.

use abbe_core::function::{self, BEGIN, Signature};
use abbe_core::{Description, Quantity};
use abbe_spec::Spec;

use super::{PythonPrinter, operators::Python};
use crate::print::routine::statements;
use crate::print::{Flat, Printer, Statements, Writer, commands, sizes};
use crate::procedure::Precision;
use crate::program::{Role, Routine, Routines};

/// Prints the public function, which checks shapes and gives the results their documented shapes.
/// `behind` is the name and documentation of an additional result.
pub(super) fn face(
    writer: &mut Writer,
    description: &Description,
    signature: &Signature,
    behind: Option<[&str; 2]>,
    end: Option<&str>,
) {
    let name = signature.name;
    let has_default = |name| matches!(name, "s" | "u" | "last" | "change" | "largest" | "rotations");
    let optional = signature.arguments.iter().all(|array| array.name == "q" || has_default(array.name));
    let arguments: Vec<String> = signature
        .arguments
        .iter()
        .map(|array| format!("{}{}", array.name, if optional && array.name != "q" { "=None" } else { "" }))
        .collect();
    writer.blank();
    writer.blank();
    writer.begin(&format!("def {name}({}):", arguments.join(", ")));
    documentation(writer, description, signature, behind, end);
    let shape = |array: &function::Array| tuple(&sizes(array, description));
    let given =
        |array: &function::Array| format!("{0}=({0}, {1})", array.name, tuple(&shown(array, description)));
    let given = signature.arguments.iter().map(given);
    let names: Vec<&str> = signature.arguments.iter().map(|array| array.name).collect();
    let names = names.join(", ");
    writer.lines(&format!("batch, {names} = _given({})", given.collect::<Vec<_>>().join(", ")));
    let shaped = |array: &function::Array| {
        let mut order: Vec<String> = (0..array.shape.len()).map(|axis| axis.to_string()).collect();
        if is_matrix(array) {
            let last = order.len() - 1;
            order.swap(last - 1, last);
        }
        format!("_behind({}, {}, {}, batch)", array.name, shape(array), tuple(&order))
    };
    let behind = behind.map(|[name, _]| name);
    let results: Vec<&str> = signature.results.iter().map(|array| array.name).chain(behind).collect();
    writer.lines(&format!("{} = _{name}(batch, {names})", results.join(", ")));
    let returned: Vec<String> =
        signature.results.iter().map(shaped).chain(behind.map(str::to_owned)).collect();
    writer.lines(&format!("return {}", returned.join(", ")));
    writer.end();
}

/// Returns a tuple, which has a comma if it has one entry.
fn tuple(entries: &[String]) -> String {
    let comma = if entries.len() == 1 { "," } else { "" };
    format!("({}{comma})", entries.join(", "))
}

/// Name and documentation of the margin, which follows the results of a function.
pub(super) const MARGIN: [&str; 2] =
    ["margin", "`cos ρ`; where it is 0, the rows of the orientation are not finite."];

/// Returns `true` if the numbers of an array are columns of matrices.
fn is_matrix(array: &function::Array) -> bool {
    array.quantity == Quantity::Pose || array.name == "columns"
}

/// Returns the sizes of an array as users see them: rows before columns.
fn shown(array: &function::Array, description: &Description) -> Vec<String> {
    let mut shape = sizes(array, description);
    if is_matrix(array) {
        let last = shape.len() - 1;
        shape.swap(last - 1, last);
    }
    shape
}

fn documentation(
    writer: &mut Writer,
    description: &Description,
    signature: &Signature,
    behind: Option<[&str; 2]>,
    end: Option<&str>,
) {
    writer.lines("r\"\"\"");
    writer.documentation(signature.documentation);
    writer.documentation_line("");
    let shape = |array: &function::Array| {
        format!("Shape (..., {}). Unit: {}.", shown(array, description).join(", "), array.unit)
    };
    for array in signature.arguments {
        writer.documentation(&format!("{}: {} {}", array.name, array.documentation, shape(array)));
    }
    writer.documentation_line("");
    let several = if signature.results.len() > 1 || behind.is_some() { ", in this order" } else { "" };
    writer.documentation(&format!("Returns{several}:"));
    for array in signature.results {
        writer.documentation(&format!("{}: {} {}", array.name, array.documentation, shape(array)));
    }
    if let Some([name, documentation]) = behind {
        writer.documentation(&format!("{name}: {documentation} Shape (...)."));
    }
    if let Some(end) = end {
        writer.documentation_line("");
        writer.documentation(&format!("{end}."));
    }
    writer.lines("\"\"\"");
}

/// Prints the routine on flat arrays, whose first axis counts their numbers: each number is an
/// array of the configurations, which NumPy runs through without strides.
pub(super) fn kernel(writer: &mut Writer, spec: &Spec, routines: &Routines, routine: &Routine) {
    let flat = Flat { routines, routine };
    let Statements { list, .. } = Statements::new(spec, flat, &Python(&spec.tables));
    let given = routine.arrays.iter().filter(|array| array.role == Role::Argument);
    let arguments: Vec<&str> = ["batch"].into_iter().chain(given.map(|array| array.name)).collect();
    writer.blank();
    writer.blank();
    writer.begin(&format!("def _{}({}):", routine.name, arguments.join(", ")));
    if routine.function.is_none() {
        writer.lines("r\"\"\"");
        writer.documentation(routine.documentation);
        writer.lines("\"\"\"");
    }
    let margin = statements(&mut PythonPrinter { writer, routines, cases: Vec::new() }, flat, &list);
    // A constant margin has no axes for configurations.
    let margin = margin.map(|value| match value {
        "margin" => value.to_owned(),
        value => format!("np.broadcast_to({value}, batch)"),
    });
    let arrays = routine.arrays.iter().enumerate().filter(|(_, array)| array.role == Role::Result);
    let results = arrays.map(|(index, array)| match flat.len(index) {
        0 => "np.zeros((0,) + batch)".to_owned(),
        _ => array.name.to_owned(),
    });
    writer.lines(&format!("return {}", results.chain(margin).collect::<Vec<_>>().join(", ")));
    writer.end();
}

pub(super) fn compensated(writer: &mut Writer, spec: &Spec, routines: &Routines) {
    let (helpers, commands) = commands(spec, routines, Precision::Double);
    if commands.is_empty() {
        return;
    }
    let statuses = Precision::Double.statuses();
    for (signature, _) in &commands {
        let end = format!("{}{RAISES}", if signature.name == BEGIN.name { "" } else { WITHOUT_LAST });
        face(writer, &routines.description, signature, Some(["status", &statuses]), Some(&end));
    }
    writer.blank();
    writer.blank();
    writer.paragraphs(HELPERS);
    let mut printer = PythonPrinter { writer, routines, cases: Vec::new() };
    helpers.iter().for_each(|procedure| printer.helper(procedure, procedure.name, None));
    for (signature, procedure) in commands {
        let writer = &mut *printer.writer;
        writer.blank();
        writer.blank();
        writer.lines("@np.errstate(divide=\"ignore\", invalid=\"ignore\")");
        writer.begin(&format!("def _{}(batch, *given):", signature.name));
        let names: Vec<&str> = signature.arguments.iter().map(|array| array.name).collect();
        let finite = names.iter().filter(|name| !matches!(**name, "change" | "largest"));
        let finite: Vec<String> = finite.map(|name| format!("\"{name}\": {name}")).collect();
        let checks = CHECKS.replace("NAMES", &names.join(", ")).replace("FINITE", &finite.join(", "));
        writer.lines(checks.trim_end());
        printer.declarations(&procedure, None);
        printer.statements(&procedure.body);
        let results: Vec<&str> = procedure.results.iter().map(|result| result.name).collect();
        printer.writer.lines(&format!("return {}", results.join(", ")));
        printer.writer.end();
    }
}

/// Arguments that may be left out.
const WITHOUT_LAST: &str = "Without `last`, no cycle precedes: corrections have any size. With it, `change` and `largest` are \
     those of the variables in `description` if they are left out. ";

const RAISES: &str = "Without `rotations`, the whole pose is reached. Raises ValueError if a number is not finite or an \
     input is outside its range";

/// Sums have the same bits for one configuration and for many.
const HELPERS: &str = include_str!("dot.py");

/// Checks the arguments. Where a case does not hold, its statements may divide by 0.
const CHECKS: &str = include_str!("checks.py");
