//! Sample configurations: fixed ones, so that checks are deterministic.

use super::declarations::Declarations;
use crate::expr::{Binary, Expression, Function, Kind, Symbol};
use crate::manipulator::Variable;

/// Number of sample configurations.
pub(super) const SAMPLES: usize = 16;

/// Returns sample configuration 1, 2, …: values of all variables within their limits.
pub(super) fn configuration(variables: &[Variable], sample: usize) -> Vec<f64> {
    variables.iter().enumerate().map(|(i, variable)| value(variable, i, sample)).collect()
}

/// Returns `true` if the value of an expression depends on a variable. In `q - q` it occurs without
/// effect.
pub(super) fn depends(expression: &Expression, own: usize, declarations: &Declarations) -> bool {
    if !expression.symbols().any(|symbol| symbol == Symbol::Variable(own)) {
        return false;
    }
    // Steps and kinks may lie between the samples.
    let smooth = expression.terms().iter().all(|term| {
        !matches!(
            term.kind,
            Kind::Lookup(..)
                | Kind::Binary(Binary::Min | Binary::Max, ..)
                | Kind::Call(Function::Abs | Function::Sign, _)
        )
    });
    let mut q = configuration(&declarations.variables, 1);
    let home = declarations.variables[own].home;
    let mut values = (0..SAMPLES).map(|sample| {
        q[own] = home + GOLDEN * sample as f64;
        expression.value(&declarations.scope.tables, |symbol| match symbol {
            Symbol::Variable(i) => q[i],
            Symbol::Parameter(i) => declarations.parameters[i].value,
            _ => f64::NAN,
        })
    });
    let first = values.next().unwrap_or(f64::NAN);
    !(smooth && values.all(|value| (value - first).abs() <= 1e-12 * first.abs()))
}

/// Fractional part of the golden ratio, whose multiples are evenly spread.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Returns a value within the limits, by a golden-ratio sequence that differs for each variable.
fn value(variable: &Variable, index: usize, sample: usize) -> f64 {
    let [lower, upper] = variable.limits.map(|limit| limit.clamp(-1e6, 1e6));
    let [lower, upper] =
        if upper - lower > 1e5 { [variable.home - 3.0, variable.home + 3.0] } else { [lower, upper] };
    let fraction = (GOLDEN * (sample + 7 * index) as f64).fract();
    lower + (upper - lower) * fraction
}
