//! Operators and numbers of Python.

use std::{borrow::Cow, sync::Arc};

use abbe_spec::{Function, Lookup, Table};

use crate::print::expression::Called;
use crate::print::{Binding, Expression, Syntax, arithmetic, function_of, literal};
use crate::program::Action;

/// The syntax of Python with the spec's tables.
pub(super) struct Python<'s>(pub(super) &'s [Arc<Table>]);

impl Syntax for Python<'_> {
    /// Keywords of the language and names that the functions use.
    fn reserved(&self) -> Cow<'static, str> {
        Cow::Borrowed(
            "False None True and as assert async await batch break case class continue def del elif else entry except factor finally for \
             from global i if import in is lambda match nonlocal not np or pass raise range return term try type while with yield",
        )
    }

    fn number(&self, value: f64) -> Expression {
        Expression::number(number(value), value)
    }

    fn action(&self, action: Action, operands: &[Expression]) -> Expression {
        let call = |name: &str| Expression::call(&format!("np.{name}"), operands);
        arithmetic(action, operands).unwrap_or_else(|called| match called {
            // Python's own power raises an error where NumPy returns NaN.
            Called::Power => call("float_power"),
            Called::Atan2 => call("arctan2"),
            Called::Least => call("minimum"),
            Called::Greatest => call("maximum"),
            Called::Function(Function::Side) => {
                Expression::new(format!("np.where({} >= 0, 1.0, -1.0)", operands[0].text), Binding::Atom)
            }
            Called::Function(Function::Asin) => call("arcsin"),
            Called::Function(Function::Acos) => call("arccos"),
            Called::Function(Function::Atan) => call("arctan"),
            Called::Function(function) => call(function.name()),
            Called::Lookup(Lookup { table, order }) => {
                let name = function_of(&self.0[usize::from(table)].constant_name());
                Expression::new(format!("_{name}(batch, {order}, {})", operands[0].text), Binding::Atom)
            }
        })
    }
}

/// Returns the shortest literal that represents the number exactly.
pub(super) fn number(value: f64) -> String {
    literal(value, ["np.nan", "np.inf"])
}
