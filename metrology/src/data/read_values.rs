//! Readers of constants, columns and units.

use abbe::LengthUnit;
use abbe_spec::diagnostic::Diagnostic;
use abbe_spec::document::{Document, Item, Section};
use abbe_spec::expr::{Dimension, LARGEST};
use abbe_spec::value::parse_value;

use super::choices::UNKNOWN;
use super::column::Column;

/// Reads a positive number whose square and reciprocal are finite.
pub(super) fn positive(item: &Item<'_>, document: &mut Document, dimension: Dimension) -> Option<f64> {
    let value = document.quantity(item, dimension)?;
    if value >= 1.0 / LARGEST {
        return Some(value);
    }
    let what = if value > 0.0 { "is too small to compute with" } else { "must be positive" };
    let help = "write one standard deviation, from the data sheet of the instrument";
    document.refuse(item.span(), format!("`{}` {what}", item.key), help)
}

/// Returns whether a number is to be estimated from the data.
pub(super) fn is_unknown(item: &Item<'_>, document: &mut Document) -> bool {
    item.is_text() && document.string(item).as_deref() == Some(UNKNOWN[0].0)
}

/// Reads a standard deviation; `Some(None)` if it is to be estimated from the data.
pub(super) fn deviation(
    item: &Item<'_>,
    document: &mut Document,
    dimension: Dimension,
) -> Option<Option<f64>> {
    match is_unknown(item, document) {
        true => Some(None),
        false => positive(item, document, dimension).map(Some),
    }
}

/// Returns the initial value of a standard deviation that is estimated: 10 µm or 10 µrad.
pub(super) fn initial_deviation(is_angle: bool, length: LengthUnit) -> f64 {
    if is_angle { 1e-5 } else { 1e-5 / length.in_metres() }
}

pub(super) fn column(item: &Item<'_>, document: &mut Document) -> Option<Column> {
    document.string(item).map(|name| Column { name: name.trim().to_owned(), span: Some(item.span()) })
}

pub(super) fn columns<const N: usize>(
    section: &Section<'_>,
    key: &str,
    document: &mut Document,
) -> Option<[Column; N]> {
    let item = section.required(key, document)?;
    let items: [Item<'_>; N] = document.entries(&item, &format!("{N} names of columns"))?;
    let columns: Vec<Column> = items.iter().filter_map(|item| column(item, document)).collect();
    columns.try_into().ok()
}

/// Reads `unit`, a text such as "deg", as a factor to coherent units.
pub(super) fn unit(section: &Section<'_>, document: &mut Document, dimension: Dimension) -> Option<f64> {
    let item = section.required("unit", document)?;
    let name = document.string(&item)?;
    if name.trim().is_empty() {
        let help = match dimension {
            Dimension::NONE => "write `rad` or `deg`, or `1` for a pure number",
            _ => "write the unit of the numbers in the file: `mm`, `m`, `kg` …",
        };
        return document.refuse(item.span(), "this unit is empty", help);
    }
    if name.trim() == "1" && dimension == Dimension::NONE {
        return Some(1.0);
    }
    let text = format!("1 {name}");
    let mut line = Document::new("", text.as_str());
    let what = format!("the unit `{}`", name.escape_debug());
    let factor = parse_value(&mut line, 0..text.trim_end().len(), document.length, dimension, &what);
    if let (None, Some(found)) = (factor, line.found.into_iter().next()) {
        let help = found.help.unwrap_or_else(|| "write `mm`, `deg`, `kg` …".to_owned());
        document.mistake(Diagnostic::new(item.span(), found.message).help(help));
    }
    factor
}
