//! Matlab and Octave: a class of static functions, one configuration at a time.
//!
//! Arrays are matrices in Matlab's column-major order, which is the order of the numbers in the
//! Rust arrays. `functions` prints routines, `operators` expressions, `procedures` and
//! `compensated` the corrected commands.

mod compensated;
mod functions;
mod operators;
mod procedures;

use std::collections::HashSet;

use abbe_core::compensator::{CHANGE, LARGEST, bound};
use abbe_core::function::COMPENSATED;
use abbe_spec::Spec;
use abbe_spec::expr::Table;

use self::functions::{function, list};
use self::operators::{WORDS, number, spelled};
use super::header::header;
use super::layout::Writer;
use super::lists::lists;
use super::names::{distinct, renamed};
use super::source_file::SourceFile;
use super::text::{escaped, harmless, wrapped};
use crate::procedure::{Precision, Procedure, compensated as described};
use crate::program::Routines;

/// Returns the file of a manipulator's class. Matlab requires the file to have the name of the
/// class.
pub(super) fn class(spec: &Spec, routines: &Routines) -> SourceFile {
    let class = class_name(spec, routines);
    let mut writer = Writer::new("%");
    writer.begin(&format!("classdef {class}"));
    header(&mut writer, spec, routines);
    writer.documentation_line("");
    writer.documentation(&format!(
        "Call functions as `{class}.pose(q, {class}.parameters)`, for one configuration at a time. A pose is a matrix \
         `[x_axis y_axis z_axis position]` of 3 rows and 4 columns; J_e has 6 rows."
    ));
    if let Some(note) = renamed(spec, "class", &class) {
        writer.documentation_line("");
        writer.documentation(&note);
    }
    properties(&mut writer, routines);
    writer.blank();
    writer.begin("methods (Static)");
    writer.paragraphs(HELPERS);
    if routines.used_lookup_tables().next().is_some() {
        writer.blank();
        writer.paragraphs(LOOK_UP);
    }
    for routine in &routines.list {
        function(&mut writer, &class, spec, routines, routine);
    }
    compensated::compensated(&mut writer, &class, spec, routines);
    writer.close("end");
    writer.close("end");
    SourceFile { name: format!("{class}.m"), text: writer.finish() }
}

/// Returns the name of the class: the manipulator's, unless it is a keyword, or the name of a
/// function, a property, an argument or a local variable.
fn class_name(spec: &Spec, routines: &Routines) -> String {
    let procedures = described(spec, Precision::Double);
    let arrays = routines.list.iter().flat_map(|routine| &routine.arrays).map(|array| array.name);
    let signature = COMPENSATED.arguments.iter().chain(COMPENSATED.results).map(|array| array.name);
    let names = OWN.into_iter().chain(PROPERTIES).chain(WORDS.split_whitespace()).chain(arrays);
    let names = names.chain(signature).chain(routines.list.iter().map(|routine| routine.name));
    let names: HashSet<&str> = names.chain(procedures.iter().flat_map(Procedure::names)).collect();
    distinct(spelled(&spec.name), "_", |name| names.contains(name))
}

/// Functions with a text of their own, and the variables of these.
const OWN: [&str; 24] = [
    "only_real",
    "side",
    "least",
    "greatest",
    "look_up",
    "is_given",
    "clamped",
    "a",
    "b",
    "x",
    "y",
    "name",
    "value",
    "count",
    "table",
    "order",
    "even",
    "last",
    "nearest",
    "bucket",
    "piece",
    "unit",
    "step",
    "p",
];

const PROPERTIES: [&str; 13] = [
    "title",
    "length_unit",
    "orientation",
    "variables",
    "limits",
    "home",
    "change",
    "largest",
    "parameter_names",
    "parameters",
    "input_names",
    "inputs",
    "ranges",
];

/// Prints names, units, limits, values and the tables of the functions.
fn properties(writer: &mut Writer, routines: &Routines) {
    let description = &routines.description;
    writer.blank();
    writer.begin("properties (Constant)");
    comment(writer, "Names, units, limits and nominal values, in the order of the arguments.");
    let texts = [
        ("title", &description.title[..]),
        ("length_unit", description.length.symbol()),
        ("orientation", description.orientation.name()),
    ];
    for (name, text) in texts {
        writer.lines(&format!("{name} = {};", quoted(text)));
    }
    let names = |names: Vec<&str>| names.into_iter().map(quoted).collect::<Vec<_>>();
    let pair = |[lower, upper]: [f64; 2]| format!("{} {};", number(lower), number(upper));
    let numbers = |values: Vec<f64>| values.into_iter().map(number).collect::<Vec<_>>();
    let variables = || description.variables.iter();
    let parameters = || description.parameters.iter();
    let inputs = || description.inputs.iter();
    list(writer, "variables", ["{", "}"], &names(variables().map(|variable| &variable.name[..]).collect()));
    list(
        writer,
        "limits",
        ["[", "]"],
        &variables().map(|variable| pair(variable.limits)).collect::<Vec<_>>(),
    );
    list(writer, "home", ["[", "]"], &numbers(variables().map(|variable| variable.home).collect()));
    let bounds = |bounds| numbers(variables().map(|one| bound(description, one.kind, bounds)).collect());
    list(writer, "change", ["[", "]"], &bounds(CHANGE));
    list(writer, "largest", ["[", "]"], &bounds(LARGEST));
    list(writer, "parameter_names", ["{", "}"], &names(parameters().map(|one| &one.name[..]).collect()));
    list(writer, "parameters", ["[", "]"], &numbers(parameters().map(|one| one.nominal).collect()));
    list(writer, "input_names", ["{", "}"], &names(inputs().map(|one| &one.name[..]).collect()));
    list(writer, "inputs", ["[", "]"], &numbers(inputs().map(|one| one.nominal).collect()));
    list(writer, "ranges", ["[", "]"], &inputs().map(|one| pair(one.range)).collect::<Vec<_>>());
    for numbers in lists(routines.used_tables(), routines.used_sums()) {
        comment(writer, numbers.documentation);
        list(writer, &numbers.name, ["[", "]"], &numbers.entries(number));
    }
    for table in routines.used_lookup_tables() {
        lookup_table(writer, table);
    }
    writer.close("end");
}

