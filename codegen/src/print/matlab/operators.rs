//! Operators, numbers and names.

use std::borrow::Cow;

use crate::expr::{Function, Lookup};
use crate::print::expression::{Binding, Expression, Syntax, infix};
use crate::program::Action;
use crate::spec::Spec;

/// With the class's name, before what stands in it, and the spec, whose tables do.
pub(super) struct Matlab<'s> {
    pub(super) class: &'s str,
    pub(super) spec: &'s Spec,
}

/// The longest name, with room for what distinguishes it from others.
const LONGEST: usize = 55;

/// The words of the language, and what the functions use; `i` and `j` are numbers.
pub(super) const WORDS: &str = "NaN Inf abs acos arguments asin atan atan2 break case catch classdef continue cos do else elseif end \
    end_try_catch end_unwind_protect endarguments endclassdef endenumeration endevents endfor endfunction endif endmethods \
    endparfor endproperties endspmd endswitch endwhile enumeration eps error events exp false for function get global i if \
    is_given isempty isnan isreal j k log methods nan numel only_real otherwise parfor persistent pi power properties reshape \
    return set side sign sin size spmd sqrt switch tan true try until unwind_protect unwind_protect_cleanup while zeros";

impl Syntax for Matlab<'_> {
    fn reserved(&self) -> Cow<'static, str> {
        Cow::Owned(format!("{WORDS} {}", self.class))
    }

    /// Names begin with a letter, and are of a bounded length.
    fn spelled(&self) -> fn(&str) -> String {
        spelled
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
            Expression::new(format!("{name}({})", arguments.join(", ")), Binding::Atom)
        };
        let own = |name: &str| call(&format!("{}.{name}", self.class));
        // Where there is no real value it is NaN, as everywhere else, and no complex number.
        let real = |name: &str| {
            let inner = call(name).text;
            Expression::new(format!("{}.only_real({inner})", self.class), Binding::Atom)
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
            Action::Pow(..) => real("power"),
            Action::Atan2(..) => call("atan2"),
            Action::Min(..) => own("least"),
            Action::Max(..) => own("greatest"),
            Action::Call(Function::Side, _) => own("side"),
            Action::Call(Function::Sqrt | Function::Asin | Function::Acos | Function::Log, _) => {
                let Action::Call(function, _) = action else { unreachable!("it is a call") };
                real(function.name())
            }
            Action::Call(function, _) => call(function.name()),
            Action::Lookup(Lookup { table, order }, _) => {
                let name = self.spec.tables[usize::from(table)].constant_name();
                let (name, x) = (spelled(&name), &operands[0].text);
                let text = format!("{0}.look_up({0}.{name}, {order}, {x})", self.class);
                Expression::new(text, Binding::Atom)
            }
            Action::SinCos(_) => call("sin"),
        }
    }
}

/// A name of a spec as a name of the language.
pub(super) fn spelled(name: &str) -> String {
    let letters = name.trim_start_matches('_');
    let begun = if letters.len() == name.len() { String::new() } else { "x_".to_owned() };
    begun + &letters[..letters.len().min(LONGEST)]
}

/// A number with the digits that give it back exactly.
pub(super) fn number(value: f64) -> String {
    if value.is_nan() {
        return "NaN".to_owned();
    }
    if value.is_infinite() {
        return if value > 0.0 { "Inf" } else { "-Inf" }.to_owned();
    }
    let digits = format!("{value:?}");
    digits.strip_suffix(".0").unwrap_or(&digits).to_owned()
}
