//! Operators and numbers of a generic scalar `T`.
//!
//! Number literals of Rust.

use std::{borrow::Cow, f64::consts, sync::Arc};

use abbe_spec::{Function, Lookup, Table};

use crate::print::{Binding, Expression, Syntax, infix};
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

    fn zero_or_one(&self, value: f64) -> String {
        if value == 0.0 { "zero" } else { "one" }.to_owned()
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

/// Constants with a name in Rust's standard library.
const NAMED: [(f64, &str); 10] = [
    (consts::PI, "PI"),
    (consts::TAU, "TAU"),
    (consts::FRAC_PI_2, "FRAC_PI_2"),
    (consts::FRAC_PI_3, "FRAC_PI_3"),
    (consts::FRAC_PI_4, "FRAC_PI_4"),
    (consts::FRAC_PI_6, "FRAC_PI_6"),
    (consts::FRAC_PI_8, "FRAC_PI_8"),
    (consts::SQRT_2, "SQRT_2"),
    (consts::FRAC_1_SQRT_2, "FRAC_1_SQRT_2"),
    (consts::E, "E"),
];

/// Returns a named constant, or the shortest literal that represents the number exactly.
pub(super) fn number(value: f64) -> String {
    if value.is_nan() {
        return "f64::NAN".to_owned();
    }
    if value.is_infinite() {
        return if value > 0.0 { "f64::INFINITY" } else { "f64::NEG_INFINITY" }.to_owned();
    }
    match NAMED.iter().find(|(named, _)| *named == value.abs()) {
        Some((_, name)) if value < 0.0 => format!("-::core::f64::consts::{name}"),
        Some((_, name)) => format!("::core::f64::consts::{name}"),
        None => format!("{value:?}"),
    }
}

/// Returns `true` if clippy would report the number as an approximate constant such as π or √2.
pub(super) fn looks_like_named(value: f64) -> bool {
    NAMED.iter().any(|(named, _)| {
        let difference = (value.abs() - named).abs() / named;
        difference > 0.0 && difference < 5e-3
    })
}
