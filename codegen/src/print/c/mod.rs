//! C99: a header and a source of pure functions on flat arrays, which need only `math.h`.
//!
//! `functions` prints routines, `operators` expressions, `support` the sine and other helpers,
//! `procedures` the procedures of the corrected commands, `compensated` their heads, and
//! `self_test` checks on the target of values that `expected` computes.

mod commands;
mod compensated;
mod expected;
mod functions;
mod heads;
mod operators;
mod procedures;
mod real;
mod self_test;
mod sines;
mod support;

use abbe_core::compensator::{CHANGE, LARGEST, Status, bound};
use abbe_core::function::COMMANDS;
use abbe_spec::{Spec, Table};

use self::functions::{documentation, function, head};
use self::heads::{RESTRICT, SIZE, broken, comment};
use self::operators::HEADERS;
use self::procedures::CPrinter;
pub use self::real::Real;
use self::support::{ARE_BELOW, Support};
use super::header::header;
use super::lists::{lists, numbers};
use super::{
    LINE, NOT_CLOSED, Printer, SourceFile, Writer, described, escaped, file_name, function_of, harmless,
    renamed,
};
use crate::{chain::Model, procedure::look_up, program::Routines};

/// Returns the header and the source of a manipulator.
pub(super) fn files(spec: &Spec, model: &Model, routines: &Routines, real: Real) -> Vec<SourceFile> {
    let name = &file_name(spec, HEADERS);
    vec![
        SourceFile { name: format!("{name}.h"), text: declarations(spec, routines, real, name) },
        SourceFile { name: format!("{name}.c"), text: definitions(spec, model, routines, real, name) },
    ]
}

/// Returns the first constant of the source that the type cannot represent.
pub(super) fn lost(spec: &Spec, routines: &Routines, real: Real) -> Option<f64> {
    numbers(spec, routines).into_iter().find(|value| !real.has(*value))
}

/// Returns the header.
fn declarations(spec: &Spec, routines: &Routines, real: Real, file: &str) -> String {
    let upper = spec.name.to_ascii_uppercase();
    let mut writer = Writer::new(" *");
    writer.lines("/**");
    header(&mut writer, spec, routines);
    writer.documentation_line("");
    writer.documentation(
        "Arrays are flat and in column-major order: a Jacobian has one column of six numbers after the other. The \
         functions allocate nothing and have no state. Arrays that a function fills must not overlap others, except \
         where it says so. Every function returns 0 if its results are valid.",
    );
    writer.documentation_line("");
    writer.documentation(if real == Real::Float { SINGLE } else { SAME_BITS });
    if let Some(note) = renamed(spec, "file", file) {
        writer.documentation_line("");
        writer.documentation(&note);
    }
    writer.lines(" */");
    let guard = file.to_ascii_uppercase();
    writer.lines(&format!("#ifndef {guard}_H\n#define {guard}_H\n\n{SIZES}\n{BEGIN}"));
    writer.blank();
    writer.lines("/** Version of the generator, and the first digits of the spec's SHA-256. */");
    writer.lines(&format!("#define {upper}_GENERATOR \"{}\"", env!("CARGO_PKG_VERSION")));
    writer.lines(&format!("#define {upper}_SPEC \"{}\"", &spec.hash[..16]));
    writer.blank();
    let mut statuses = vec![
        (format!("{upper}_OK = 0"), "The results are valid."),
        (format!("{upper}_NOT_FINITE = 1"), "An argument or a result is not finite."),
        (format!("{upper}_SINGULAR = 2"), "Rows 4 to 6 are Euler angles, which are undefined at this pose."),
        (format!("{upper}_OUT_OF_RANGE = 3"), "An input is outside its range."),
    ];
    if routines.description.has_loops() {
        statuses.insert(0, (format!("{upper}_NOT_CLOSED = -1"), NOT_CLOSED));
    }
    let own = Status::ALL.into_iter().filter(|status| *status != Status::Reached);
    statuses.extend(
        own.map(|status| (format!("{upper}_{} = {}", status.name(), status.code()), status.meaning())),
    );
    enumeration(&mut writer, "Status codes returned by the functions.", &statuses);
    counts(&mut writer, &upper, routines);
    indices(&mut writer, &upper, spec);
    values(&mut writer, spec, routines, real, "extern ", false);
    for signature in routines.signatures() {
        writer.blank();
        if COMMANDS.contains(&signature) {
            compensated::declaration(&mut writer, spec, routines, signature, real);
            continue;
        }
        documentation(&mut writer, &routines.description, signature, &[], None);
        writer.lines(&format!("{};", head(routines, signature, real, RESTRICT)));
    }
    self_test::declaration(&mut writer, spec);
    writer.lines(END);
    writer.finish()
}

