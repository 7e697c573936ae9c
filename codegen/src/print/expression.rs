//! Expressions as text, and what a language says about them.

use std::borrow::Cow;

use crate::program::Action;

/// How strongly the outermost operator of an expression binds.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
pub(super) enum Binding {
    Choice,
    Sum,
    Product,
    Sign,
    Atom,
}

/// What a value is written as.
#[derive(Clone)]
pub(super) struct Expression {
    pub(super) text: String,
    pub(super) binding: Binding,
    /// Whether it is no more than a name.
    pub(super) is_name: bool,
}

/// The operators, numbers and reserved names of a language.
pub(super) trait Syntax {
    /// Names that it has itself, or that its functions use, with spaces between them.
    fn reserved(&self) -> Cow<'static, str>;
    /// How a name is written, where not every name of a spec can be one.
    fn spelled(&self) -> fn(&str) -> String {
        str::to_owned
    }
    /// A number as an operand.
    fn number(&self, value: f64) -> Expression;
    /// 0 and 1 as results.
    fn zero_and_one(&self) -> [&'static str; 2];
    /// An action on operands that are written already.
    fn action(&self, action: Action, operands: &[Expression]) -> Expression;
}

/// A result of a program.
pub(super) struct Value {
    pub(super) text: String,
    /// After how many statements it is known.
    pub(super) ready: usize,
    /// Whether it is zero in every configuration.
    pub(super) is_zero: bool,
}

impl Expression {
    pub(super) fn new(text: String, binding: Binding) -> Self {
        Self { text, binding, is_name: false }
    }

    pub(super) fn name(text: String) -> Self {
        Self { text, binding: Binding::Atom, is_name: true }
    }

    /// The expression as an operand of something that needs at least this binding.
    pub(super) fn at_least(&self, binding: Binding) -> Cow<'_, str> {
        if self.binding >= binding {
            Cow::Borrowed(&self.text)
        } else {
            Cow::Owned(format!("({})", self.text))
        }
    }
}

/// Two operands and a sign between them. The right one needs a stronger operator, so that nothing is reassociated.
pub(super) fn infix(a: &Expression, sign: &str, b: &Expression) -> Expression {
    let (own, right) = match sign {
        "+" | "-" => (Binding::Sum, Binding::Product),
        _ => (Binding::Product, Binding::Sign),
    };
    Expression::new(format!("{} {sign} {}", a.at_least(own), b.at_least(right)), own)
}
