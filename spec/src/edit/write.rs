//! Values of TOML files as text.

pub use crate::literal::quoted;

/// Writes a number with at most `digits` significant digits, in powers of ten.
pub fn number(value: f64, digits: usize) -> String {
    let decimals = digits.saturating_sub(1);
    format!("{:e}", format!("{value:.decimals$e}").parse::<f64>().unwrap_or(value) + 0.0)
}

/// Writes a number with its unit, in quotes; without quotes if it has no unit.
pub fn quantity(number: impl AsRef<str>, unit: &str) -> String {
    match unit {
        "" => number.as_ref().to_owned(),
        unit => quoted(&format!("{} {unit}", number.as_ref())),
    }
}

/// Writes an array on one line.
pub fn list(entries: impl IntoIterator<Item = impl Into<String>>) -> String {
    let entries: Vec<String> = entries.into_iter().map(Into::into).collect();
    format!("[{}]", entries.join(", "))
}

/// Writes an array with a line for each entry.
pub fn lines(entries: impl IntoIterator<Item = String>) -> String {
    format!("[\n{}]", entries.into_iter().map(|entry| format!("  {entry},\n")).collect::<String>())
}

/// Returns a name that is not taken: `name` itself, or `numbered` with a number from 2.
pub fn free_name(name: &str, numbered: impl Fn(usize) -> String, is_taken: impl Fn(&str) -> bool) -> String {
    let names = std::iter::once(name.to_owned()).chain((2..).map(numbered));
    names.into_iter().find(|name| !is_taken(name)).unwrap_or_default()
}