/// Returns the source.
fn definitions(spec: &Spec, model: &Model, routines: &Routines, real: Real, file: &str) -> String {
    let mut writer = Writer::new(" *");
    comment(
        &mut writer,
        &format!("Definitions of the functions declared and documented in {file}.h. Do not edit."),
    );
    writer.lines(&format!("#include \"{file}.h\"\n\n#include <math.h>\n\n{REFUSED}\n{SIZES}"));
    values(&mut writer, spec, routines, real, "", true);
    for list in lists(routines.used_tables(), routines.used_sums()) {
        writer.blank();
        comment(&mut writer, list.documentation);
        let entries = list.entries(|value| real.number(value));
        let element = if list.is_whole { "int" } else { real.name() };
        let head = format!("static const {element} {}[{}] = ", list.name, entries.len());
        writer.braces(&head, &entries, ";");
    }
    let (functions, helpers): (Vec<_>, Vec<_>) =
        routines.list.iter().partition(|routine| routine.function.is_some());
    let mut body = Writer::new(" *");
    for routine in helpers.into_iter().chain(functions) {
        function(&mut body, spec, routines, routine, real);
    }
    let body = body.finish();
    let used = Support::used(routines, &body);
    for text in
        [real.text(ARE_BELOW)].into_iter().chain(used.iter().map(|support| support.text(routines, real)))
    {
        writer.blank();
        writer.lines(text.trim_end());
    }
    routines.used_lookup_tables().for_each(|table| lookup_table(&mut writer, routines, table, real));
    ranges(&mut writer, spec, routines, real);
    writer.lines(body.trim_end());
    compensated::definitions(&mut writer, spec, routines, real);
    self_test::definition(&mut writer, spec, model, routines, &used, real);
    writer.finish()
}

/// A test of `abbe` compares the bits under these flags.
const SAME_BITS: &str = "The results have the bits of the Rust code if products and sums are rounded one by one: give gcc and clang the flag \
     `-ffp-contract=off`. gcc that may use fused multiply-add (`-mfma`, `-march=native`) needs `-fno-tree-slp-vectorize` as \
     well. Without them results differ by rounding errors.";

/// A test of `abbe` checks these measured figures for the shipped manipulators.
const SINGLE: &str = "This code computes in single precision. Over 1000 configurations of every shipped manipulator, the difference \
     from double precision was at most 1.6e-7 of the length of the arm in positions and 3.2e-7 of the largest entry in `J_e`; \
     corrected commands brought the tool to within 3.2e-7 of that length and 1.3e-5 rad where the pose is reached.";

/// Compilers that may assume that there is no NaN drop the checks; those that may reassociate sums
/// break the reduction of angles.
const REFUSED: &str = include_str!("refused.h");

/// `ABBE_PLAIN_SIZES` is for MISRA C, whose rule 17.6 has no `static`.
const SIZES: &str = include_str!("sizes.h");

const BEGIN: &str = "\
#ifdef __cplusplus
extern \"C\" {
#endif
";

const END: &str = "
#undef ABBE_SIZE
#undef ABBE_RESTRICT
#ifdef __cplusplus
}
#endif

