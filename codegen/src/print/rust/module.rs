//! The module of a manipulator.
//!
//! Tables for the loops of long chains, and lookup tables.

#[cfg(test)]
mod tests;

use abbe_core::{Class, Function, Orientation};
use abbe_spec::{Spec, Table};

use super::face;
use super::functions::{error_columns, raw_function, shares_columns};
use super::operators::{looks_like_named, number};
use crate::chain::{Model, is_long};
use crate::print::header::header;
use crate::print::lists::numbers;
use crate::print::{Writer, array, escaped};
use crate::program::{Routines, Sums};

/// Counts that are sizes of arrays.
const SIZES: [&str; 8] =
    ["DISTINCT", "EFFECTS", "ERRORS", "FRAMES", "INPUTS", "PARAMETERS", "SOURCES", "VARIABLES"];

/// Returns the source of the module.
pub fn module(spec: &Spec, model: &Model, routines: &Routines) -> String {
    let mut writer = Writer::new("///");
    header(&mut writer, spec, routines);
    allowed_lints(spec, routines).into_iter().for_each(|lint| writer.lines(&format!("#[allow({lint})]")));
    writer.open(&format!("pub mod {}", spec.name));
    writer.imports("::abbe", &used_types(spec, model));
    writer.blank();
    face::description(&mut writer, spec, model);
    face::named_values(&mut writer, spec);
    face::checked(&mut writer, spec, model);
    writer.documentation(
        "Unchecked functions on plain arrays, generic over the scalar. Infinite and NaN values propagate.",
    );
    if spec.orientation != Orientation::RotationVector {
        writer.documentation_line("");
        let cosine = if spec.orientation == Orientation::EulerYzx { "cos ρ" } else { "cos θ" };
        writer.documentation(&format!(
            "Functions with Euler angles return `{cosine}`; where it is 0, rows 4–6 are not finite.",
        ));
    }
    let shares_columns = shares_columns(routines);
    writer.open("pub mod raw");
    let passive = (!spec.passive.is_empty()).then_some("PASSIVE");
    let solutions = (model.solutions() > 0).then_some("SOLUTIONS");
    let mut sizes: Vec<&str> = SIZES.into_iter().chain(passive).chain(solutions).collect();
    sizes.sort_unstable();
    writer.imports("super", &sizes);
    writer.lines(if shares_columns { "use ::abbe::{ErrorColumns, Scalar};" } else { "use ::abbe::Scalar;" });
    let (functions, helpers): (Vec<_>, Vec<_>) =
        routines.list.iter().partition(|routine| routine.function.is_some());
    for routine in functions {
        match routine.function {
            Some(Function::ErrorJacobian) if shares_columns => {
                writer.blank();
                error_columns(&mut writer, spec, routines);
            }
            Some(Function::ErrorJacobianDistinct) if shares_columns => {}
            _ => {
                writer.blank();
                raw_function(&mut writer, spec, routines, routine);
            }
        }
    }
    tables(&mut writer, routines);
    spec.tables.iter().for_each(|table| lookup_table(&mut writer, table));
    for routine in helpers {
        writer.blank();
        raw_function(&mut writer, spec, routines, routine);
    }
    writer.close("}");
    writer.close("}");
    writer.finish()
}

/// Returns the lints to allow: dead code of unused functions, and lints on numbers and names of the
/// spec.
fn allowed_lints(spec: &Spec, routines: &Routines) -> Vec<&'static str> {
    let mut allowed = vec!["dead_code"];
    let mut names = spec.symbols().map(|(name, ..)| name).chain([&spec.name[..]]);
    if names.any(|name| name.contains(|c: char| c.is_ascii_uppercase()) || name.contains("__")) {
        allowed.push("non_snake_case");
    }
    if numbers(spec, routines).into_iter().any(looks_like_named) {
        allowed.push("clippy::approx_constant");
    }
    if is_long(spec) {
        // Loops index rows of several arrays at once.
        allowed.push("clippy::needless_range_loop");
    }
    allowed
}

fn used_types(spec: &Spec, model: &Model) -> Vec<&'static str> {
    let mut names = vec!["Description", "Frame", "LengthUnit", "List", "Orientation", "Text"];
    if !spec.variables.is_empty() || !spec.passive.is_empty() {
        names.extend(["Variable", "VariableKind"]);
    }
    if !spec.sum_limits.is_empty() {
        names.push("SumLimit");
    }
    if !spec.parameters.is_empty() {
        names.push("Parameter");
    }
    if !spec.inputs.is_empty() {
        names.push("Input");
    }
    if spec.enabled_sources().next().is_some() {
        names.extend(["Class", "Source"]);
    }
    if spec.enabled_sources().any(|source| source.class != Class::Repeatable) {
        names.push("Distribution");
    }
    if !model.effects.is_empty() {
        names.extend(["Component", "Effect"]);
    }
    names.sort_unstable();
    names
}

/// Prints a lookup table as a constant.
pub(super) fn lookup_table(writer: &mut Writer, table: &Table) {
    let (name, lookup) = (table.constant_name(), table.lookup());
    writer.blank();
    writer.documentation(&table.documentation(&escaped(&table.description)));
    writer.open(&format!("const {name}: ::abbe::LookupTable<'static> = ::abbe::LookupTable"));
    writer.lines(&format!("first: {},", number(lookup.first)));
    writer.lines(&format!("scale: {},", number(lookup.scale)));
    let starts: Vec<String> = lookup.starts.iter().map(u32::to_string).collect();
    writer.array("starts: &", &starts, ",");
    let knots: Vec<String> = lookup.knots.iter().map(|knot| number(*knot)).collect();
    writer.array("knots: &", &knots, ",");
    let indent = writer.indent() + 4;
    let piece = |piece: &[f64; 4]| array(indent, "", &piece.map(number), "");
    writer.array("pieces: &", &lookup.pieces.iter().map(piece).collect::<Vec<_>>(), ",");
    writer.lines(&format!("steps: {},", lookup.steps));
    writer.close("};");
}

/// Prints the tables and sums of a module as constants.
pub(super) fn tables(writer: &mut Writer, routines: &Routines) {
    for table in routines.used_tables() {
        writer.blank();
        writer.documentation(table.documentation);
        let rows: Vec<String> =
            table.rows.iter().map(|[first, second]| format!("({first}, {second})")).collect();
        writer.array(&format!("const {}: [(usize, usize); {}] = ", table.name, rows.len()), &rows, ";");
    }
    for Sums { name, constants, factors } in routines.used_sums() {
        writer.blank();
        writer.documentation("Constant term of each entry.");
        let values: Vec<String> = constants.iter().map(|value| number(*value)).collect();
        writer.array(&format!("const {name}_CONSTANTS: [f64; {}] = ", values.len()), &values, ";");
        writer.blank();
        writer.documentation("Entry, term, and factor of the term.");
        let row =
            |(entry, term, factor): &(usize, usize, f64)| format!("({entry}, {term}, {})", number(*factor));
        let rows: Vec<String> = factors.iter().map(row).collect();
        writer.array(&format!("const {name}_FACTORS: [(usize, usize, f64); {}] = ", rows.len()), &rows, ";");
    }
}
