//! Operators and numbers.

use std::borrow::Cow;
use std::sync::Arc;

use crate::expr::{Function, Lookup, Table};
use crate::print::expression::{Binding, Expression, Syntax, infix};
use crate::program::Action;

/// With the spec's tables, which are constants.
pub(super) struct JavaScript<'s>(pub(super) &'s [Arc<Table>]);

impl Syntax for JavaScript<'_> {
    /// The words of the language, and what the functions use.
    fn reserved(&self) -> Cow<'static, str> {
        Cow::Borrowed(
            "Float64Array Infinity Math NaN arguments async await break case catch class const continue \
         debugger default delete do else enum eval export extends false finally for function get i if \
         implements import in instanceof interface k let lookup margin new null of package private protected \
         public return set static super switch this throw true try typeof undefined var void while \
         with yield",
        )
    }

    fn number(&self, value: f64) -> Expression {
        let binding = if value.is_sign_negative() { Binding::Sign } else { Binding::Atom };
        Expression::new(number(value), binding)
    }

    fn zero_and_one(&self) -> [&'static str; 2] {
        ["0", "1"]
    }

    fn action(&self, action: Action, operands: &[Expression]) -> Expression {
        let call = |name: &str| {
            let arguments: Vec<&str> = operands.iter().map(|operand| operand.text.as_str()).collect();
            Expression::new(format!("Math.{name}({})", arguments.join(", ")), Binding::Atom)
        };
        let product = || infix(&operands[0], "*", &operands[1]);
        match action {
            // No two signs next to each other: that would be a decrement.
            Action::Neg(_) => {
                Expression::new(format!("-{}", operands[0].at_least(Binding::Atom)), Binding::Sign)
            }
            Action::Add(..) => infix(&operands[0], "+", &operands[1]),
            Action::Sub(..) => infix(&operands[0], "-", &operands[1]),
            Action::Mul(..) => product(),
            Action::Div(..) => infix(&operands[0], "/", &operands[1]),
            Action::MulAdd(..) => infix(&product(), "+", &operands[2]),
            Action::MulSub(..) => infix(&product(), "-", &operands[2]),
            Action::NegMulAdd(..) => infix(&operands[2], "-", &product()),
            Action::Pow(..) => call("pow"),
            Action::Atan2(..) => call("atan2"),
            Action::Min(..) => call("min"),
            Action::Max(..) => call("max"),
            // Where Math.sign(-0) is -0, this is 1.
            Action::Call(Function::Side, _) => {
                let text = format!("{} >= 0 ? 1 : -1", operands[0].at_least(Binding::Atom));
                Expression::new(text, Binding::Choice)
            }
            Action::Call(function, _) => call(function.name()),
            Action::Lookup(Lookup { table, order }, _) => {
                let (name, x) = (self.0[usize::from(table)].constant_name(), &operands[0].text);
                Expression::new(format!("lookup({name}, {order}, {x})"), Binding::Atom)
            }
            Action::SinCos(_) => call("sin"),
        }
    }
}

/// A number with the digits that give it back exactly.
pub(super) fn number(value: f64) -> String {
    if value.is_infinite() {
        return if value > 0.0 { "Infinity" } else { "-Infinity" }.to_owned();
    }
    let digits = format!("{value:?}");
    digits.strip_suffix(".0").unwrap_or(&digits).to_owned()
}
