//! Corrected commands in Structured Text.
//!
//! The block keeps the corrections of the cycle before itself.

use abbe_core::Description;
use abbe_core::compensator::{CHANGE, LARGEST, bound};
use abbe_core::function::COMPENSATED;
use abbe_spec::Spec;

use super::declarations::{argument, comment, document, numbers, section};
use super::procedures::{BlockPrinter, declarations};
use crate::print::layout::Writer;
use crate::print::procedure::{Printer, split};
use crate::procedure::{Kind, Precision, Procedure, Variable, compensated};
use crate::program::Routines;

/// Prints the block of corrected commands, and those that it calls.
pub(super) fn blocks(writer: &mut Writer, spec: &Spec, routines: &Routines, prefix: &str) {
    let procedures = compensated(spec, Precision::Double).into_iter().map(Procedure::with_loops);
    let (helpers, cycle) = split(procedures.collect());
    let mut printer = BlockPrinter { writer, routines, prefix, procedures: &helpers };
    helpers.iter().for_each(|procedure| printer.helper(procedure, procedure.name, None));
    let writer = &mut *printer.writer;
    writer.blank();
    comment(writer, COMPENSATED.documentation);
    writer.lines(&format!("FUNCTION_BLOCK {prefix}_compensated"));
    interface(writer, spec, &routines.description);
    let kept = Variable { name: "last", kind: Kind::Array(spec.variables.len()) };
    let sum = Variable { name: "sum", kind: Kind::Real };
    declarations(writer, &cycle, prefix, &[kept, sum]);
    let last = spec.variables.len() - 1;
    writer.lines(BEGIN.replace("LAST", &last.to_string()).replace("PREFIX", prefix).trim_end());
    printer.statements(&cycle.body);
    printer.writer.lines("last := correction;\nEND_FUNCTION_BLOCK");
}

/// Begins anew, and checks what no other block checks.
const BEGIN: &str = include_str!("begin.st");

/// Prints inputs and outputs.
fn interface(writer: &mut Writer, spec: &Spec, description: &Description) {
    let bounds = |bounds| -> Vec<f64> {
        description.variables.iter().map(|one| bound(description, one.kind, bounds)).collect()
    };
    section(writer, "VAR_INPUT", |writer| {
        for array in COMPENSATED.arguments.iter().filter(|array| array.name != "last") {
            let values = match array.name {
                "change" => bounds(CHANGE),
                "largest" => bounds(LARGEST),
                "rotations" => vec![1.0; 3],
                _ => {
                    argument(writer, spec, description, array);
                    continue;
                }
            };
            document(writer, description, array);
            numbers(writer, array.name, &values);
        }
        comment(writer, RESET);
        writer.lines("reset : BOOL;");
    });
    section(writer, "VAR_OUTPUT", |writer| {
        comment(writer, OUTPUTS);
        for array in COMPENSATED.results {
            document(writer, description, array);
            let values = match array.name {
                "corrected" => description.variables.iter().map(|variable| variable.home).collect(),
                _ => vec![0.0; array.len(description)],
            };
            numbers(writer, array.name, &values);
        }
        writer.lines("status : INT := 1;");
    });
}

const RESET: &str =
    "TRUE begins anew in each cycle, as if no correction preceded: only while the drives do not move.";

const OUTPUTS: &str = "With the statuses 1 to 3 nothing is written, and the outputs are those of the last valid cycle, at first \
     the home position. With any other status, the commands are within the limits and the bounds, and after is what is left \
     at them.";
