//! The ranges of joints and inputs on which the errors of an identified machine were fitted.

use crate::expr::Symbol;

/// A joint variable or an input, and the range on which errors were fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fitted {
    /// Which variable or input.
    pub symbol: Symbol,
    /// Lower and upper end.
    pub range: [f64; 2],
}

impl Fitted {
    /// Whether its value is outside the range by more than the last digit to which that is written.
    pub fn is_outside(&self, q: &[f64], u: &[f64]) -> bool {
        let value = match self.symbol {
            Symbol::Variable(i) => q.get(i),
            Symbol::Input(i) => u.get(i),
            _ => None,
        };
        value.is_some_and(|value| !self.contains(*value))
    }

    /// Whether a value is within the range, or beyond it by no more than its last written digit.
    pub fn contains(&self, value: f64) -> bool {
        let [lower, upper] = self.range;
        let digit = 1e-6 * lower.abs().max(upper.abs());
        (lower - digit..=upper + digit).contains(&value)
    }
}
