//! Expressions as text, and what a language says about them.

use std::borrow::Cow;

use abbe_spec::expr::{Function, Lookup};

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

    /// A number as the language writes it.
    pub(super) fn number(text: String, value: f64) -> Self {
        Self::new(text, if value.is_sign_negative() { Binding::Sign } else { Binding::Atom })
    }

    /// `name(first, second, …)`.
    pub(super) fn call(name: &str, operands: &[Self]) -> Self {
        let arguments: Vec<&str> = operands.iter().map(|operand| operand.text.as_str()).collect();
        Self::new(format!("{name}({})", arguments.join(", ")), Binding::Atom)
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

/// An action that is a function.
pub(super) enum Called {
    Power,
    Atan2,
    Least,
    Greatest,
    Function(Function),
    Lookup(Lookup),
}

/// What is written with signs between operands, in languages without operators of their own for sums of products; what is not,
/// is called.
pub(super) fn arithmetic(action: Action, operands: &[Expression]) -> Result<Expression, Called> {
    let product = || infix(&operands[0], "*", &operands[1]);
    Ok(match action {
        // No two signs next to each other: that would be a decrement.
        Action::Neg(_) => Expression::new(format!("-{}", operands[0].at_least(Binding::Atom)), Binding::Sign),
        Action::Add(..) => infix(&operands[0], "+", &operands[1]),
        Action::Sub(..) => infix(&operands[0], "-", &operands[1]),
        Action::Mul(..) => product(),
        Action::Div(..) => infix(&operands[0], "/", &operands[1]),
        Action::MulAdd(..) => infix(&product(), "+", &operands[2]),
        Action::MulSub(..) => infix(&product(), "-", &operands[2]),
        Action::NegMulAdd(..) => infix(&operands[2], "-", &product()),
        Action::Pow(..) => return Err(Called::Power),
        Action::Atan2(..) => return Err(Called::Atan2),
        Action::Min(..) => return Err(Called::Least),
        Action::Max(..) => return Err(Called::Greatest),
        Action::Call(function, _) => return Err(Called::Function(function)),
        Action::Lookup(lookup, _) => return Err(Called::Lookup(lookup)),
        // Pairs are statements of their own.
        Action::SinCos(_) => return Err(Called::Function(Function::Sin)),
    })
}
