//! Public items of a generated module: constants, parameters, inputs, the checked functions, the
//! trait.

use abbe_core::distinct::{VECTORS_OF_TREE, vectors};
use abbe_core::{Class, VariableKind};
use abbe_spec::{Spec, Variable};

use super::operators::number;
use crate::chain::{Model, lower_pairs};
use crate::print::{Writer, array, call, described, escaped};

/// Types that a generated module defines or imports, and types of the prelude.
const TAKEN: &str = "Box Class Clone Component Copy Debug Default Description Distribution Drop Effect Eq Err \
     Fn Frame Input Inputs LengthUnit List None Ok Option Orientation Parameter Parameters \
     Result Self Send Some Source String Sync Text Variable VariableKind Vec";

/// Maximum width of the fields of a structure on one line.
const NARROW_STRUCTURE: usize = 18;

/// Returns the name of the manipulator's type: `puma560` becomes `Puma560`, `my_arm` `MyArm`.
pub(super) fn type_name(name: &str) -> String {
    let words = name.split('_').filter(|word| !word.is_empty());
    let name: String = words.map(|word| word[..1].to_ascii_uppercase() + &word[1..]).collect();
    let is_free = name.starts_with(|c: char| c.is_ascii_alphabetic())
        && !TAKEN.split_whitespace().any(|taken| taken == name);
    if is_free { name } else { format!("Manipulator{name}") }
}

/// Prints the counts, and [`DESCRIPTION`] with every name, unit and limit.
pub(super) fn description(writer: &mut Writer, spec: &Spec, model: &Model) {
    let effects = &model.effects;
    let distinct = if spec.is_serial() { vectors(spec.orientation) } else { VECTORS_OF_TREE };
    for (name, count, documentation) in [
        ("FRAMES", spec.frames.len(), "Number of frames n."),
        ("ERRORS", 6 * spec.frames.len(), "Number of generalized errors: 6n, the length of ε."),
        ("VARIABLES", spec.variables.len(), "Number of joint variables: the length of `q`."),
        ("PARAMETERS", spec.parameters.len(), "Number of structural parameters: the length of `s`."),
        ("INPUTS", spec.inputs.len(), "Number of inputs: the length of `u`."),
        ("EFFECTS", effects.len(), "Number of errors that the sources cause."),
        ("SOURCES", spec.enabled_sources().count(), "Number of enabled sources."),
        (
            "DISTINCT",
            distinct,
            "Number of distinct vectors in a frame's six columns of `J_e`, neither zero nor repeated.",
        ),
        ("PASSIVE", spec.passive.len(), "Number of passive variables."),
        ("SOLUTIONS", model.solutions(), "Largest number of solutions of inverse kinematics."),
    ] {
        if count == 0 && matches!(name, "PASSIVE" | "SOLUTIONS") {
            continue;
        }
        writer.documentation(documentation);
        writer.lines(&format!("pub const {name}: usize = {count};"));
    }
    writer.blank();
    let Spec { name, title, .. } = spec;
    writer.documentation("Description of the manipulator: names, units, limits, sources.");
    writer.open("pub static DESCRIPTION: Description = Description");
    writer.lines(&format!("name: Text::Constant({name:?}),"));
    writer.lines(&format!("title: Text::Constant({title:?}),"));
    writer.lines(&format!("length: LengthUnit::{:?},", spec.length));
    writer.lines(&format!("orientation: Orientation::{:?},", spec.orientation));
    let entries = writer.indent() + 4;
    let mut list = |name: &str, entries: Vec<(&str, Vec<String>)>| {
        writer.array_of_calls(&format!("{name}: List::Constant(&"), &entries, "),");
    };
    let kind = |kind: VariableKind| format!("VariableKind::{kind:?}");
    let variable = |indent: usize, variable: &Variable| {
        let (limits, home) = (interval(indent, variable.limits), number(variable.home));
        vec![quoted(&variable.name), kind(variable.kind), limits, home]
    };
    let frames = spec.frames.iter().zip(lower_pairs(spec)).enumerate().map(|(index, (frame, lower_pair))| {
        let constructor = match lower_pair {
            _ if !spec.is_serial() => "Frame::in_tree",
            true => "Frame::lower_pair",
            false => "Frame::new",
        };
        let mut fields = vec![quoted(&frame.name), format!("{:?}", frame.variable)];
        if !spec.is_serial() {
            let passive = frame.passive.map_or("None".to_owned(), |passive| {
                call(entries + 5, "Some(Variable::new", &variable(entries + 8, &spec.passive[passive])) + ")"
            });
            fields.extend([format!("{:?}", frame.parent), passive, (index == spec.tool_frame).to_string()]);
        }
        (constructor, fields)
    });
    list("frames", frames.collect());
    let variables = spec.variables.iter().map(|one| ("Variable::new", variable(entries + 4, one)));
    list("variables", variables.collect());
    let sums = spec.sum_limits.iter().map(|limit| {
        let terms = limit.terms.iter().map(|(i, weight)| format!("({i}, {})", number(*weight)));
        let terms = array(entries + 4, "&", &terms.collect::<Vec<_>>(), "");
        (
            "SumLimit::new",
            vec![quoted(&limit.sum), kind(limit.kind), terms, interval(entries + 4, limit.range)],
        )
    });
    list("sum_limits", sums.collect());
    let parameters = spec.parameters.iter().map(|parameter| {
        ("Parameter::new", vec![quoted(&parameter.name), number(parameter.value), quoted(&parameter.unit)])
    });
    list("parameters", parameters.collect());
    let inputs = spec.inputs.iter().map(|input| {
        let (value, range) = (number(input.value), interval(entries + 4, input.range));
        let mut fields = vec![quoted(&input.name), value, range, quoted(&input.unit)];
        if input.levels.is_empty() {
            return ("Input::new", fields);
        }
        let levels: Vec<String> = input.levels.iter().map(|level| number(*level)).collect();
        fields.insert(3, array(entries + 4, "&", &levels, ""));
        ("Input::at_levels", fields)
    });
    list("inputs", inputs.collect());
    let sources = spec.enabled_sources().map(|source| {
        let class = match source.class {
            Class::Repeatable => "Class::Repeatable".to_owned(),
            Class::Tolerance(distribution) => format!("Class::Tolerance(Distribution::{distribution:?})"),
            Class::Random(distribution) => format!("Class::Random(Distribution::{distribution:?})"),
        };
        let at = spec.place(source);
        let mut fields = vec![quoted(&source.name), class, quoted(&at), quoted(&source.reference)];
        if source.degrees_of_freedom.is_infinite() {
            return ("Source::new", fields);
        }
        fields.insert(2, number(source.degrees_of_freedom));
        ("Source::estimated", fields)
    });
    list("sources", sources.collect());
    let effects = effects.iter().map(|effect| {
        let component = format!("Component::{:?}", effect.component);
        ("Effect::new", vec![effect.source.to_string(), effect.frame.to_string(), component])
    });
    list("effects", effects.collect());
    writer.lines(&format!("solutions: {},", if model.solutions() > 0 { "SOLUTIONS" } else { "0" }));
    writer.close("};");
    writer.blank();
}

