//! Lists of numbers that the loops of long chains read, and all numbers of a file.
//!
//! The description of a manipulator as nested records.

use abbe_core::Description;
use abbe_core::compensator::{CHANGE, LARGEST, Status, bound};
use abbe_spec::{Spec, literal::quoted};

use super::Writer;
use crate::program::{Operand, Program, Routines, Sums, Table};

/// A list of whole or real numbers.
pub(super) struct List<'r> {
    pub(super) name: String,
    pub(super) documentation: &'r str,
    values: Vec<f64>,
    pub(super) is_whole: bool,
}

impl List<'_> {
    /// Returns the numbers as text; `number` prints real ones.
    pub(super) fn entries(&self, number: impl Fn(f64) -> String) -> Vec<String> {
        let entry = |value: &f64| if self.is_whole { value.to_string() } else { number(*value) };
        self.values.iter().map(entry).collect()
    }
}

/// Returns the columns of tables, and the constants, entries, terms and factors of sums, without
/// empty lists.
pub(super) fn lists<'r>(
    tables: impl Iterator<Item = &'r Table>,
    sums: impl Iterator<Item = &'r Sums>,
) -> Vec<List<'r>> {
    let list = |name: &str, end: &str, documentation, is_whole, values: Vec<f64>| List {
        name: format!("{name}_{end}"),
        documentation,
        values,
        is_whole,
    };
    let columns = tables.flat_map(|Table { name, documentation, rows }| {
        let column = |column: usize| rows.iter().map(move |row| row[column] as f64).collect();
        [0, 1].map(|k| list(name, ["0", "1"][k], documentation, true, column(k)))
    });
    let parts = sums.flat_map(|Sums { name, constants, factors }| {
        let part = |take: fn(&(usize, usize, f64)) -> f64| factors.iter().map(take).collect();
        [
            list(name, "CONSTANTS", "Constant term of each entry.", false, constants.clone()),
            list(name, "ENTRIES", "Entries, counted from 0.", true, part(|row| row.0 as f64)),
            list(name, "TERMS", "Term of each of these entries.", true, part(|row| row.1 as f64)),
            list(name, "FACTORS", "Factor of each of these terms.", false, part(|row| row.2)),
        ]
    });
    columns.chain(parts).filter(|list| !list.values.is_empty()).collect()
}

/// Returns all numbers of the programs, sums, tables and values of a file.
pub(super) fn numbers(spec: &Spec, routines: &Routines) -> Vec<f64> {
    let programs = routines.programs().flat_map(Program::operands).filter_map(|operand| match operand {
        Operand::Constant(value) => Some(value),
        _ => None,
    });
    let sums = routines.sums.iter();
    let sums = sums.flat_map(|sums| sums.constants.iter().copied().chain(sums.factors.iter().map(|f| f.2)));
    let variables = spec.variables.iter().chain(&spec.passive);
    let variables = variables.flat_map(|variable| variable.limits.into_iter().chain([variable.home]));
    let parameters = spec.parameters.iter().map(|parameter| parameter.value);
    let inputs = spec.inputs.iter().flat_map(|input| input.range.into_iter().chain([input.value]));
    let tables = spec.tables.iter().flat_map(|table| {
        let lookup = table.lookup();
        let pieces = lookup.pieces.iter().flatten().chain(lookup.knots).copied();
        pieces.chain([lookup.first, lookup.scale]).collect::<Vec<f64>>()
    });
    programs.chain(sums).chain(variables).chain(parameters).chain(inputs).chain(tables).collect()
}

/// Prints names, units, limits and nominal values, with keys and numbers in the syntax of the
/// language.
pub(super) fn records(
    writer: &mut Writer,
    description: &Description,
    key: fn(&str) -> String,
    number: fn(f64) -> String,
) {
    let record = |fields: &[(&str, String)]| {
        let fields = fields.iter().map(|(name, value)| format!("{}: {value}", key(name)));
        format!("{{ {} }}", fields.collect::<Vec<_>>().join(", "))
    };
    let pair = |[lower, upper]: [f64; 2]| format!("[{}, {}]", number(lower), number(upper));
    let texts = [
        ("name", &description.name[..]),
        ("title", &description.title),
        ("length", description.length.symbol()),
        ("orientation", description.orientation.name()),
    ];
    for (name, text) in texts {
        writer.lines(&format!("{}: {},", key(name), quoted(text)));
    }
    let mut list = |name: &str, entries: Vec<String>| {
        writer.lines(&format!("{}: [", key(name)));
        entries.iter().for_each(|entry| writer.lines(&format!("    {entry},")));
        writer.lines("],");
    };
    list("frames", description.frames.iter().map(|frame| quoted(&frame.name)).collect());
    let variables = description.variables.iter().map(|variable| {
        let kind = format!("{:?}", variable.kind).to_ascii_lowercase();
        let (limits, home) = (pair(variable.limits), number(variable.home));
        let name = quoted(&variable.name);
        let [change, largest] =
            [CHANGE, LARGEST].map(|bounds| number(bound(description, variable.kind, bounds)));
        let fields = [("name", name), ("kind", quoted(&kind)), ("limits", limits), ("home", home)];
        record(&[&fields[..], &[("change", change), ("largest", largest)]].concat())
    });
    list("variables", variables.collect());
    let parameters = description.parameters.iter().map(|parameter| {
        let (name, unit) = (quoted(&parameter.name), quoted(&parameter.unit));
        record(&[("name", name), ("nominal", number(parameter.nominal)), ("unit", unit)])
    });
    list("parameters", parameters.collect());
    let inputs = description.inputs.iter().map(|input| {
        let (name, unit) = (quoted(&input.name), quoted(&input.unit));
        let (nominal, range) = (number(input.nominal), pair(input.range));
        record(&[("name", name), ("nominal", nominal), ("range", range), ("unit", unit)])
    });
    list("inputs", inputs.collect());
    list("sources", description.sources.iter().map(|source| quoted(&source.name)).collect());
    if !description.variables.is_empty() {
        let statuses = Status::ALL.map(|status| (status.name(), status.code().to_string()));
        writer.lines(&format!("{}: {},", key("statuses"), record(&statuses)));
    }
}