#endif
";

fn enumeration(writer: &mut Writer, documentation: &str, entries: &[(String, impl AsRef<str>)]) {
    writer.lines(&format!("/** {documentation} */"));
    writer.open("enum");
    for (k, (entry, documentation)) in entries.iter().enumerate() {
        let documentation = documentation.as_ref();
        match documentation.len() < LINE - 12 {
            true => writer.lines(&format!("/** {} */", harmless(documentation))),
            false => {
                writer.lines("/**");
                writer.documentation(documentation);
                writer.lines(" */");
            }
        }
        writer.lines(&format!("{entry}{}", if k + 1 < entries.len() { "," } else { "" }));
    }
    writer.close("};");
}

/// Prints the numbers of frames, variables and so on.
fn counts(writer: &mut Writer, upper: &str, routines: &Routines) {
    use abbe_core::function::Count;
    let entries = [
        ("FRAMES", Count::Frames, "Number of frames n."),
        ("ERRORS", Count::Errors, "Number of generalized errors: 6n, the length of ε."),
        ("VARIABLES", Count::Variables, "Number of joint variables: the length of `q`."),
        ("PARAMETERS", Count::Parameters, "Number of structural parameters: the length of `s`."),
        ("INPUTS", Count::Inputs, "Number of inputs: the length of `u`."),
        ("SOURCES", Count::Sources, "Number of enabled sources."),
        ("EFFECTS", Count::Effects, "Number of errors that the sources cause."),
        ("SOLUTIONS", Count::Solutions, "Largest number of solutions of inverse kinematics."),
    ];
    let arrays =
        || routines.signatures().flat_map(|signature| signature.arguments.iter().chain(signature.results));
    let is_used = |count: &Count| {
        let is_some = count.value(&routines.description) > 0;
        is_some && (*count == Count::Frames || arrays().any(|array| array.shape.contains(count)))
    };
    let entry = |(name, count, documentation): (&str, Count, &'static str)| {
        (format!("{upper}_{name} = {}", count.value(&routines.description)), documentation)
    };
    let used: Vec<_> = entries.into_iter().filter(|(_, count, _)| is_used(count)).map(entry).collect();
    writer.blank();
    enumeration(writer, "Sizes of the arrays.", &used);
}

/// Prints the index of each name in `q`, `s` and `u`.
fn indices(writer: &mut Writer, upper: &str, spec: &Spec) {
    let joints = spec.variables.iter().map(|one| {
        let frame = format!("Joint of frame {}", spec.frames[one.frame].name);
        (&one.name, described(&frame, one.kind.either("rad", spec.length.symbol())))
    });
    let of_line = |text: String, line: usize| format!("{text} {}, line {line}.", spec.file);
    let parameters = spec.parameters.iter();
    let parameters =
        parameters.map(|one| (&one.name, of_line(described(&one.description, &one.unit), one.line)));
    let inputs = spec.inputs.iter();
    let inputs = inputs.map(|one| (&one.name, of_line(described(&one.description, &one.unit), one.line)));
    let lists: [(&str, Vec<(&String, String)>); 3] =
        [("q", joints.collect()), ("s", parameters.collect()), ("u", inputs.collect())];
    for (array, names) in lists.into_iter().filter(|(_, names)| !names.is_empty()) {
        let entry = |(k, (name, documentation)): (usize, (&String, String))| {
            (format!("{upper}_{}_{name} = {k}", array.to_ascii_uppercase()), documentation)
        };
        let entries: Vec<(String, String)> = names.into_iter().enumerate().map(entry).collect();
        writer.blank();
        enumeration(writer, &format!("Indices in `{array}`."), &entries);
    }
}

