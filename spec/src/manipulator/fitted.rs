//! Ranges of joints and inputs over which the errors of an identified machine were fitted.

use crate::expr::Symbol;

/// A joint variable or an input, and the range over which errors were fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fitted {
    /// The variable or input.
    pub symbol: Symbol,
    /// Lower and upper end.
    pub range: [f64; 2],
}

impl Fitted {
    /// Returns `true` if the value in `q` or `u` is outside the range.
    pub fn is_outside(&self, q: &[f64], u: &[f64]) -> bool {
        let value = match self.symbol {
            Symbol::Variable(i) => q.get(i),
            Symbol::Input(i) => u.get(i),
            _ => None,
        };
        value.is_some_and(|value| !self.contains(*value))
    }

    /// Returns `true` if a value is within the range, up to the rounding of written numbers.
    pub fn contains(&self, value: f64) -> bool {
        let [lower, upper] = self.range;
        let digit = 1e-6 * lower.abs().max(upper.abs());
        (lower - digit..=upper + digit).contains(&value)
    }
}
