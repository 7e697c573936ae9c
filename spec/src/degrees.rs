//! Angles without a unit that are probably in degrees.

use std::f64::consts::TAU;

use crate::diagnostic::{Diagnostic, Span};
use crate::document::{Document, Item};
use crate::expr::{Binary, Expression, Kind};

/// Returns the diagnostic of an angle without a unit that is a whole number of more than one
/// revolution: `90` is never 90 rad. `quote` encloses a value with a unit.
fn in_degrees(value: f64, what: &str, at: Span, quote: &str) -> Option<Diagnostic> {
    let is_probable = value.abs() > TAU && value.fract() == 0.0;
    is_probable.then(|| {
        Diagnostic::new(at, format!("{what} is {value} rad, more than one revolution"))
            .label("a number without a unit is in rad")
            .help(format!("write `{quote}{value} deg{quote}` for degrees, or `{quote}{value} rad{quote}`"))
    })
}

/// Records a number without a unit in the text of an angle that is probably in degrees, and returns
/// `true` if there is one.
pub fn check_angle_text(text: &str, what: &str, at: Span, document: &Document) -> bool {
    let found = text.trim().parse().ok().and_then(|value| in_degrees(value, what, at, ""));
    let is_found = found.is_some();
    document.found.borrow_mut().extend(found);
    is_found
}

/// Records an angle of a key that is probably in degrees, and returns `true` if it is.
pub(crate) fn check_angle_item(item: &Item<'_>, what: &str) -> bool {
    let found = item.number().and_then(|value| in_degrees(value, what, item.span(), "\""));
    let is_found = found.is_some();
    item.document.found.borrow_mut().extend(found);
    is_found
}

/// Records the numbers without a unit in the outermost sum of an angle that are probably in
/// degrees, as in `q3 - 90`.
pub(crate) fn check_angle(angle: &Expression, document: &Document) {
    check_bare(angle, document, |value, at, quote| in_degrees(value, "an angle", at, quote));
}

/// Smallest error of an angle without a unit that is asked about, in rad: more than a degree.
const LARGE_ERROR: f64 = 0.02;

/// Records the numbers without a unit in the outermost sum of an error of an angle that are
/// probably in mrad or degrees: `0.3` is hardly ever 0.3 rad.
pub(crate) fn check_error_of_angle(error: &Expression, document: &Document) {
    check_bare(error, document, |value, at, quote| {
        (value.abs() >= LARGE_ERROR).then(|| {
            let degrees = (10.0 * value.to_degrees()).round() / 10.0;
            let written = |unit: &str| format!("`{quote}{value} {unit}{quote}`");
            Diagnostic::new(at, format!("an error of {value} rad is {degrees}°"))
                .label("a number without a unit is in rad")
                .help(format!(
                    "write {} or {}, or {} if it is as large as that",
                    written("mrad"),
                    written("deg"),
                    written("rad")
                ))
        })
    });
}

/// Records what a check finds of the numbers without a unit in the outermost sum of an expression,
/// given each number, its place and what encloses a value with a unit there.
fn check_bare(
    expression: &Expression,
    document: &Document,
    check: impl Fn(f64, Span, &str) -> Option<Diagnostic>,
) {
    let terms = expression.terms();
    let mut summands = vec![terms.len() - 1];
    while let Some(index) = summands.pop() {
        let term = &terms[index];
        match (term.kind, term.value) {
            (_, Some(value)) if term.bare => {
                document.found.borrow_mut().extend(check(value, term.span.clone(), ""));
            }
            // A TOML number has no quotes yet.
            (Kind::Number(value), _) if is_number(document.text.get(term.span.clone())) => {
                document.found.borrow_mut().extend(check(value, term.span.clone(), "\""));
            }
            (Kind::Binary(Binary::Add | Binary::Sub, left, right), _) => summands.extend([left, right]),
            (Kind::Neg(operand), _) => summands.push(operand),
            _ => {}
        }
    }
}

fn is_number(text: Option<&str>) -> bool {
    text.is_some_and(|text| text.parse::<f64>().is_ok())
}
