//! Operators, numbers and names of Matlab.

use std::borrow::Cow;

use abbe_spec::{Function, Lookup, Spec};

use crate::print::expression::Called;
use crate::print::{Binding, Expression, Identifiers, Syntax, arithmetic, function_of, literal};
use crate::program::Action;

/// The syntax of Matlab for a class, whose name precedes its members, and a spec, whose tables are
/// members.
pub(super) struct Matlab<'s> {
    pub(super) class: &'s str,
    pub(super) spec: &'s Spec,
}

/// Maximum length of a name, with a reserve for suffixes that make it unique.
const LONGEST: usize = 55;

/// Keywords of the language and names that the functions use; `i` and `j` are numbers.
pub(super) const WORDS: &str = "NaN Inf abs acos arguments asin atan atan2 break case catch classdef continue cos do else elseif end \
    end_try_catch end_unwind_protect endarguments endclassdef endenumeration endevents endfor endfunction endif endmethods \
    endparfor endproperties endspmd endswitch endwhile enumeration eps error events exp false for function get global i if \
    is_given isempty isnan isreal j k log methods nan numel only_real otherwise parfor persistent pi power properties reshape \
    return set side sign sin size spmd sqrt switch tan true try until unwind_protect unwind_protect_cleanup while zeros";

impl Syntax for Matlab<'_> {
    fn reserved(&self) -> Cow<'static, str> {
        Cow::Owned(format!("{WORDS} {}", self.class))
    }

    /// Names start with a letter and have a bounded length.
    fn identifiers(&self) -> Identifiers {
        Identifiers { spelled, ..Identifiers::default() }
    }

    fn number(&self, value: f64) -> Expression {
        Expression::number(number(value), value)
    }

    fn action(&self, action: Action, operands: &[Expression]) -> Expression {
        let call = |name: &str| Expression::call(name, operands);
        let own = |name: &str| call(&format!("{}.{name}", self.class));
        // Without a real value the result is NaN, as in all other languages, instead of a complex
        // number.
        let real = |name: &str| Expression::call(&format!("{}.only_real", self.class), &[call(name)]);
        arithmetic(action, operands).unwrap_or_else(|called| match called {
            Called::Power => real("power"),
            Called::Atan2 => call("atan2"),
            Called::Least => own("least"),
            Called::Greatest => own("greatest"),
            Called::Function(Function::Side) => own("side"),
            Called::Function(
                function @ (Function::Sqrt | Function::Asin | Function::Acos | Function::Log),
            ) => real(function.name()),
            Called::Function(function) => call(function.name()),
            Called::Lookup(Lookup { table, order }) => {
                let name = function_of(&spelled(&self.spec.tables[usize::from(table)].constant_name()));
                let text = format!("{}.{name}({order}, {})", self.class, operands[0].text);
                Expression::new(text, Binding::Atom)
            }
        })
    }
}

/// Converts a name of a spec to a name of the language.
pub(super) fn spelled(name: &str) -> String {
    let letters = name.trim_start_matches('_');
    let begun = if letters.len() == name.len() { String::new() } else { "x_".to_owned() };
    begun + &letters[..letters.len().min(LONGEST)]
}

/// Returns the shortest literal that represents the number exactly.
pub(super) fn number(value: f64) -> String {
    let digits = literal(value, ["NaN", "Inf"]);
    digits.strip_suffix(".0").unwrap_or(&digits).to_owned()
}
