//! Cell of a table: a number with a unit, or the variable of a joint with a constant.

use abbe::LengthUnit;
use abbe_spec::diagnostic::Span;
use abbe_spec::expr::{Dimension, LARGEST, UNIT_NAMES};
use abbe_spec::option::{UNITS_MM_DEG, option};
use abbe_spec::value::parse_value;
use abbe_spec::{DhConvention, Diagnostic, Document};

use super::columns::{Column, Columns};
use super::heading::{Quantity, Unit};
use crate::dh::table::Units;

/// Reads the cells of the table in a document.
pub(super) struct Cells<'c> {
    pub(super) document: &'c Document,
    pub(super) convention: DhConvention,
    pub(super) columns: &'c Columns,
    pub(super) units: Units,
    /// Unit of every length that is returned.
    pub(super) length: LengthUnit,
    /// A comma in a number is a decimal point.
    pub(super) decimal_comma: bool,
}

/// Sum of a constant and of variables with signs.
#[derive(Clone, Debug, Default)]
pub(super) struct Amount {
    /// Name and span of each variable, and 1 or −1.
    pub(super) variables: Vec<(String, Span, f64)>,
    pub(super) constant: f64,
}

impl Cells<'_> {
    /// Returns whether angles are in degrees, by the heading or else by the caller.
    pub(super) fn degrees(&self) -> bool {
        let heading = [Quantity::Alpha, Quantity::Theta]
            .into_iter()
            .find_map(|quantity| self.columns.get(quantity)?.unit);
        heading.map_or(self.units.degrees.unwrap_or(false), |unit| unit == Unit::Degree)
    }

    /// Returns the cell of a quantity in a row; `None` without such a column, and for an empty
    /// cell.
    pub(super) fn cell(&self, row: &[Span], quantity: Quantity) -> Option<(Column, Span)> {
        let column = self.columns.get(quantity)?;
        row.get(column.index).filter(|cell| !cell.is_empty()).map(|cell| (column.clone(), cell.clone()))
    }

    /// Reads a number in a cell, a length or an angle, in the units of the chain.
    pub(super) fn number(&self, column: &Column, cell: Span, is_length: bool) -> Option<f64> {
        let document = self.document;
        let whole = document.text.clone();
        let text = &whole[cell.clone()];
        // Numbers may have the sign of degrees, and the minus sign of typesetters.
        let (text, in_degrees) = text.strip_suffix('°').map_or((text, false), |text| (text.trim_end(), true));
        let plain = text.replace('−', "-").replace(' ', "");
        let plain =
            if self.decimal_comma && !plain.contains('.') { plain.replacen(',', ".", 1) } else { plain };
        if in_degrees && is_length {
            let help = "write lengths in mm or m";
            return document.refuse(cell, "expected a length, found an angle in degrees", help);
        }
        let Ok(number) = plain.parse::<f64>() else {
            let dimension = if is_length { Dimension::LENGTH } else { Dimension::NONE };
            return parse_value(document, cell, self.length, dimension, "this cell");
        };
        if number.is_nan() || number.abs() >= LARGEST {
            let help = "write a decimal number: `0.5`";
            return document.refuse(cell, "this number is too large or not finite", help);
        }
        let unit = if in_degrees { Some(Unit::Degree) } else { self.unit(column, is_length) };
        match unit {
            _ if number == 0.0 => Some(0.0),
            Some(Unit::Degree) => Some(number.to_radians()),
            Some(Unit::Radian) => Some(number),
            Some(Unit::Length(unit)) if unit == self.length => Some(number),
            Some(Unit::Length(LengthUnit::Metre)) => Some(number * 1e3),
            Some(Unit::Length(LengthUnit::Millimetre)) => Some(number / 1e3),
            None => {
                let (what, unit) = if is_length { ("length", "mm") } else { ("angle", "deg") };
                // Reported once, not for every cell.
                let message = format!("the unit of this {what} is unknown");
                if document.found.borrow().iter().all(|mistake| mistake.message != message) {
                    let help = format!(
                        "give it: `{units}`, or both as in `{UNITS_MM_DEG}`; or write it \
                         in the heading: `{} ({unit})`",
                        &whole[column.span.clone()],
                        units = option("units", unit)
                    );
                    document.mistake(Diagnostic::new(cell, message).help(help));
                }
                None
            }
        }
    }

    /// Returns the unit of the numbers of a column, by the heading or else by the caller.
    fn unit(&self, column: &Column, is_length: bool) -> Option<Unit> {
        let fits = |unit: &Unit| matches!(unit, Unit::Length(_)) == is_length;
        let general = match is_length {
            true => self.units.length.map(Unit::Length),
            false => self.units.degrees.map(|degrees| if degrees { Unit::Degree } else { Unit::Radian }),
        };
        column.unit.filter(fits).or(general)
    }

    /// Reads a cell of theta or d.
    pub(super) fn amount(&self, row: &[Span], quantity: Quantity) -> Option<Amount> {
        let Some((column, cell)) = self.cell(row, quantity) else { return Some(Amount::default()) };
        let is_length = quantity == Quantity::D;
        let document = self.document;
        let whole = document.text.clone();
        if variable(&whole, cell.clone()).is_none() {
            let constant = self.number(&column, cell, is_length)?;
            return Some(Amount { constant, ..Amount::default() });
        }
        // `[±] term [± term …]`
        let mut amount = Amount::default();
        for (sign, term) in terms(&whole, cell.clone()) {
            match variable(&whole, term.clone()) {
                Some(name) => {
                    let beside = [&whole[term.start..name.start], &whole[name.end..term.end]];
                    if beside.iter().any(|text| !text.trim().trim_end_matches('*').trim().is_empty()) {
                        return document.fail(not_understood(cell));
                    }
                    amount.variables.push((identifier(&whole[name.clone()]), name, sign));
                }
                None => amount.constant += sign * self.number(&column, term, is_length)?,
            }
        }
        Some(amount)
    }
}

