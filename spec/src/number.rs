//! Formats numbers for people.

use abbe_core::{Class, LengthUnit, SumLimit, VariableKind};

use crate::expr::Symbol;
use crate::manipulator::{Spec, Variable};

/// Formats a number with a fixed number of decimals; zero as `0`, numbers from 1e7 in powers of
/// ten.
pub fn fixed(value: f64, decimals: usize) -> String {
    match value {
        0.0 => "0".to_owned(),
        f64::INFINITY => "∞".to_owned(),
        f64::NEG_INFINITY => "-∞".to_owned(),
        _ if value.abs() >= 1e7 => format!("{value:.3e}"),
        _ => {
            let text = format!("{value:.decimals$}");
            let nothing = text.chars().all(|c| matches!(c, '-' | '0' | '.'));
            if nothing { text.trim_start_matches('-').to_owned() } else { text }
        }
    }
}

/// Formats a magnitude with a fixed number of decimals, in powers of ten if these would show only
/// zeros, and below 1e-6 as `<1e-6`.
pub fn visible(value: f64, decimals: usize) -> String {
    let text = fixed(value, decimals);
    match text.parse() == Ok(0.0) {
        true if value >= 1e-6 => format!("{value:.1e}"),
        true if value > 0.0 => "<1e-6".to_owned(),
        _ => text,
    }
}

/// Formats a number to seven significant digits, without trailing zeros.
pub fn short(value: f64) -> String {
    if value.is_infinite() {
        return fixed(value, 0);
    }
    let value = format!("{value:.6e}").parse().unwrap_or(value);
    if value == 0.0 || (1e-5..1e7).contains(&f64::abs(value)) {
        format!("{}", value + 0.0)
    } else {
        format!("{value:e}")
    }
}

/// Rounds a number to 13 significant digits. The last bits, which depend on the order of
/// operations, then do not decide how a half is rounded.
pub fn steady(value: f64) -> f64 {
    format!("{value:.12e}").parse().unwrap_or(value)
}

/// Formats a number with its unit, if it has one.
pub fn quantity(value: f64, unit: &str) -> String {
    format!("{} {unit}", short(value)).trim_end().to_owned()
}

/// Formats a count with the singular or the plural: `1 row`, `3 rows`.
pub fn counted(count: usize, one: &str, more: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { more })
}

/// Returns the number of decimals of an error in a table: tenths of a micrometre.
pub fn error_decimals(length: LengthUnit) -> usize {
    match length {
        LengthUnit::Metre => 7,
        LengthUnit::Millimetre => 4,
    }
}

/// Formats a length for a sentence: to tenths of a micrometre, without trailing zeros.
pub fn length(value: f64, unit: LengthUnit) -> String {
    let text = trimmed(value, error_decimals(unit));
    format!("{text} {}", unit.symbol())
}

/// Formats the value of a variable: in degrees, or as a length.
pub fn of_variable(value: f64, kind: VariableKind, unit: LengthUnit) -> String {
    match kind {
        VariableKind::Revolute => format!("{}°", trimmed(value.to_degrees(), 4)),
        VariableKind::Prismatic => length(value, unit),
    }
}

/// Formats a sum of joints that is beyond its limits, such as `x1 - x2 = 1 mm, which must be 0 mm`.
pub fn beyond_sum_limit(limit: &SumLimit, value: f64, unit: LengthUnit) -> String {
    let [lower, upper] = limit.range;
    let [value, least, largest] = [value, lower, upper].map(|value| of_variable(value, limit.kind, unit));
    match lower == upper {
        true => format!("{} = {value}, which must be {least}", limit.sum),
        false => format!("{} = {value}, outside its limits {least} … {largest}", limit.sum),
    }
}

/// Formats the value of a variable, parameter or input with its unit.
pub fn of_symbol(value: f64, symbol: Symbol, spec: &Spec) -> String {
    match symbol {
        Symbol::Variable(i) => of_variable(value, spec.variables[i].kind, spec.length),
        Symbol::Passive(i) => of_variable(value, spec.passive[i].kind, spec.length),
        Symbol::Parameter(i) => quantity(value, &spec.parameters[i].unit),
        Symbol::Input(i) => quantity(value, &spec.inputs[i].unit),
        _ => short(value),
    }
}

/// Formats the values of all variables: `d1 = 1128 mm, q4 = 0°`.
pub fn variables(q: &[f64], spec: &Spec) -> String {
    let values = spec.variables.iter().zip(q).map(|(variable, value)| variable_is(variable, *value, spec));
    let all = values.collect::<Vec<_>>();
    if all.is_empty() { "no joints".to_owned() } else { all.join(", ") }
}

/// Formats a variable with its value: `d1 = 1128 mm`.
pub fn variable_is(variable: &Variable, value: f64, spec: &Spec) -> String {
    format!("{} = {}", variable.name, of_variable(value, variable.kind, spec.length))
}

/// Returns the name of a class, and of its distribution if it has one.
pub fn class(class: Class) -> (&'static str, Option<&'static str>) {
    match class {
        Class::Repeatable => ("repeatable", None),
        Class::Tolerance(distribution) => ("tolerance", Some(distribution.name())),
        Class::Random(distribution) => ("random", Some(distribution.name())),
    }
}

/// Formats a number to `digits` significant digits.
pub fn digits(value: f64, digits: usize) -> String {
    let decimals = digits.saturating_sub(1);
    short(format!("{value:.decimals$e}").parse().unwrap_or(value))
}

/// Returns the number of decimals that show `digits` significant digits of a number that is not
/// negative; at most 12.
pub fn decimals(value: f64, digits: usize) -> usize {
    let first = if value > 0.0 { value.log10().floor() } else { 0.0 };
    (digits as f64 - 1.0 - first).clamp(0.0, 12.0) as usize
}

/// Formats a number with `decimals` decimals, rounded up.
pub fn rounded_up(value: f64, decimals: usize) -> String {
    let step = 0.1_f64.powi(decimals as i32);
    let nearest = fixed(value, decimals);
    let is_less = nearest.parse::<f64>().is_ok_and(|nearest| nearest < value);
    if is_less { fixed(value + step, decimals) } else { nearest }
}

/// Formats a number with `decimals` decimals, rounded down.
pub fn rounded_down(value: f64, decimals: usize) -> String {
    let step = 0.1_f64.powi(decimals as i32);
    let nearest = fixed(value, decimals);
    let is_more = nearest.parse::<f64>().is_ok_and(|nearest| nearest > value);
    if is_more { fixed(value - step, decimals) } else { nearest }
}

/// Formats the ratio of two numbers in whole percent. 0 is 0 % of anything.
pub fn percent(value: f64, of: f64) -> String {
    let percent = if value == 0.0 { 0.0 } else { 100.0 * value / of };
    format!("{percent:.0} %")
}

/// Formats a probability in percent, rounded down: `99.19 %`.
pub fn at_least(probability: f64) -> String {
    format!("{} %", trimmed((1e4 * probability).floor() / 100.0, 2))
}

/// Formats a number with at most `decimals` decimals, without trailing zeros.
pub fn trimmed(value: f64, decimals: usize) -> String {
    let text = fixed(value, decimals);
    if !text.contains('.') || text.contains('e') {
        return text;
    }
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// No-break space, which is printed as a space.
pub const NO_BREAK: char = '\u{a0}';

/// Puts no-break spaces into the items of a list such as `d1 = 5 mm, q4 = 90°`, so that lines break
/// only after commas.
pub fn unbroken(list: &str) -> String {
    list.split(", ").map(|item| item.replace(' ', &NO_BREAK.to_string())).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests;