/// Prints a lookup table.
fn lookup_table(writer: &mut Writer, table: &Table) {
    let lookup = table.lookup();
    comment(writer, &table.documentation(&escaped(&table.description)));
    writer.begin(&format!("{} = struct( ...", spelled(&table.constant_name())));
    let (first, scale) = (number(lookup.first), number(lookup.scale));
    writer.lines(&format!("'first', {first}, 'scale', {scale}, 'steps', {}, ...", lookup.steps));
    let field = |writer: &mut Writer, name: &str, entries: Vec<String>, end: &str| {
        writer.lines(&format!("'{name}', [ ..."));
        entries.chunks(6).for_each(|line| writer.lines(&format!("    {} ...", line.join(" "))));
        writer.lines(&format!("]{end}"));
    };
    field(writer, "starts", lookup.starts.iter().map(u32::to_string).collect(), ", ...");
    field(writer, "knots", lookup.knots.iter().map(|knot| number(*knot)).collect(), ", ...");
    let piece = |piece: &[f64; 4]| format!("{};", piece.map(number).join(" "));
    field(writer, "pieces", lookup.pieces.iter().map(piece).collect(), ");");
    writer.end();
}

fn comment(writer: &mut Writer, text: &str) {
    for line in wrapped(&harmless(text), 92) {
        writer.lines(&format!("% {line}"));
    }
}

/// Returns a text as a literal on one line.
fn quoted(text: &str) -> String {
    format!("'{}'", harmless(text).replace('\'', "''"))
}

/// Functions whose behavior differs from that of Matlab's own.
const HELPERS: &str = "\
function y = only_real(y)
    % Replaces a complex number by NaN.
    if ~isreal(y)
        y = NaN;
    end
end

function y = side(x)
    % Returns -1 for negative numbers, else 1.
    y = 1;
    if x < 0
        y = -1;
    end
end

function y = least(a, b)
    % Returns the smaller number, or NaN if one of them is NaN.
    y = min(a, b);
    if isnan(a) || isnan(b)
        y = NaN;
    end
end

function y = greatest(a, b)
    % Returns the larger number, or NaN if one of them is NaN.
    y = max(a, b);
    if isnan(a) || isnan(b)
        y = NaN;
    end
end

function is_given(name, value, count)
    % Raises an error if an argument has the wrong number of elements.
    if numel(value) ~= count
        error('abbe:size', '%s: expected %d numbers, found %d', name, count, numel(value));
    end
end
";

/// Value of a table or of one of its derivatives, by the algorithm of `LookupTable` in the crate
/// `abbe`.
const LOOK_UP: &str = "\
function y = look_up(table, order, x)
    % Returns a derivative of a table at x; order 0 is the table itself.
    even = isempty(table.starts);
    u = (x - table.first) * table.scale;
    if isnan(u)
        y = NaN;
        return
    end
    last = numel(table.starts) - 2;
    if even
        last = size(table.pieces, 1) - 2;
    end
    nearest = min(max(u - 0.5, -1), last);
    % Adding 1.5 * 2^52 rounds to the nearest integer.
    bucket = nearest + 6755399441055744 - 6755399441055744;
    piece = bucket + 1;
    t = u - bucket;
    unit = table.scale;
    if ~even
        unit = 1;
        piece = table.starts(piece + 1);
        step = floor(2 ^ (table.steps - 1));
        while step >= 1
            if piece + step < numel(table.knots) && x > table.knots(piece + step + 1)
                piece = piece + step;
            end
            step = floor(step / 2);
        end
        t = x - table.knots(piece + 1);
    end
    p = table.pieces(piece + 1, :);
    switch order
        case 0
            y = ((p(4) * t + p(3)) * t + p(2)) * t + p(1);
        case 1
            y = ((3 * p(4) * t + 2 * p(3)) * t + p(2)) * unit;
        case 2
            y = (6 * p(4) * t + 2 * p(3)) * unit ^ 2;
        otherwise
            y = 6 * p(4) * unit ^ 3;
    end
end
";