/// Splits a cell at its signs, except those of exponents, and trims the terms.
fn terms(text: &str, cell: Span) -> Vec<(f64, Span)> {
    let cell_text = &text[cell.clone()];
    let is_exponent = |at: usize| {
        let mut before = cell_text[..at].chars().rev();
        let is_e = before.next().is_some_and(|c| matches!(c, 'e' | 'E'));
        is_e && before.next().is_some_and(|c| c.is_ascii_digit() || c == '.')
    };
    let signs = cell_text.match_indices(['+', '-', '−']).filter(|(at, _)| !is_exponent(*at));
    let mut ends: Vec<(usize, usize, f64)> = vec![(0, 0, 1.0)];
    ends.extend(signs.map(|(at, sign)| (at, at + sign.len(), if sign == "+" { 1.0 } else { -1.0 })));
    let ends_of_terms = ends.iter().skip(1).map(|end| end.0).chain([cell_text.len()]);
    let term = |(&(_, start, sign), end): (&(usize, usize, f64), usize)| {
        let inner = cell_text[start..end].trim();
        let start = cell.start + start + cell_text[start..end].find(inner).unwrap_or_default();
        (sign, start..start + inner.len())
    };
    let terms = ends.iter().zip(ends_of_terms).map(term);
    // Before the first sign there may be nothing.
    terms.enumerate().filter(|(k, (_, span))| *k > 0 || !span.is_empty()).map(|(_, term)| term).collect()
}

/// Returns the first word of a cell that is neither a unit nor a constant.
fn variable(text: &str, cell: Span) -> Option<Span> {
    let cell_text = &text[cell.clone()];
    let is_letter = |c: char| c.is_alphanumeric() || c == '_';
    let mut at = 0;
    while let Some(begin) = cell_text[at..].find(is_letter).map(|found| at + found) {
        let end = cell_text[begin..].find(|c| !is_letter(c)).map_or(cell_text.len(), |end| begin + end);
        let word = &cell_text[begin..end];
        let first = cell_text[begin..].chars().next();
        let is_number = first.is_some_and(|c| c.is_ascii_digit());
        let is_reserved = UNIT_NAMES.contains(&word)
            || matches!(word, "pi" | "sqrt" | "nan" | "NaN" | "inf" | "Inf" | "infinity");
        if !is_number && !is_reserved {
            return Some(cell.start + begin..cell.start + begin + word.len());
        }
        at = end;
    }
    None
}

/// Spells out θ and subscripts, and returns an identifier of a spec.
fn identifier(name: &str) -> String {
    let plain = |c: char| match c {
        'θ' | 'Θ' => "theta".to_owned(),
        '₀'..='₉' => {
            char::from_digit(u32::from(c) - u32::from('₀'), 10).map(String::from).unwrap_or_default()
        }
        c => c.to_string(),
    };
    abbe_spec::as_identifier(&name.chars().map(plain).collect::<String>())
}

fn not_understood(cell: Span) -> Diagnostic {
    Diagnostic::new(cell, "expected a number, or a joint variable with a constant added")
        .help("write `q1`, `-q1` or `q1 + 90`; a number alone is a constant")
}
