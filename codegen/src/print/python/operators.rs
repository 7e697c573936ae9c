//! Operators and numbers.

use std::borrow::Cow;
use std::sync::Arc;

use crate::expr::{Function, Lookup, Table};
use crate::print::expression::{Binding, Expression, Syntax, infix};
use crate::program::Action;

/// With the spec's tables, which are constants.
pub(super) struct Python<'s>(pub(super) &'s [Arc<Table>]);

impl Syntax for Python<'_> {
    /// The words of the language, and what the functions use.
    fn reserved(&self) -> Cow<'static, str> {
        Cow::Borrowed(
            "False None True and as assert async await batch break case class continue def del elif else entry except factor finally for \
             from global i if import in is lambda match nonlocal not np or pass raise range return term try type while with yield",
        )
    }

    fn number(&self, value: f64) -> Expression {
        let binding = if value.is_sign_negative() { Binding::Sign } else { Binding::Atom };
        Expression::new(number(value), binding)
    }

    fn zero_and_one(&self) -> [&'static str; 2] {
        ["0.0", "1.0"]
    }

    fn action(&self, action: Action, operands: &[Expression]) -> Expression {
        let call = |name: &str| {
            let arguments: Vec<&str> = operands.iter().map(|operand| operand.text.as_str()).collect();
            Expression::new(format!("np.{name}({})", arguments.join(", ")), Binding::Atom)
        };
        let product = || infix(&operands[0], "*", &operands[1]);
        match action {
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
            // Of numbers alone Python's own would end where it cannot be computed.
            Action::Pow(..) => call("float_power"),
            Action::Atan2(..) => call("arctan2"),
            Action::Min(..) => call("minimum"),
            Action::Max(..) => call("maximum"),
            Action::Call(Function::Side, _) => {
                let text = format!("np.where({} >= 0, 1.0, -1.0)", operands[0].text);
                Expression::new(text, Binding::Atom)
            }
            Action::Call(Function::Asin, _) => call("arcsin"),
            Action::Call(Function::Acos, _) => call("arccos"),
            Action::Call(Function::Atan, _) => call("arctan"),
            Action::Call(function, _) => call(function.name()),
            Action::Lookup(Lookup { table, order }, _) => {
                let (name, x) = (self.0[usize::from(table)].constant_name(), &operands[0].text);
                Expression::new(format!("_look_up({name}, {order}, {x})"), Binding::Atom)
            }
            Action::SinCos(_) => call("sin"),
        }
    }
}

/// A number with the digits that give it back exactly.
pub(super) fn number(value: f64) -> String {
    if value.is_nan() {
        return "np.nan".to_owned();
    }
    if value.is_infinite() {
        return if value > 0.0 { "np.inf" } else { "-np.inf" }.to_owned();
    }
    format!("{value:?}")
}
