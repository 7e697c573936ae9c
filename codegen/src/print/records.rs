//! The description of a manipulator as nested records.

use abbe_core::Description;
use abbe_core::compensator::{CHANGE, LARGEST, Status, bound};
use abbe_spec::literal::quoted;

use super::layout::Writer;

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
