//! Expressions as text, and the syntax of a language.
//!
//! Language-independent statements.

use std::borrow::Cow;

use abbe_spec::{Function, Lookup};

use super::Identifiers;
use crate::program::{Action, ArrayRows, Repeated, Row};

/// Precedence of the outermost operator of an expression.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
pub(super) enum Binding {
    Choice,
    Sum,
    Product,
    Sign,
    Atom,
}

/// An expression as text.
#[derive(Clone)]
pub(super) struct Expression {
    pub(super) text: String,
    pub(super) binding: Binding,
    /// `true` for a bare name.
    pub(super) is_name: bool,
}

/// Operators, numbers and reserved names of a language.
pub(super) trait Syntax {
    /// Returns names that the language or its functions use, separated by spaces.
    fn reserved(&self) -> Cow<'static, str>;
    /// Returns the rules for identifiers of the language.
    fn identifiers(&self) -> Identifiers {
        Identifiers::default()
    }
    /// Returns a number as an operand.
    fn number(&self, value: f64) -> Expression;
    /// Returns 0 or 1 as a result.
    fn zero_or_one(&self, value: f64) -> String {
        self.number(value).text
    }
    /// Returns an action on operands that are expressions already.
    fn action(&self, action: Action, operands: &[Expression]) -> Expression;
}

/// A result of a program.
pub(super) struct Value {
    pub(super) text: String,
    /// Number of statements after which the value is available.
    pub(super) ready: usize,
    /// `true` if the value is 0 in every configuration.
    pub(super) is_zero: bool,
}

impl Expression {
    pub(super) fn new(text: String, binding: Binding) -> Self {
        Self { text, binding, is_name: false }
    }

    /// Creates a number in the syntax of the language.
    pub(super) fn number(text: String, value: f64) -> Self {
        Self::new(text, if value.is_sign_negative() { Binding::Sign } else { Binding::Atom })
    }

    /// Creates `name(first, second, …)`.
    pub(super) fn call(name: &str, operands: &[Self]) -> Self {
        let arguments: Vec<&str> = operands.iter().map(|operand| operand.text.as_str()).collect();
        Self::new(format!("{name}({})", arguments.join(", ")), Binding::Atom)
    }

    pub(super) fn name(text: String) -> Self {
        Self { text, binding: Binding::Atom, is_name: true }
    }

    /// Returns the text as an operand, in parentheses if the expression binds less than `binding`.
    pub(super) fn at_least(&self, binding: Binding) -> Cow<'_, str> {
        if self.binding >= binding {
            Cow::Borrowed(&self.text)
        } else {
            Cow::Owned(format!("({})", self.text))
        }
    }
}

/// Joins two operands by an operator. The right operand must bind more strongly, so that nothing is
/// reassociated.
pub(super) fn infix(a: &Expression, sign: &str, b: &Expression) -> Expression {
    let (own, right) = match sign {
        "+" | "-" => (Binding::Sum, Binding::Product),
        _ => (Binding::Product, Binding::Sign),
    };
    Expression::new(format!("{} {sign} {}", a.at_least(own), b.at_least(right)), own)
}

/// An action that is printed as a function call.
pub(super) enum Called {
    Power,
    Atan2,
    Least,
    Greatest,
    Function(Function),
    Lookup(Lookup),
}

/// Prints an action by infix operators for languages without fused multiply-add. Any other action
/// is returned as a call.
pub(super) fn arithmetic(action: Action, operands: &[Expression]) -> Result<Expression, Called> {
    let product = || infix(&operands[0], "*", &operands[1]);
    Ok(match action {
        // Two adjacent signs would be a decrement.
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

/// Returns the shortest literal that represents a number exactly, or the name of NaN or infinity.
pub(super) fn literal(value: f64, [nan, infinity]: [&str; 2]) -> String {
    match value {
        _ if value.is_nan() => nan.to_owned(),
        f64::INFINITY => infinity.to_owned(),
        f64::NEG_INFINITY => format!("-{infinity}"),
        _ => format!("{value:?}"),
    }
}

/// A statement. Arrays are indices in the routine's list of arrays.
pub(super) enum Statement {
    /// Binds names to the numbers of a place; unused ones have none.
    Unpack { names: Vec<Option<String>>, from: ArrayRows },
    /// A comment on the following statements.
    Comment(String),
    /// Binds a name to a value.
    Let { name: String, value: String },
    /// Binds names to sines and cosines of angles.
    SinCos(Vec<([String; 2], Expression)>),
    /// Declares a local array.
    Declare(usize),
    /// Fills an array with zeros.
    Clear(usize),
    /// Copies rows of an array to another one; a `fresh` array is declared with these values.
    Copy { from: ArrayRows, to: usize, fresh: bool },
    /// Assigns row `index` of a place; a `fresh` array is declared with these values.
    Assign { to: ArrayRows, index: usize, values: Vec<Value>, fresh: bool },
    /// Part of column `index` of `J_e`, for consumers that take columns one by one.
    Column { index: usize, part: &'static str, values: Vec<Value> },
    /// Calls another routine, which initializes the `fresh` arrays.
    Call { routine: &'static str, arrays: Vec<usize>, fresh: Vec<usize> },
    /// Computes entries of an array as sums of terms.
    Sums { sums: usize, terms: usize, entries: usize },
    /// Loops over rows.
    For { repeated: Repeated, body: Vec<Statement> },
    /// Returns the margin.
    Return(String),
}

impl Statement {
    /// Returns `true` if the statement reads or writes a row that the counter of its loop selects.
    pub(super) fn is_counted(&self) -> bool {
        let counted = |place: &ArrayRows| matches!(place.row, Row::Each { .. } | Row::Listed { .. });
        match self {
            Self::Unpack { from: place, .. } | Self::Assign { to: place, .. } => counted(place),
            _ => false,
        }
    }
}
