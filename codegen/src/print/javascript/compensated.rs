//! Corrected commands in JavaScript.

use abbe_core::function::COMPENSATED;
use abbe_spec::Spec;

use super::functions::documentation;
use super::procedures::JavaScriptPrinter;
use crate::print::layout::Writer;
use crate::print::procedure::{Printer, split};
use crate::procedure::{Precision, Procedure, compensated as described};
use crate::program::Routines;

pub(super) fn compensated(writer: &mut Writer, spec: &Spec, routines: &Routines) {
    if !routines.has_compensated() {
        return;
    }
    let procedures = described(spec, Precision::Double).into_iter().map(Procedure::with_loops);
    let (helpers, cycle) = split(procedures.collect());
    writer.blank();
    writer.paragraphs(HELPERS);
    let mut printer = JavaScriptPrinter { writer, routines };
    helpers.iter().for_each(|procedure| printer.helper(procedure, procedure.name, None));
    let writer = &mut *printer.writer;
    writer.blank();
    writer.lines("/**");
    let statuses = Precision::Double.statuses();
    documentation(writer, &routines.description, &COMPENSATED, Some(["status", &statuses]));
    writer.documentation_line("");
    writer.documentation(WITHOUT_LAST);
    writer.lines(" */");
    writer.open("export function compensated(q, s, u, last, change, largest, rotations = [1, 1, 1])");
    writer.lines(CHECKS);
    printer.declarations(&cycle, None);
    printer.statements(&cycle.body);
    printer.writer.lines("return { corrected, correction, before, after, status };");
    printer.writer.close("}");
}

const HELPERS: &str = include_str!("given.js");

/// Arguments that may be left out.
const WITHOUT_LAST: &str = "Without `last`, no cycle precedes: corrections have any size. With it, `change` and `largest` are \
     those of `description.variables` if they are left out, and `rotations` is the whole pose. Throws a RangeError if an \
     argument has another length, a number is not finite or an input is outside its range.";

/// Completes and checks the arguments.
const CHECKS: &str = include_str!("checks.js");
