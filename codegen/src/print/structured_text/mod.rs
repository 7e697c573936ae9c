//! IEC 61131-3 Structured Text: function blocks for CODESYS, TwinCAT and other controllers.
//!
//! `blocks` prints routines as function blocks, `procedures` statements, lookup tables and the
//! corrected commands, `operators` expressions, `support` the sine and other functions,
//! `declarations` variables; `plcopen` makes XML of them. Everything is in the common part of the
//! editions of the standard and of the dialects: no methods, pointers or references. Arrays have
//! types with names, and numbers are within the range of REAL: MATIEC needs both.
//!
//! Invalid operations stop many controllers, so that nothing computes with NaN: a function that
//! has no value sets `fault`, which becomes a status.

mod blocks;
mod declarations;
mod operators;
pub(super) mod plcopen;
mod procedures;
mod support;

use abbe_spec::Spec;

use self::blocks::block;
use self::declarations::{comment, harmless};
use self::operators::{StructuredText, initial, instance, number};
use self::procedures::scalar;
use self::support::Support;
use super::{NOT_CLOSED, Writer, header::header};
use crate::{procedure::Precision, program::Routines};

/// Returns the text of a manipulator.
pub(super) fn text(spec: &Spec, routines: &Routines) -> String {
    let syntax = StructuredText::new(spec, routines);
    let mut writer = Writer::new(" *");
    writer.lines("(*");
    let mut documentation = Writer::new(" *");
    header(&mut documentation, spec, routines);
    writer.lines(&harmless(&documentation.finish()));
    writer.documentation_line("");
    for paragraph in USE {
        writer.documentation(paragraph);
        writer.documentation_line("");
    }
    let open = if routines.description.has_loops() {
        format!("-1 `NOT_CLOSED`: {NOT_CLOSED} ")
    } else {
        String::new()
    };
    writer.documentation(&format!(
        "status: {open} 0 `OK`: The results are valid. 1 `NOT_FINITE`: An argument or a result is not finite, or a function has no \
         value. 2 `SINGULAR`: Rows 4 to 6 are Euler angles, which are undefined at this pose. 3 `OUT_OF_RANGE`: An input is \
         outside its range. Of {}_compensated also: {}",
        syntax.prefix,
        Precision::Double.statuses()
    ));
    writer.lines(" *)");
    let head = writer.finish();
    let mut writer = Writer::new(" *");
    let has_commands = routines.has_commands();
    for support in Support::used(spec, routines, has_commands) {
        writer.blank();
        match support.described() {
            Some(procedure) => {
                comment(&mut writer, &procedure.documentation);
                let name = format!("{}_{}", syntax.prefix, procedure.name);
                scalar(&mut writer, routines, &procedure, &name, &syntax.prefix, None);
            }
            None => writer.lines(support.text(&syntax.prefix).trim_end()),
        }
    }
    for (table, name) in spec.tables.iter().zip(&syntax.tables) {
        procedures::function(&mut writer, routines, table, name, &syntax.prefix);
    }
    // A block stands behind those that it calls.
    let (functions, helpers): (Vec<_>, Vec<_>) =
        routines.list.iter().partition(|routine| routine.function.is_some());
    for routine in helpers.into_iter().chain(functions) {
        block(&mut writer, spec, routines, routine, &syntax);
    }
    if has_commands {
        procedures::blocks(&mut writer, spec, routines, &syntax.prefix);
    }
    let mut types = Writer::new(" *");
    types.blank();
    types.begin("TYPE");
    writer.arrays.iter().for_each(|(name, array)| types.lines(&format!("{name} : {array};")));
    types.close("END_TYPE");
    head + &types.finish() + &writer.finish()
}

/// Properties of the file that its user must know.
const USE: [&str; 3] = [
    "Arrays begin at 0 and are flat, in column-major order: a Jacobian has one column of six numbers after the other. Inputs \
     that are not connected have the nominal values. Results are valid if status is 0, unless the block says otherwise.",
    "Nothing is divided by 0, and no root, logarithm or arc is taken of a number that has none: these stop some controllers. \
     A comparison with NaN must be false or stop the controller. Sine and cosine are the file's own up to 100000 rad, the \
     controller's beyond; LREAL must be a double of IEEE 754.",
    "The sizes of the numbers in arguments must add up to less than 1.0E30.",
];
