//! Numbers as people read them.

use abbe::analysis::Configuration;
use abbe::{Class, LengthUnit, VariableKind};
use abbe_spec::Spec;
use abbe_spec::expr::Symbol;
use serde::{Serialize, Serializer};

/// A number with this many decimals, nothing plain 0; a large one in powers of ten.
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

/// A number to seven digits, without those that say nothing.
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

/// A number with its unit, if it has one.
pub fn quantity(value: f64, unit: &str) -> String {
    format!("{} {unit}", short(value)).trim_end().to_owned()
}

/// How many there are of something: `1 row`, `3 rows`.
pub fn counted(count: usize, one: &str, more: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { more })
}

/// How many decimals an error has in a table: tenths of a micrometre.
pub fn error_decimals(length: LengthUnit) -> usize {
    match length {
        LengthUnit::Metre => 7,
        LengthUnit::Millimetre => 4,
    }
}

/// A length in a sentence: tenths of a micrometre, without zeros at the end.
pub fn length(value: f64, unit: LengthUnit) -> String {
    let text = trimmed(value, error_decimals(unit));
    format!("{text} {}", unit.symbol())
}

/// The value of a variable: degrees, or a length.
pub fn of_variable(value: f64, kind: VariableKind, unit: LengthUnit) -> String {
    match kind {
        VariableKind::Revolute => format!("{}°", trimmed(value.to_degrees(), 4)),
        VariableKind::Prismatic => length(value, unit),
    }
}

/// The value of a variable, parameter or input, with its unit.
pub fn of_symbol(value: f64, symbol: Symbol, spec: &Spec) -> String {
    match symbol {
        Symbol::Variable(i) => of_variable(value, spec.variables[i].kind, spec.length),
        Symbol::Parameter(i) => quantity(value, &spec.parameters[i].unit),
        Symbol::Input(i) => quantity(value, &spec.inputs[i].unit),
        _ => short(value),
    }
}

/// The value of every variable: `d1 = 1128 mm, q4 = 0°`.
pub fn variables(q: &[f64], spec: &Spec) -> String {
    let values = spec.variables.iter().zip(q).map(|(variable, value)| variable_is(variable, *value, spec));
    let all = values.collect::<Vec<_>>();
    if all.is_empty() { "no joints".to_owned() } else { all.join(", ") }
}

/// What is not at home and not nominal: `d1 = 38 mm, q4 = -90°, z = 1100 mm`.
pub fn configuration(configuration: &Configuration, home: &Configuration, spec: &Spec) -> String {
    let variables = spec.variables.iter().zip(configuration.q.iter().zip(&home.q));
    let variables = variables.filter(|(_, (value, home))| value != home);
    let variables = variables.map(|(variable, (value, _))| variable_is(variable, *value, spec));
    let parameters = spec.parameters.iter().zip(configuration.s.iter().zip(&home.s));
    let parameters = parameters.filter(|(_, (value, home))| value != home);
    let parameters = parameters
        .map(|(parameter, (value, _))| format!("{} = {}", parameter.name, quantity(*value, &parameter.unit)));
    let inputs = spec.inputs.iter().zip(configuration.u.iter().zip(&home.u));
    let inputs = inputs.filter(|(_, (value, home))| value != home);
    let inputs =
        inputs.map(|(input, (value, _))| format!("{} = {}", input.name, quantity(*value, &input.unit)));
    let all = variables.chain(parameters).chain(inputs).collect::<Vec<_>>();
    if all.is_empty() { "home".to_owned() } else { all.join(", ") }
}

/// `d1 = 1128 mm`.
fn variable_is(variable: &abbe_spec::Variable, value: f64, spec: &Spec) -> String {
    format!("{} = {}", variable.name, of_variable(value, variable.kind, spec.length))
}

/// What a source is: `repeatable`, or `random` with its distribution.
pub fn class(class: Class) -> (&'static str, Option<&'static str>) {
    match class {
        Class::Repeatable => ("repeatable", None),
        Class::Random(distribution) => ("random", Some(distribution.name())),
    }
}

/// A number to so many digits.
pub fn digits(value: f64, digits: usize) -> String {
    let decimals = digits.saturating_sub(1);
    short(format!("{value:.decimals$e}").parse().unwrap_or(value))
}

/// How many decimals show so many digits of a number that is not negative; never more than 12.
pub fn decimals(value: f64, digits: usize) -> usize {
    let first = if value > 0.0 { value.log10().floor() } else { 0.0 };
    (digits as f64 - 1.0 - first).clamp(0.0, 12.0) as usize
}

/// A number with this many decimals that is not below it.
pub fn rounded_up(value: f64, decimals: usize) -> String {
    let step = 0.1_f64.powi(decimals as i32);
    let nearest = fixed(value, decimals);
    let is_less = nearest.parse::<f64>().is_ok_and(|nearest| nearest < value);
    if is_less { fixed(value + step, decimals) } else { nearest }
}

/// A number with this many decimals that is not above it.
pub fn rounded_down(value: f64, decimals: usize) -> String {
    let step = 0.1_f64.powi(decimals as i32);
    let nearest = fixed(value, decimals);
    let is_more = nearest.parse::<f64>().is_ok_and(|nearest| nearest > value);
    if is_more { fixed(value - step, decimals) } else { nearest }
}

/// A share in whole percent.
pub fn percent(value: f64, of: f64) -> String {
    format!("{:.0} %", 100.0 * value / of)
}

/// A probability in percent, rounded down: `99.19 %`.
pub fn at_least(probability: f64) -> String {
    format!("{} %", trimmed((1e4 * probability).floor() / 100.0, 2))
}

/// A number with at most this many decimals.
pub fn trimmed(value: f64, decimals: usize) -> String {
    let text = fixed(value, decimals);
    if !text.contains('.') || text.contains('e') {
        return text;
    }
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Named numbers, in JSON an object in this order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Named(pub Vec<(String, f64)>);

impl Serialize for Named {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

/// A space at which no line ends; it is printed as any other.
pub const NO_BREAK: char = '\u{a0}';

/// A list, `d1 = 5 mm, q4 = 90°`, whose lines end after commas only.
pub fn unbroken(list: &str) -> String {
    let items = list.split(", ").map(|item| item.replace(' ', &NO_BREAK.to_string()));
    items.collect::<Vec<_>>().join(", ")
}
