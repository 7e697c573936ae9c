//! The module of a manipulator.

use super::face;
use super::header::header;
use super::literal::looks_like_named;
use super::long::helpers;
use super::raw::raw_function;
use super::writer::Writer;
use crate::chain::Model;
use crate::program::{FunctionKind, Operand, Program, functions};
use crate::spec::{Class, Spec};

/// The counts that arrays have as sizes.
const SIZES: [&str; 8] =
    ["DISTINCT", "EFFECTS", "ERRORS", "FRAMES", "INPUTS", "PARAMETERS", "SOURCES", "VARIABLES"];

/// The source of a manipulator's module, `pub mod name { … }`: formatted, the same bytes every time.
pub fn rust(spec: &Spec) -> String {
    let model = Model::new(spec);
    module(spec, &model, &functions(&model))
}

/// The source of the module from the programs of its functions.
pub fn module(spec: &Spec, model: &Model, functions: &[(FunctionKind, Program)]) -> String {
    let mut writer = Writer::new();
    header(&mut writer, spec, functions);
    allowed_lints(spec, functions).into_iter().for_each(|lint| writer.lines(&format!("#[allow({lint})]")));
    writer.open(&format!("pub mod {}", spec.name));
    writer.imports("::abbe", &used_types(spec, model));
    writer.blank();
    face::description(&mut writer, spec, &model.effects);
    face::named_values(&mut writer, spec);
    face::checked(&mut writer, spec);
    writer.documentation(
        "The same as functions of plain arrays, generic over the scalar and without checks: what is not finite \
         stays so.",
    );
    writer.open("pub mod raw");
    writer.imports("super", &SIZES);
    writer.lines("use ::abbe::Scalar;");
    for (kind, program) in functions {
        writer.blank();
        raw_function(&mut writer, spec, *kind, program);
    }
    if spec.is_long() {
        helpers(&mut writer, spec, model);
    }
    writer.close("}");
    writer.close("}");
    writer.finish()
}

/// What a program does not call, and lints that numbers and names of the spec would trip.
fn allowed_lints(spec: &Spec, functions: &[(FunctionKind, Program)]) -> Vec<&'static str> {
    let mut allowed = vec!["dead_code"];
    let names = spec.parameters.iter().map(|p| &p.name).chain(spec.inputs.iter().map(|i| &i.name));
    let mut names = names.chain(spec.variables.iter().map(|v| &v.name));
    if names.any(|name| name.contains(|c: char| c.is_ascii_uppercase()) || name.contains("__")) {
        allowed.push("non_snake_case");
    }
    let steps = functions.iter().flat_map(|(_, program)| &program.steps);
    let operands = steps.flat_map(|step| step.action.operands());
    let constants = operands.filter_map(|operand| match operand {
        Operand::Constant(value) => Some(value),
        _ => None,
    });
    let values = spec.parameters.iter().map(|p| p.value).chain(spec.inputs.iter().map(|i| i.value));
    let limits = spec.variables.iter().flat_map(|v| [v.limits[0], v.limits[1], v.home]);
    let ranges = spec.inputs.iter().flat_map(|i| i.range);
    let outputs =
        functions.iter().flat_map(|(_, program)| &program.outputs).filter_map(|output| match output {
            Operand::Constant(value) => Some(*value),
            _ => None,
        });
    if constants.chain(values).chain(limits).chain(ranges).chain(outputs).any(looks_like_named) {
        allowed.push("clippy::approx_constant");
    }
    allowed
}

fn used_types(spec: &Spec, model: &Model) -> Vec<&'static str> {
    let mut names = vec!["Description", "Frame", "LengthUnit", "List", "Orientation", "Text"];
    if !spec.variables.is_empty() {
        names.extend(["Variable", "VariableKind"]);
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Free text stays in the comments, whatever it holds, and lines stay narrow.
    #[test]
    fn free_text_stays_in_comments() {
        let text = r#"
            [manipulator]
            name = "arm"
            title = "two\nlines\rand \u0007 more"
            length = "m"
            [[frame]]
            name = "a | b"
            transform = "Tx(1)"
        "#;
        let module = rust(&Spec::parse("arm.toml", text).unwrap());
        let above = module.split("pub mod arm {").next().unwrap();
        assert!(above.contains("two lines and"), "{above}");
        assert!(above.contains("| 1 | a \\| b | fixed |"), "{above}");
        assert!(above.lines().all(|line| line.starts_with("///") || line.starts_with("#[")), "{above}");
        assert!(module.lines().all(|line| line.chars().count() <= 100));
    }
}
