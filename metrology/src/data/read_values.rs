//! Readers of constants, columns and units.

use abbe::LengthUnit;
use abbe_spec::diagnostic::Diagnostic;
use abbe_spec::document::{Document, Item, Section};
use abbe_spec::expr::{Dimension, LARGEST};
use abbe_spec::value::parse_value;

use super::choices::UNKNOWN;
use super::column::Column;

/// Reads a positive number whose square and reciprocal are finite.
pub(super) fn positive(item: &Item<'_>, dimension: Dimension) -> Option<f64> {
    let value = item.quantity(dimension)?;
    if value >= 1.0 / LARGEST {
        return Some(value);
    }
    let what = if value > 0.0 { "is too small to compute with" } else { "must be positive" };
    let help = "write one standard deviation, from the data sheet of the instrument";
    item.refuse(format!("`{}` {what}", item.key), help)
}

/// Returns whether a number is to be estimated from the data.
pub(super) fn is_unknown(item: &Item<'_>) -> bool {
    item.is_text() && item.string().as_deref() == Some(UNKNOWN[0].0)
}

/// Reads a standard deviation; `Some(None)` if it is to be estimated from the data.
pub(super) fn deviation(item: &Item<'_>, dimension: Dimension) -> Option<Option<f64>> {
    match is_unknown(item) {
        true => Some(None),
        false => positive(item, dimension).map(Some),
    }
}

/// Returns the initial value of a standard deviation that is estimated: 10 µm or 10 µrad.
pub(super) fn initial_deviation(is_angle: bool, length: LengthUnit) -> f64 {
    if is_angle { 1e-5 } else { 1e-5 / length.in_metres() }
}

pub(super) fn column(item: &Item<'_>) -> Option<Column> {
    item.string().map(|name| Column { name: name.trim().to_owned(), span: Some(item.span()) })
}

pub(super) fn columns<const N: usize>(section: &Section<'_>, key: &str) -> Option<[Column; N]> {
    let item = section.required(key)?;
    let items: [Item<'_>; N] = item.entries(&format!("{N} names of columns"))?;
    let columns: Vec<Column> = items.iter().filter_map(|item| column(item)).collect();
    columns.try_into().ok()
}

/// Reads `unit`, a text such as "deg", as a factor to coherent units.
pub(super) fn unit(section: &Section<'_>, dimension: Dimension) -> Option<f64> {
    let item = section.required("unit")?;
    let name = item.string()?;
    if name.trim().is_empty() {
        let help = match dimension {
            Dimension::NONE => "write `rad` or `deg`, or `1` for a pure number",
            _ => "write the unit of the numbers in the file: `mm`, `m`, `kg` …",
        };
        return item.refuse("this unit is empty", help);
    }
    if name.trim() == "1" && dimension == Dimension::NONE {
        return Some(1.0);
    }
    let text = format!("1 {name}");
    let line = Document::new("", text.as_str());
    let what = format!("the unit `{}`", name.escape_debug());
    let factor = parse_value(&line, 0..text.trim_end().len(), section.document.length, dimension, &what);
    if let (None, Some(found)) = (factor, line.found.into_inner().into_iter().next()) {
        let help = found.help.unwrap_or_else(|| "write `mm`, `deg`, `kg` …".to_owned());
        section.document.mistake(Diagnostic::new(item.span(), found.message).help(help));
    }
    factor
}
