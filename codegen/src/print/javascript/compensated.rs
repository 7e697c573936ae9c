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

const HELPERS: &str = "\
/** Checks the length of an argument, and that its numbers are finite. */
function given(name, numbers, count, mayBeInfinite) {
    if (numbers.length !== count) throw new RangeError(`${name}: expected ${count} numbers, found ${numbers.length}`);
    if (!mayBeInfinite && !numbers.every(Number.isFinite)) throw new RangeError(`${name}: a number is not finite`);
}
";

/// Arguments that may be left out.
const WITHOUT_LAST: &str = "Without `last`, no cycle precedes: corrections have any size. With it, `change` and `largest` are \
     those of `description.variables` if they are left out, and `rotations` is the whole pose. Throws a RangeError if an \
     argument has another length, a number is not finite or an input is outside its range.";

/// Completes and checks the arguments.
const CHECKS: &str = "\
const { variables, parameters, inputs } = description;
const either = (list, name) => list ?? variables.map((one) => (last === undefined ? Infinity : one[name]));
[change, largest] = [either(change, 'change'), either(largest, 'largest')];
last ??= variables.map(() => 0);
[['q', q, variables], ['s', s, parameters], ['u', u, inputs], ['last', last, variables]].forEach(
    ([name, numbers, list]) => given(name, numbers, list.length),
);
given('rotations', rotations, 3);
[['change', change], ['largest', largest]].forEach((one) => given(...one, variables.length, true));
inputs.forEach(({ name, range: [lower, upper] }, k) => {
    if (u[k] < lower || u[k] > upper) throw new RangeError(`input ${name} is outside its range, ${lower} to ${upper}`);
});
";
