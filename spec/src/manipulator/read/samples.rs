//! Sample configurations: fixed ones, so that checks are deterministic.

use super::declarations::Declarations;
use crate::expr::{Binary, Expression, Function, Kind, Symbol};
use crate::manipulator::Variable;

/// Number of sample configurations.
pub(super) const SAMPLES: usize = 16;

/// Values of all variables within their limits.
pub(super) struct Sample {
    q: Vec<f64>,
    p: Vec<f64>,
}

impl Sample {
    /// Returns sample configuration 1, 2, ….
    pub(super) fn new(declarations: &Declarations, sample: usize) -> Self {
        let all = declarations.variables.iter().chain(&declarations.passive).enumerate();
        let mut q: Vec<f64> = all.map(|(i, variable)| value(variable, i, sample)).collect();
        let p = q.split_off(declarations.variables.len());
        Self { q, p }
    }

    /// Returns the value of a variable; `None` for other symbols.
    pub(super) fn value(&self, symbol: Symbol) -> Option<f64> {
        match symbol {
            Symbol::Variable(i) => Some(self.q[i]),
            Symbol::Passive(i) => Some(self.p[i]),
            _ => None,
        }
    }
}

/// Returns `true` if the value of an expression depends on a variable. In `q - q` it occurs without
/// effect.
pub(super) fn depends(expression: &Expression, own: Symbol, declarations: &Declarations) -> bool {
    if !expression.symbols().any(|symbol| symbol == own) {
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
    let others = Sample::new(declarations, 1);
    let home = declarations.variable(own).map_or(0.0, |variable| variable.home);
    let mut values = (0..SAMPLES).map(|sample| {
        expression.value(&declarations.scope.tables, |symbol| match symbol {
            symbol if symbol == own => home + GOLDEN * sample as f64,
            Symbol::Parameter(i) => declarations.parameters[i].value,
            symbol => others.value(symbol).unwrap_or(f64::NAN),
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
