//! Corrected commands in C, and where they begin, as `abbe::compensator` computes them.

use abbe_core::compensator::Status;
use abbe_core::function::{Array, BEGIN, Signature};
use abbe_spec::Spec;

use super::{CPrinter, Real, SIZE, documentation, head};
use crate::print::{Printer, Writer, commands};
use crate::program::Routines;

/// Prints the declaration of a corrected command, or of where one begins.
pub(super) fn declaration(
    writer: &mut Writer,
    spec: &Spec,
    routines: &Routines,
    signature: &Signature,
    real: Real,
) {
    let is_begin = signature.name == BEGIN.name;
    let own = |status: &Status| *status != Status::Reached && (!is_begin || *status == Status::NotReached);
    let own: Vec<&'static str> = Status::ALL.into_iter().filter(own).map(Status::name).collect();
    let upper = spec.name.to_ascii_uppercase();
    let reached = real.precision().meaning(Status::Reached);
    let end = if is_begin {
        format!(
            "With `{upper}_OK` and `{upper}_NOT_REACHED`, `after` is what is left. `{upper}_OK`: {reached} With any other \
             status, nothing is written. Arrays may overlap: `command` may be `q`"
        )
    } else {
        format!(
            "With `{upper}_OK` and the statuses from `{upper}_NOT_CONVERGED` on, the commands are within the limits and the \
             bounds, and `after` is what is left at them. `{upper}_OK`: {reached} With any other status, nothing is written. \
             Arrays may overlap: `corrected` may be `q`, and `correction` may be `last`"
        )
    };
    documentation(writer, &routines.description, signature, &own, Some(&end));
    writer.lines(&format!("{};", head(routines, signature, real, SIZE)));
}

pub(super) fn definitions(writer: &mut Writer, spec: &Spec, routines: &Routines, real: Real) {
    let (helpers, commands) = commands(spec, routines, real.precision());
    let mut printer = CPrinter { writer, routines, real };
    if !commands.is_empty() {
        helpers.into_iter().for_each(|one| printer.helper(&one.clone().with_loops(), one.name, None));
    }
    let infinity = real.number(f64::INFINITY);
    for (signature, procedure) in commands {
        printer.writer.blank();
        printer.writer.lines(&head(routines, signature, real, SIZE));
        printer.writer.open_alone();
        let procedure = procedure.with_loops();
        printer.declarations(&procedure, None);
        let wrong = signature.arguments.iter().filter(|array| matches!(array.name, "last" | "rotations"));
        let len = |array: &Array| array.len(&routines.description);
        let wrong = wrong.map(|one| format!("are_below({}, {}, {infinity}) == 0", one.name, len(one)));
        let not_finite = printer.code("NOT_FINITE");
        printer.writer.lines(&format!("int status = {not_finite};"));
        printer.leave(&wrong.collect::<Vec<_>>().join(" || "), "status");
        printer.statements(&procedure.body);
        printer.writer.lines("return status;");
        printer.writer.close("}");
    }
}
