//! `[undetermined]`: the errors of an identified machine that its measurements could not determine.

use crate::option::IDENTIFY_OUT;
use abbe_core::Component;

use super::keys::{UNDETERMINED, UNDETERMINED_OF};
use crate::diagnostic::Diagnostic;
use crate::document::{Item, Section};
use crate::expr::{Allowed, Dimension, Entry, Scope};
use crate::manipulator::{Frame, Identified, Source, Undetermined};
use crate::value::read_name;

/// Reads the table; nothing is undetermined without one.
pub(super) fn read_undetermined(
    root: &Section<'_>,
    frames: &[Frame],
    sources: &[Source],
    scope: &Scope,
) -> Option<Undetermined> {
    let Some(item) = root.get("undetermined") else { return Some(Undetermined::default()) };
    let section = item.table("[undetermined]", &[&UNDETERMINED])?;
    let [points, of, rows] = ["points", "of", "rows"].map(|key| section.required(key));
    let (points_item, of, rows_item) = (points?, of?, rows?);
    let points = numbers(&points_item, Dimension::LENGTH, "a coordinate", scope)?;
    let rows = numbers(&rows_item, Dimension::NONE, "a standard deviation", scope)?;
    let mut all = Vec::new();
    for item in of.array("an array of tables `{ frame = \"…\", error = \"…\" }`")? {
        all.push(undetermined(&item, frames, sources)?);
    }
    let count = all.len();
    let help = format!("`{IDENTIFY_OUT}` writes this table; remove it if everything is determined");
    if rows.iter().any(|row| row.len() != count) {
        let message = format!("each of these directions must have {count} numbers");
        return rows_item.refuse(message, help);
    }
    let points: Option<Vec<[f64; 3]>> = points.into_iter().map(|point| point.try_into().ok()).collect();
    if points.is_none() {
        let message = "a point must have three coordinates";
        root.document.mistake(Diagnostic::new(points_item.span(), message).help(help));
    }
    Some(Undetermined { points: points?, of: all, rows })
}

/// Reads rows of numbers.
pub(super) fn numbers(
    item: &Item<'_>,
    dimension: Dimension,
    what: &'static str,
    scope: &Scope,
) -> Option<Vec<Vec<f64>>> {
    let mut rows = Vec::new();
    for row in item.array("rows of numbers")? {
        let mut numbers = Vec::new();
        for number in row.array("numbers")? {
            let entry = Entry { dimension: Some(dimension), what, names: Allowed::Nothing };
            numbers.push(number.constant(scope, entry)?.0);
        }
        rows.push(numbers);
    }
    Some(rows)
}

/// Reads an error of a frame, an error of `F_0`, or the magnitude of a source.
fn undetermined(item: &Item<'_>, frames: &[Frame], sources: &[Source]) -> Option<Identified> {
    let section = item.table("this entry of [undetermined]", &[&UNDETERMINED_OF])?;
    if let Some(source) = section.get("source") {
        let names = sources.iter().map(|source| source.name.as_str());
        return read_name(&source, names, "source").map(Identified::Magnitude);
    }
    let component =
        section.required("error")?.choice(&Component::ALL.map(|component| (component.name(), component)))?;
    let Some(frame) = section.get("frame") else { return Some(Identified::Base(component)) };
    let frame = read_name(&frame, frames.iter().map(|frame| frame.name.as_str()), "frame")?;
    Some(Identified::Error(frame, component))
}