/// Prints limits, home, nominal values and ranges, either as declarations or as definitions.
fn values(
    writer: &mut Writer,
    spec: &Spec,
    routines: &Routines,
    real: Real,
    before: &str,
    with_numbers: bool,
) {
    let ones = |values: Vec<f64>| values.into_iter().map(|value| real.number(value)).collect();
    let pairs = |values: Vec<[f64; 2]>| -> Vec<String> {
        let pair = |pair: [f64; 2]| format!("{{ {} }}", pair.map(|value| real.number(value)).join(", "));
        values.into_iter().map(pair).collect()
    };
    let (variables, parameters) = (spec.variables.iter(), spec.parameters.iter());
    let inputs = if takes_inputs(routines) { &spec.inputs[..] } else { &[] }.iter();
    let corrected = variables.clone().filter(|_| routines.has_compensated());
    let bounds =
        |bounds| ones(corrected.clone().map(|one| bound(&routines.description, one.kind, bounds)).collect());
    let by_default =
        |what: &str, [angle, length]: [f64; 2]| format!("{what}, by default: {angle} rad, {length} m.");
    let change = by_default("Largest change of a correction in a cycle", CHANGE);
    let largest = by_default("Largest correction", LARGEST);
    let limits = pairs(variables.clone().map(|one| one.limits).collect());
    let home = ones(variables.map(|one| one.home).collect());
    let rotations = ones(vec![1.0; if routines.has_commands() { 3 } else { 0 }]);
    let parameters = ones(parameters.map(|one| one.value).collect());
    let nominal = ones(inputs.clone().map(|one| one.value).collect());
    let ranges = pairs(inputs.map(|one| one.range).collect());
    let lists: [(&str, &str, &str, Vec<String>); 8] = [
        ("Lower and upper limits of the variables.", "limits", "[2]", limits),
        ("Home position of the variables.", "home", "", home),
        (&change, "change", "", bounds(CHANGE)),
        (&largest, "largest", "", bounds(LARGEST)),
        ("`rotations` of the whole pose.", "whole_pose", "", rotations),
        ("Nominal values of the parameters `s`.", "parameters", "", parameters),
        ("Default values of the inputs `u`.", "inputs", "", nominal),
        ("Lower and upper ends of the ranges of the inputs.", "ranges", "[2]", ranges),
    ];
    for (what, name, end, entries) in lists.into_iter().filter(|(.., entries)| !entries.is_empty()) {
        let head = format!("{before}const {real} {}_{name}[{}]{end}", spec.name, entries.len());
        writer.blank();
        if with_numbers {
            writer.braces(&format!("{head} = "), &entries, ";");
        } else {
            writer.lines(&format!("/** {what} */\n{head};"));
        }
    }
}

/// Returns `true` if a function takes inputs.
fn takes_inputs(routines: &Routines) -> bool {
    let functions = routines.list.iter().filter(|routine| routine.function.is_some());
    let mut arrays = functions.flat_map(|routine| &routine.arrays);
    arrays.any(|array| array.name == "u" && !array.is_empty(&routines.description))
}

/// Prints the function that checks the ranges of inputs.
fn ranges(writer: &mut Writer, spec: &Spec, routines: &Routines, real: Real) {
    if takes_inputs(routines) {
        let numbers = [("NAME", spec.name.clone()), ("COUNT", spec.inputs.len().to_string())];
        let text = numbers.iter().fold(real.text(IN_RANGE), |text, (word, with)| text.replace(word, with));
        writer.blank();
        writer.lines(text.trim_end());
    }
}

const IN_RANGE: &str = include_str!("in_range.c");

/// Prints the function of a lookup table.
fn lookup_table(writer: &mut Writer, routines: &Routines, table: &Table, real: Real) {
    let (lookup, name) = (table.lookup(), function_of(&table.constant_name()));
    let buckets = if lookup.starts.is_empty() { lookup.pieces.len() } else { lookup.starts.len() } - 2;
    let documentation = table.documentation(&escaped(&table.description));
    let procedure = look_up(&lookup, real.scale(table, buckets), documentation);
    CPrinter { writer, routines, real }.helper(&procedure, &name, None);
}
