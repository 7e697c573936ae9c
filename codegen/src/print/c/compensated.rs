//! Corrected commands in C, by the fixed number of steps of `abbe::compensator`.

use abbe_core::compensator::Status;
use abbe_core::function::COMPENSATED;
use abbe_spec::Spec;

use super::functions::{documentation, head};
use super::heads::SIZE;
use super::procedures::CPrinter;
use super::real::Real;
use crate::print::layout::Writer;
use crate::print::procedure::{Printer, split};
use crate::procedure::{Procedure, compensated};
use crate::program::Routines;

pub(super) fn declaration(writer: &mut Writer, spec: &Spec, routines: &Routines, real: Real) {
    if !routines.has_compensated() {
        return;
    }
    writer.blank();
    let own = Status::ALL.into_iter().filter(|status| *status != Status::Reached);
    let own: Vec<&'static str> = own.map(Status::name).collect();
    let upper = spec.name.to_ascii_uppercase();
    let end = format!(
        "With `{upper}_OK` and the statuses from `{upper}_NOT_CONVERGED` on, the commands are within the limits and the \
         bounds, and `after` is what is left at them. `{upper}_OK`: {} With any other status, nothing is written. Arrays \
         may overlap: `corrected` may be `q`, and `correction` may be `last`",
        real.precision().meaning(Status::Reached)
    );
    documentation(writer, &routines.description, &COMPENSATED, &own, Some(&end));
    writer.lines(&format!("{};", head(routines, &COMPENSATED, real, SIZE)));
}

pub(super) fn definition(writer: &mut Writer, spec: &Spec, routines: &Routines, real: Real) {
    if !routines.has_compensated() {
        return;
    }
    let procedures = compensated(spec, real.precision()).into_iter().map(Procedure::with_loops);
    let (helpers, cycle) = split(procedures.collect());
    let mut printer = CPrinter { writer, routines, real };
    helpers.iter().for_each(|procedure| printer.helper(procedure, procedure.name, None));
    printer.writer.blank();
    printer.writer.lines(&head(routines, &COMPENSATED, real, SIZE));
    printer.writer.open_alone();
    printer.declarations(&cycle, None);
    let infinity = real.number(f64::INFINITY);
    let finite = |name: &str, len: usize| format!("are_below({name}, {len}, {infinity}) == 0");
    let wrong = [finite("last", spec.variables.len()), finite("rotations", 3)].join(" || ");
    let not_finite = printer.code("NOT_FINITE");
    printer.writer.lines(&format!("int status = {not_finite};"));
    printer.leave(&wrong, "status");
    printer.statements(&cycle.body);
    writer.lines("return status;");
    writer.close("}");
}
