//! Formats numbers for people: [`abbe_spec::number`], configurations, and named numbers.

use abbe::analysis::Configuration;
use abbe_spec::Spec;
pub use abbe_spec::number::*;
use serde::{Serialize, Serializer};

/// Formats the values that differ from a home configuration: `d1 = 38 mm, q4 = -90°, z = 1100 mm`.
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

/// Formats a value in its coherent unit with all digits, as options and specs read it.
pub fn exact_quantity(value: f64, unit: &str) -> String {
    match unit.strip_prefix('1') {
        _ if unit.is_empty() => format!("{value:?}"),
        // `1/K`: 0.5/K.
        Some(divisor) => format!("{value:?}{divisor}"),
        None => format!("{value:?} {unit}"),
    }
}

/// Formats joint variables in coherent units with all digits, as `--q` reads them.
pub fn exact_variables(q: &[f64], spec: &Spec) -> String {
    let unit = |variable: &abbe_spec::Variable| variable.kind.either("", spec.length.symbol());
    let values = spec.variables.iter().zip(q).map(|(variable, value)| exact_quantity(*value, unit(variable)));
    values.map(|value| value.replace(' ', "")).collect::<Vec<_>>().join(",")
}

/// Returns the factor and the symbol of the unit in which errors are shown. A spec in metres has
/// its errors shown in millimetres.
pub fn error_unit(length: &str) -> (f64, &str) {
    if length == "m" { (1e3, "mm") } else { (1.0, length) }
}

/// Named numbers; an object in JSON, in this order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Named(pub Vec<(String, f64)>);

impl Serialize for Named {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}