fn quoted(text: &str) -> String {
    format!("{text:?}")
}

fn interval(indent: usize, [lower, upper]: [f64; 2]) -> String {
    array(indent, "", &[number(lower), number(upper)], "")
}

/// Prints `Parameters` and `Inputs`: named fields with their default values.
pub(super) fn named_values(writer: &mut Writer, spec: &Spec) {
    let parameters = spec.parameters.iter().map(|p| Field::new(&p.name, &p.description, &p.unit, p.value));
    let inputs = spec.inputs.iter().map(|i| Field::new(&i.name, &i.description, &i.unit, i.value));
    let (parameters, inputs): (Vec<_>, Vec<_>) = (parameters.collect(), inputs.collect());
    let what = [
        "Structural parameters `s`, which can be set at run time.",
        "Nominal values.",
        "Inputs `u`, which can change with every call.",
        "Default values.",
    ];
    record(writer, "Parameters", [what[0], what[1]], "PARAMETERS", &parameters);
    record(writer, "Inputs", [what[2], what[3]], "INPUTS", &inputs);
}

struct Field<'s> {
    name: &'s str,
    documentation: String,
    value: f64,
}

impl<'s> Field<'s> {
    fn new(name: &'s str, description: &str, unit: &str, value: f64) -> Self {
        Self { name, documentation: described(description, unit), value }
    }
}

fn record(writer: &mut Writer, name: &str, [what, nominal]: [&str; 2], count: &str, fields: &[Field<'_>]) {
    writer.documentation(what);
    writer.lines("#[derive(Clone, Copy, Debug, PartialEq)]");
    if fields.is_empty() {
        writer.lines(&format!("pub struct {name} {{}}"));
    } else {
        writer.open(&format!("pub struct {name}"));
        for field in fields {
            writer.documentation(&field.documentation);
            writer.lines(&format!("pub {}: f64,", field.name));
        }
        writer.close("}");
    }
    writer.blank();
    writer.open(&format!("impl {name}"));
    writer.documentation(nominal);
    if fields.is_empty() {
        writer.lines("pub const NOMINAL: Self = Self {};");
    } else {
        let values: Vec<String> =
            fields.iter().map(|field| format!("{}: {}", field.name, number(field.value))).collect();
        structure(writer, "pub const NOMINAL: Self = Self", &values);
    }
    writer.blank();
    writer.documentation("Returns the values in the order of [`DESCRIPTION`].");
    writer.open(&format!("pub const fn to_array(self) -> [f64; {count}]"));
    let values: Vec<String> = fields.iter().map(|field| format!("self.{}", field.name)).collect();
    writer.array("", &values, "");
    writer.close("}");
    writer.close("}");
    writer.blank();
    writer.open(&format!("impl Default for {name}"));
    writer.open("fn default() -> Self");
    writer.lines("Self::NOMINAL");
    writer.close("}");
    writer.close("}");
    writer.blank();
}

/// Prints `head { a: 1.0, b: 2.0 };` on one line if it is very short.
fn structure(writer: &mut Writer, head: &str, values: &[String]) {
    let inner = values.join(", ");
    if inner.len() <= NARROW_STRUCTURE {
        writer.lines(&format!("{head} {{ {inner} }};"));
    } else {
        writer.open(head);
        values.iter().for_each(|value| writer.lines(&format!("{value},")));
        writer.close("};");
    }
}

/// Prints the macro call for the checked functions and the trait, which are the same for all
/// manipulators.
pub(super) fn checked(writer: &mut Writer, spec: &Spec, model: &Model) {
    writer.open("::abbe::checked_functions!");
    let title = escaped(spec.title.trim_end_matches('.'));
    writer.documentation(&format!("{title}, as a [`Manipulator`](::abbe::Manipulator)."));
    let loops = if spec.passive.is_empty() { "" } else { " loops" };
    let inverse = if model.solutions() > 0 { " inverse" } else { "" };
    writer.lines(&format!("{}{loops}{inverse}", type_name(&spec.name)));
    writer.close("}");
    writer.blank();
}
