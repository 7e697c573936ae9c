//! Operators and numbers of JavaScript.

use std::{borrow::Cow, sync::Arc};

use abbe_spec::{Function, Lookup, Table};

use crate::print::expression::Called;
use crate::print::{Binding, Expression, Syntax, arithmetic, function_of, literal};
use crate::program::Action;

/// The syntax of JavaScript with the spec's tables.
pub(super) struct JavaScript<'s>(pub(super) &'s [Arc<Table>]);

impl Syntax for JavaScript<'_> {
    /// Keywords of the language and names that the functions use.
    fn reserved(&self) -> Cow<'static, str> {
        Cow::Borrowed(
            "Float64Array Infinity Math NaN are_inputs arguments async await break case catch class const continue \
         debugger default delete do else enum eval export extends false finally for function get given i if \
         implements import in instanceof interface k let margin new null of package private protected \
         public return set static super switch this throw true try typeof undefined var void while \
         with yield",
        )
    }

    fn number(&self, value: f64) -> Expression {
        Expression::number(number(value), value)
    }

    fn action(&self, action: Action, operands: &[Expression]) -> Expression {
        let call = |name: &str| Expression::call(&format!("Math.{name}"), operands);
        arithmetic(action, operands).unwrap_or_else(|called| match called {
            Called::Power => call("pow"),
            Called::Atan2 => call("atan2"),
            Called::Least => call("min"),
            Called::Greatest => call("max"),
            // Returns 1 for −0, where Math.sign returns −0.
            Called::Function(Function::Side) => {
                let text = format!("{} >= 0 ? 1 : -1", operands[0].at_least(Binding::Atom));
                Expression::new(text, Binding::Choice)
            }
            Called::Function(function) => call(function.name()),
            Called::Lookup(Lookup { table, order }) => {
                let name = function_of(&self.0[usize::from(table)].constant_name());
                Expression::new(format!("{name}({order}, {})", operands[0].text), Binding::Atom)
            }
        })
    }
}

/// Returns the shortest literal that represents the number exactly.
pub(super) fn number(value: f64) -> String {
    let digits = literal(value, ["NaN", "Infinity"]);
    digits.strip_suffix(".0").unwrap_or(&digits).to_owned()
}
