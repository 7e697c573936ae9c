//! `fmi-machine.h`: indices and start values of the variables, and the functions that fill the
//! outputs.

use abbe_spec::Spec;

use super::{CORRECTED, OUTPUTS, Variables};
use crate::print::{NOT_CLOSED, Real, Writer};

/// Returns the header.
pub(super) fn header(spec: &Spec, variables: &Variables, token: &str, included: &str) -> String {
    let (name, upper) = (&spec.name, spec.name.to_ascii_uppercase());
    let mut writer = Writer::new(" *");
    writer.paragraphs(&format!(
        "/* Constants of the machine. Do not edit. */\n#ifndef FMI_MACHINE_H\n#define FMI_MACHINE_H\n\n\
         #include \"{included}\"\n\n#include <math.h>\n#include <stddef.h>\n\n#define TOKEN \"{token}\"\n\n\
         /* Value references of the first variable of each array. */"
    ));
    writer.open("enum");
    let entry = |array: &str, place: usize| format!("AT_{} = {place},", array.to_ascii_uppercase());
    writer.lines(&entry("time", 0));
    variables.places.iter().for_each(|(array, place)| writer.lines(&entry(array, *place)));
    writer.lines(&entry("outputs", variables.outputs));
    writer.lines(&format!("VALUES = {},", variables.list.len()));
    writer.lines("AT_CORRECTION = VALUES");
    writer.close("};");
    writer.blank();
    writer.lines("/* Start values; outputs are computed. */");
    let starts: Vec<String> =
        variables.list.iter().map(|variable| Real::Double.number(variable.start.unwrap_or(0.0))).collect();
    writer.braces("static const double START[VALUES] = ", &starts, ";");
    writer.blank();
    writer.lines("/* Computes the outputs. Returns an error message, or null. */");
    writer.lines("static const char *evaluate(double *values, int *correction)");
    writer.open_alone();
    let arrays = [("q", spec.variables.len()), ("u", spec.inputs.len()), ("s", spec.parameters.len())];
    let some: Vec<&str> = arrays.into_iter().filter(|(_, len)| *len > 0).map(|(name, _)| name).collect();
    for array in &some {
        writer.lines(&format!("const double *{array} = &values[AT_{}];", array.to_ascii_uppercase()));
    }
    for (k, (function, output)) in OUTPUTS.into_iter().enumerate() {
        let signature = function.signature();
        let arguments = signature.arguments.iter().filter(|array| some.contains(&array.name));
        let arguments: String = arguments.map(|array| format!("{}, ", array.name)).collect();
        let output = output.to_ascii_uppercase();
        let call = format!("status = {name}_{}({arguments}&values[AT_{output}]);", signature.name);
        if k == 0 {
            writer.lines(&format!("int {call}"));
        } else {
            writer.open(&format!("if (status == {upper}_OK)"));
            writer.lines(&call);
            writer.close("}");
        }
    }
    if variables.corrected {
        let corrected = CORRECTED.to_ascii_uppercase();
        writer.open(&format!("if (status == {upper}_OK)"));
        let count = spec.variables.len();
        let arguments = ["q", "s", "u"].into_iter().filter(|array| some.contains(array));
        let arguments: String = arguments.map(|array| format!("{array}, ")).collect();
        let infinite = vec![Real::Double.number(f64::INFINITY); count];
        writer.lines("/* Steps of a simulation are no cycles: corrections of any size. */");
        writer.lines(&format!("const double last[{count}] = {{ 0.0 }};"));
        writer.braces(&format!("const double any[{count}] = "), &infinite, ";");
        writer.lines(&format!("double difference[{count}];\ndouble before[6];\ndouble after[6];"));
        writer.lines(&format!(
            "*correction = {name}_compensated({arguments}last, any, any, {name}_whole_pose, &values[AT_{corrected}], \
             difference, before, after);"
        ));
        writer.lines(&format!("status = (*correction >= {upper}_NOT_CONVERGED) ? {upper}_OK : *correction;"));
        writer.close("}");
    } else {
        writer.lines("*correction = 0;");
    }
    writer.open("switch (status)");
    for (code, why) in [
        ("OK", "NULL"),
        ("SINGULAR", "\"The Euler angles of the displacement are undefined at this pose.\""),
        ("OUT_OF_RANGE", "\"An input is outside its range.\""),
    ] {
        writer.lines(&format!("case {upper}_{code}:\n    return {why};"));
    }
    if !spec.passive.is_empty() {
        writer.lines(&format!("case {upper}_NOT_CLOSED:\n    return \"{NOT_CLOSED}\";"));
    }
    writer.lines("default:\n    return \"An output is not finite; check the inputs and parameters.\";");
    writer.close("}");
    writer.close("}");
    writer.lines("\n#endif");
    writer.finish()
}
