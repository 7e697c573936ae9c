//! `[tables.NAME]`: functions defined by points, in the spec or in a separate file.

use std::sync::Arc;

use super::points::{Columns, Points};
use super::{Declarations, INTERPOLATIONS, OUTSIDE, keys};
use crate::diagnostic::{Diagnostic, Span};
use crate::document::{Item, Section};
use crate::expr::{Allowed, Dimension, Entry, Extrapolation, Scope, Table, Unit, parse_unit};
use crate::manipulator::check_identifier;

/// Maximum number of tables.
const MOST: usize = 1000;

impl Declarations {
    /// Reads `[tables]`.
    pub(super) fn read_tables(&mut self, root: &Section<'_>) -> Option<()> {
        let Some(item) = root.get("tables") else { return Some(()) };
        let section = item.section()?;
        let before = root.document.mistakes();
        item.at_most(section.items().count(), MOST, "tables", "remove tables that no expression uses")?;
        for item in section.items() {
            check_identifier(&item.key, item.key_span.clone(), root.document);
            if self.scope.tables.iter().any(|table| table.name.eq_ignore_ascii_case(&item.key)) {
                let message = format!("`{}` differs from the name of another table only in case", item.key);
                root.document
                    .mistake(Diagnostic::new(item.key_span.clone(), message).help("rename one of them"));
            } else if let Some(table) = self.read_table(&item) {
                self.scope.tables.push(Arc::new(table));
            }
        }
        (root.document.mistakes() == before).then_some(())
    }

    fn read_table(&mut self, item: &Item<'_>) -> Option<Table> {
        let section = item.table(format!("[tables.{}]", item.key), &[&keys::LOOKUP])?;
        let description = section.optional_text("description");
        section.optional_text("reference");
        let interpolation = section.required("interpolation").and_then(|item| item.choice(&INTERPOLATIONS));
        let outside = section.get("outside");
        let outside = outside.map_or(Some(Extrapolation::Nothing), |item| item.choice(&OUTSIDE));
        let columns = section.get("file").map_or(Some(None), |item| Columns::read(&item).map(Some))?;
        let axes = ["x", "y"].map(|key| self.read_axis(&section.required(key)?, columns.as_ref()));
        let [Some(x), Some(y)] = axes else { return None };
        let dimensions = [x.dimension, y.dimension];
        let points = Points { x: x.values, y: y.values, places: x.places, columns: columns.as_ref() };
        let points = points.check(item)?;
        let table = Table::new(item.key.clone(), description, dimensions, points, interpolation?, outside?);
        if !table.is_finite() {
            let message = format!("the numbers of `{}` are too large to interpolate", item.key);
            return item.refuse_key(message, "check the units");
        }
        Some(table)
    }

    /// Reads the numbers of an axis: a list, a list with a unit, or a column of the file with a
    /// unit.
    fn read_axis(&self, item: &Item<'_>, columns: Option<&Columns>) -> Option<Axis> {
        if !item.is_table() {
            if let Some(columns) = columns {
                let message = format!("`{}` must name its column of {}", item.key, columns.file);
                let help = format!("write `{} = {{ column = \"…\", unit = \"mm\" }}`", item.key);
                return item.refuse(message, help);
            }
            return self.read_list(item);
        }
        let section = item.table(format!("`{}`", item.key), &[&keys::AXIS])?;
        let unit = section.get("unit").map_or(Some(Unit::NONE), |item| unit(&item, &self.scope))?;
        let (numbers, places) = match columns {
            Some(columns) => (columns.numbers(&section.required("column")?)?, Vec::new()),
            None => {
                if let Some(column) = section.get("column") {
                    let message = "`column` names a column of a file, and there is no `file`";
                    let help = "add `file = \"NAME.csv\"` to the table, or give `values = […]`";
                    return column.refuse(message, help);
                }
                let values = section.required("values")?;
                let list = self.read_list(&values)?;
                if list.dimension != Dimension::NONE {
                    let message = format!("the numbers of `{}` already have units", item.key);
                    return values.refuse(message, "remove `unit`, or the units of the numbers");
                }
                (list.values, list.places)
            }
        };
        let values = numbers.into_iter().map(|number| unit.convert(number, self.scope.length)).collect();
        Some(Axis { values, dimension: unit.dimension, places })
    }

    /// Reads a list of numbers of the same dimension.
    fn read_list(&self, item: &Item<'_>) -> Option<Axis> {
        let what = format!("a number of `{}`", item.key);
        let entry = Entry { dimension: None, what: &what, names: Allowed::Nothing };
        let mut dimension: Option<Dimension> = None;
        let mut axis = Axis { values: Vec::new(), dimension: Dimension::NONE, places: Vec::new() };
        for item in item.array("numbers in brackets")? {
            let (value, found) = item.constant(&self.scope, entry)?;
            // Zero needs no unit.
            let is_bare_zero = value == 0.0 && found == Dimension::NONE;
            if !is_bare_zero && found != *dimension.get_or_insert(found) {
                let expected = dimension.unwrap_or(Dimension::NONE);
                let message = format!("the numbers of `{}` must have the same dimension", item.key);
                let mistake = Diagnostic::new(item.span(), message);
                return item.document.fail(
                    mistake
                        .label(format!("this is {found}, not {expected}"))
                        .help("give every number its unit, or write `{ values = […], unit = \"mm\" }`"),
                );
            }
            axis.values.push(value);
            axis.places.push(item.span());
        }
        axis.dimension = dimension.unwrap_or(Dimension::NONE);
        Some(axis)
    }
}

/// Numbers of an axis, in coherent units.
struct Axis {
    values: Vec<f64>,
    dimension: Dimension,
    /// Their locations; empty if they are in another file.
    places: Vec<Span>,
}

fn unit(item: &Item<'_>, scope: &Scope) -> Option<Unit> {
    parse_unit(&item.located_text()?, scope, &mut item.document.found.borrow_mut())
}
