//! Operators and numbers of a generic scalar `T`.

use std::borrow::Cow;
use std::sync::Arc;

use abbe_spec::expr::{Function, Lookup, Table};

use super::literal::number;
use crate::print::expression::{Binding, Expression, Syntax, infix};
use crate::program::{Action, Operand};

/// The syntax of Rust with the spec's tables.
pub(super) struct Rust<'s>(pub(super) &'s [Arc<Table>]);

impl Syntax for Rust<'_> {
    /// Constants of a module and names that patterns cannot bind.
    fn reserved(&self) -> Cow<'static, str> {
        Cow::Borrowed(
            "zero one FRAMES ERRORS VARIABLES PARAMETERS INPUTS EFFECTS DISTINCT SOURCES None Some Ok Err",
        )
    }

    fn number(&self, value: f64) -> Expression {
        Expression::new(format!("T::constant({})", number(value)), Binding::Atom)
    }

    fn zero_and_one(&self) -> [&'static str; 2] {
        ["zero", "one"]
    }

    fn action(&self, action: Action, operands: &[Expression]) -> Expression {
        let method = |name: &str, of: &Expression, arguments: &[&Expression]| {
            let arguments: Vec<&str> = arguments.iter().map(|argument| argument.text.as_str()).collect();
            let text = format!("{}.{name}({})", of.at_least(Binding::Atom), arguments.join(", "));
            Expression::new(text, Binding::Atom)
        };
        // Not `a.min(b)`: clippy asks for the receiver of every method call with one argument, and
        // follows all bindings behind it, in exponential time for a long chain of them.
        // A constant factor comes second.
        let fused = |name: &str, a: Operand| match (a, operands) {
            (Operand::Constant(_), [a, b, c]) => method(name, b, &[a, c]),
            _ => method(name, &operands[0], &[&operands[1], &operands[2]]),
        };
        match action {
            Action::Neg(_) => {
                Expression::new(format!("-{}", operands[0].at_least(Binding::Sign)), Binding::Sign)
            }
            Action::Add(..) => infix(&operands[0], "+", &operands[1]),
            Action::Sub(..) => infix(&operands[0], "-", &operands[1]),
            Action::Mul(..) => infix(&operands[0], "*", &operands[1]),
            Action::Div(..) => infix(&operands[0], "/", &operands[1]),
            Action::MulAdd(a, ..) => fused("mul_add", a),
            Action::MulSub(a, ..) => fused("mul_sub", a),
            Action::NegMulAdd(a, ..) => fused("neg_mul_add", a),
            Action::Pow(..) => Expression::call("T::powf", operands),
            Action::Atan2(..) => Expression::call("T::atan2", operands),
            Action::Min(..) => Expression::call("T::min", operands),
            Action::Max(..) => Expression::call("T::max", operands),
            Action::Call(Function::Log, _) => method("ln", &operands[0], &[]),
            Action::Call(function, _) => method(function.name(), &operands[0], &[]),
            Action::Lookup(Lookup { table, order }, _) => {
                let (name, x) = (self.0[usize::from(table)].constant_name(), &operands[0].text);
                let text = match order {
                    0 => format!("::abbe::LookupTable::value(&{name}, {x})"),
                    order => format!("{name}.derivative({order}, {x})"),
                };
                Expression::new(text, Binding::Atom)
            }
            Action::SinCos(_) => method("sin_cos", &operands[0], &[]),
        }
    }
}
