//! Corrected commands in Matlab.

use abbe_core::function::COMPENSATED;
use abbe_spec::Spec;

use super::functions::{checks, documentation};
use super::procedures::MatlabPrinter;
use crate::print::layout::Writer;
use crate::print::procedure::{Printer, split};
use crate::procedure::{Precision, compensated as described};
use crate::program::Routines;

pub(super) fn compensated(writer: &mut Writer, class: &str, spec: &Spec, routines: &Routines) {
    if !routines.has_compensated() {
        return;
    }
    let description = &routines.description;
    let (helpers, cycle) = split(described(spec, Precision::Double));
    writer.blank();
    writer.begin(
        "function [corrected, correction, before, after, status] = compensated(q, s, u, last, change, largest, rotations)",
    );
    documentation(writer, description, &COMPENSATED, Some(["status", &Precision::Double.statuses()]));
    writer.documentation_line("");
    writer.documentation(WITHOUT_LAST);
    writer.lines(&DEFAULTS.replace("COUNT", &spec.variables.len().to_string()).replace("CLASS", class));
    checks(writer, class, COMPENSATED.arguments.iter().map(|array| (array.name, array.len(description))));
    writer.lines(FINITE.trim_end());
    let mut printer = MatlabPrinter { writer, class, routines };
    printer.declarations(&cycle, None);
    printer.statements(&cycle.body);
    printer.writer.close("end");
    helpers.iter().for_each(|procedure| printer.helper(procedure, procedure.name, None));
}

/// Arguments that may be left out.
const WITHOUT_LAST: &str = "Without last, no cycle precedes: corrections have any size. With it, change and largest are those \
     of the class if they are left out, and rotations is the whole pose. Raises an error if an argument has another number \
     of elements, a number is not finite or an input is outside its range.";

const DEFAULTS: &str = include_str!("defaults.m");

const FINITE: &str = include_str!("finite.m");
