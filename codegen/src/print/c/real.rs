//! Floating-point types of generated C.

use std::fmt;

use abbe_spec::Table;

use crate::procedure::Precision;

/// A floating-point type: its name, its literals and its functions of `math.h`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Real {
    /// `double`: 53 binary digits, the same bits as the Rust code.
    #[default]
    Double,
    /// `float`: 24 binary digits for all intermediate results.
    Float,
}

/// Functions of `math.h` that [`Real::text`] replaces.
const FUNCTIONS: [&str; 4] = ["cos", "fabs", "sin", "sqrt"];

impl Real {
    /// Every type.
    pub const ALL: [Self; 2] = [Self::Double, Self::Float];

    /// Returns the name in C and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Double => "double",
            Self::Float => "float",
        }
    }

    /// Returns the nearest representable number.
    pub fn nearest(self, value: f64) -> f64 {
        match self {
            Self::Double => value,
            Self::Float => f64::from(value as f32),
        }
    }

    /// Returns `true` if a number neither overflows nor underflows to 0.
    pub(super) fn has(self, value: f64) -> bool {
        let nearest = self.nearest(value);
        nearest.is_finite() == value.is_finite() && (nearest == 0.0) == (value == 0.0)
    }

    /// Returns the largest number.
    pub(super) fn largest(self) -> f64 {
        [f64::MAX, f64::from(f32::MAX)][self as usize]
    }

    /// Returns the precision of the corrected command.
    pub(crate) fn precision(self) -> Precision {
        [Precision::Double, Precision::Single][self as usize]
    }

    /// Returns the unit of roundoff: the maximum relative error of rounding.
    pub(super) fn unit_roundoff(self) -> f64 {
        self.epsilon() / 2.0
    }

    /// Returns the number of buckets per unit of a table's x, such that the last x lies within the
    /// last bucket.
    pub(super) fn scale(self, table: &Table, buckets: usize) -> f64 {
        let scale = table.lookup().scale;
        match self {
            Self::Double => scale,
            Self::Float => {
                let [first, last] = table.ends().map(|x| x as f32);
                let (width, count) = (last - first, buckets as f32);
                let mut scale = (scale as f32).min(count / width);
                while width.is_finite() && width * scale >= count {
                    scale = scale.next_down();
                }
                f64::from(scale)
            }
        }
    }

    /// Returns the shortest literal that represents the number exactly.
    pub(in crate::print) fn number(self, value: f64) -> String {
        let suffix = self.suffix();
        match self {
            _ if value.is_nan() => format!("({self})NAN"),
            _ if value.is_infinite() && value > 0.0 => format!("HUGE_VAL{}", suffix.to_ascii_uppercase()),
            _ if value.is_infinite() => format!("-HUGE_VAL{}", suffix.to_ascii_uppercase()),
            Self::Double => format!("{value:?}"),
            Self::Float => format!("{:?}{suffix}", value as f32),
        }
    }

    /// Returns the name of a function of `math.h` for the type.
    pub(super) fn function(self, name: &str) -> String {
        format!("{name}{}", self.suffix())
    }

    /// Returns the number that rounds to the nearest integer when added and subtracted again: 1.5
    /// times the smallest number from which on all numbers are integers.
    pub(super) fn rounder(self) -> String {
        self.number(1.5 / self.epsilon())
    }

    /// Converts C code for `double` to the type: its name, literals and functions. Comments stay
    /// unchanged.
    pub(super) fn text(self, text: &str) -> String {
        let mut converted = String::with_capacity(text.len());
        for (k, part) in text.split("/*").enumerate() {
            let code = match part.split_once("*/") {
                Some((comment, code)) if k > 0 => {
                    converted.extend(["/*", comment, "*/"]);
                    code
                }
                _ => part,
            };
            words(code).for_each(|word| converted += &self.word(word));
        }
        converted
    }

    fn word(self, word: &str) -> String {
        let is_real = word.starts_with(|c: char| c.is_ascii_digit()) && word.contains(['.', 'e']);
        match word {
            "double" => self.name().to_owned(),
            "HUGE_VAL" => self.number(f64::INFINITY),
            _ if FUNCTIONS.contains(&word) => self.function(word),
            _ if is_real => word.parse().map_or_else(|_| word.to_owned(), |value| self.number(value)),
            _ => word.to_owned(),
        }
    }

    fn suffix(self) -> &'static str {
        ["", "f"][self as usize]
    }

    fn epsilon(self) -> f64 {
        [f64::EPSILON, f64::from(f32::EPSILON)][self as usize]
    }
}

impl fmt::Display for Real {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Splits C code into names, numbers and the text between them.
fn words(code: &str) -> impl Iterator<Item = &str> {
    let mut rest = code;
    std::iter::from_fn(move || {
        let first = rest.chars().next()?;
        let is_number = first.is_ascii_digit();
        let mut before = first;
        let mut belongs = |c: char| {
            let is_sign = is_number && matches!(c, '+' | '-') && before == 'e';
            before = c;
            c.is_ascii_alphanumeric() || c == '_' || is_number && c == '.' || is_sign
        };
        let len = match first.is_ascii_alphanumeric() || first == '_' {
            true => rest.find(|c| !belongs(c)).unwrap_or(rest.len()),
            false => first.len_utf8(),
        };
        let (word, others) = rest.split_at(len);
        rest = others;
        Some(word)
    })
}

#[cfg(test)]
mod tests;
