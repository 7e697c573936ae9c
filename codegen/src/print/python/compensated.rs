//! Corrected commands on NumPy arrays of configurations.

use abbe_core::function::COMPENSATED;
use abbe_spec::Spec;

use super::functions::face;
use super::procedures::PythonPrinter;
use crate::print::layout::Writer;
use crate::print::procedure::{Printer, split};
use crate::procedure::{Precision, compensated as described};
use crate::program::Routines;

pub(super) fn compensated(writer: &mut Writer, spec: &Spec, routines: &Routines) {
    if !routines.has_compensated() {
        return;
    }
    let statuses = Precision::Double.statuses();
    face(writer, &routines.description, &COMPENSATED, Some(["status", &statuses]), Some(WITHOUT_LAST));
    let (helpers, cycle) = split(described(spec, Precision::Double));
    writer.blank();
    writer.blank();
    writer.paragraphs(HELPERS);
    let mut printer = PythonPrinter { writer, routines, cases: Vec::new() };
    helpers.iter().for_each(|procedure| printer.helper(procedure, procedure.name, None));
    let writer = &mut *printer.writer;
    writer.blank();
    writer.blank();
    writer.lines("@np.errstate(divide=\"ignore\", invalid=\"ignore\")");
    writer.begin("def _compensated(batch, *given):");
    writer.lines(CHECKS.trim_end());
    printer.declarations(&cycle, None);
    printer.statements(&cycle.body);
    printer.writer.lines("return corrected, correction, before, after, status");
    printer.writer.end();
}

/// Arguments that may be left out.
const WITHOUT_LAST: &str = "Without `last`, no cycle precedes: corrections have any size. With it, `change` and `largest` are \
     those of the variables in `description` if they are left out, and `rotations` is the whole pose. Raises ValueError if \
     a number is not finite or an input is outside its range";

/// Sums have the same bits for one configuration and for many.
const HELPERS: &str = include_str!("dot.py");

/// Checks the arguments. Where a case does not hold, its statements may divide by 0.
const CHECKS: &str = include_str!("checks.py");
