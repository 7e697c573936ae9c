//! Prints procedures: what is the same in every language.
//!
//! A language implements [`Printer`]: its assignments, loops, branches and calls.

use super::expression::{Binding, Expression, infix};
use super::layout::Writer;
use crate::procedure::{
    Binary, Condition, Counter, Index, Kind, Procedure, Statement, Unary, Value, Variable, Whole,
};
use crate::program::{Array, Role, Routines};

/// A function of real numbers that a language spells in its own way.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Called {
    Absolute,
    Root,
    Arctangent,
    Clamped,
}

/// A language. Expressions have no branches.
pub(super) trait Printer {
    /// `if (`, `) {` and `}`.
    const BRANCH: [&'static str; 3];
    /// The end of a loop.
    const LOOP_END: &'static str = "}";
    /// `false` if comparisons with NaN are right by `>` and `>=` only.
    const HAS_LESS: bool = true;
    /// The statement that ends a loop before its time.
    const LEAVE: &'static str = "break;";

    fn writer(&mut self) -> &mut Writer;

    /// Returns a number as an operand.
    fn number(&self, value: f64) -> Expression;

    /// Returns the name of a function.
    fn function(&self, called: Called) -> String;

    /// Returns the operators "and", "or" and "is".
    fn operators(&self) -> [&'static str; 3] {
        ["&&", "||", "=="]
    }

    /// Returns an element of an array.
    fn element(&self, array: &str, index: &Index) -> String {
        format!("{array}[{index}]")
    }

    /// Returns a variable as a condition.
    fn flag(&self, name: &str) -> String {
        name.to_owned()
    }

    /// Returns a truth value.
    fn truth(&self, value: bool) -> String {
        value.to_string()
    }

    /// Returns a status.
    fn status(&self, status: abbe_core::compensator::Status) -> String {
        status.code().to_string()
    }

    /// Returns a sum of products over a range; languages without sums of arrays have loops instead.
    fn dot(&self, _: Counter, _: &[Index; 2], _: &[(&'static str, Index); 2]) -> Expression {
        unreachable!("sums have been replaced by loops")
    }

    /// Prints a comment on one or more lines.
    fn comment(&mut self, text: &str);

    /// Prints an assignment. `sum` is the other term if the value is the place plus a term.
    fn assign(&mut self, place: &str, value: &str, sum: Option<&str>);

    /// Prints a copy of an array.
    fn copy(&mut self, to: &str, from: &str, len: usize);

    /// Returns the head of a loop over a range.
    fn loop_head(&self, counter: &str, range: &[Index; 2], is_descending: bool) -> String;

    /// Prints statements that are executed if a condition holds.
    fn branch(&mut self, condition: &Condition, body: &[Statement]) {
        let [begin, then, end] = Self::BRANCH;
        let head = format!("{begin}{}{then}", self.condition(condition));
        self.writer().begin(&head);
        self.statements(body);
        self.writer().close(end);
    }

    /// Prints the end of a loop if a condition holds.
    fn leave(&mut self, condition: &Condition) {
        let [begin, then, end] = Self::BRANCH;
        let head = format!("{begin}{}{then}", self.condition(condition));
        self.writer().begin(&head);
        self.writer().lines(Self::LEAVE);
        self.writer().close(end);
    }

    /// Prints the call of a procedure.
    fn call(&mut self, procedure: &'static str, arguments: &[&'static str], result: &Variable);

    /// Prints the call of a generated function, which ends the procedure where it has no value.
    fn evaluate(&mut self, function: &'static str, q: &'static str, results: &[&'static str]);

    fn statements(&mut self, list: &[Statement]) {
        list.iter().for_each(|statement| self.statement(statement));
    }

    fn statement(&mut self, statement: &Statement) {
        match statement {
            Statement::Comment(text) => self.comment(text),
            Statement::Set(place, value) => {
                let sum = match value {
                    Value::Binary(Binary::Add, terms) if terms[0] == *place => {
                        Some(self.value(&terms[1]).text)
                    }
                    _ => None,
                };
                let (place, value) = (self.value(place).text, self.value(value).text);
                self.assign(&place, &value, sum.as_deref());
            }
            Statement::SetFlag(name, value) => {
                let value = self.truth(*value);
                self.assign(name, &value, None);
            }
            Statement::SetWhole(name, value) => {
                let value = match value {
                    Whole::Number(number) => number.to_string(),
                    Whole::Counter(counter) => counter.name().to_owned(),
                    Whole::Status(status) => self.status(*status),
                };
                self.assign(name, &value, None);
            }
            Statement::Copy { to, from, len } => self.copy(to, from, *len),
            Statement::For { counter, range, is_descending, body } => {
                let head = self.loop_head(counter.name(), range, *is_descending);
                self.writer().begin(&head);
                self.statements(body);
                self.writer().end();
                if !Self::LOOP_END.is_empty() {
                    self.writer().lines(Self::LOOP_END);
                }
            }
            Statement::If { condition, body } => self.branch(condition, body),
            Statement::Leave(condition) => self.leave(condition),
            Statement::Call { procedure, arguments, result } => self.call(procedure, arguments, result),
            Statement::Evaluate { function, q, results } => self.evaluate(function, q, results),
        }
    }

    fn value(&self, value: &Value) -> Expression {
        let called = |called, operands: &[Value]| {
            let operands: Vec<Expression> = operands.iter().map(|operand| self.value(operand)).collect();
            Expression::call(&self.function(called), &operands)
        };
        match value {
            Value::Number(value) => self.number(*value),
            Value::Name(name) => Expression::name((*name).to_owned()),
            Value::Element(array, index) => Expression::name(self.element(array, index)),
            Value::Unary(Unary::Negative, operand) => {
                // `-` binds less than `*` in some languages.
                let text = format!("-{}", self.value(operand).at_least(Binding::Atom));
                Expression::new(text, Binding::Choice)
            }
            Value::Unary(Unary::Absolute, operand) => called(Called::Absolute, std::slice::from_ref(operand)),
            Value::Unary(Unary::Root, operand) => called(Called::Root, std::slice::from_ref(operand)),
            Value::Binary(Binary::Arctangent, operands) => called(Called::Arctangent, &operands[..]),
            Value::Binary(operator, operands) => {
                let [a, b] = operands.each_ref().map(|operand| self.value(operand));
                let sign = match operator {
                    Binary::Add => "+",
                    Binary::Sub => "-",
                    Binary::Mul => "*",
                    _ => "/",
                };
                infix(&a, sign, &b)
            }
            Value::Clamped(operands) => called(Called::Clamped, &operands[..]),
            Value::Dot { counter, range, factors } => self.dot(*counter, range, factors),
        }
    }

    /// Returns a comparison; numbers stand on the right, except where `<` is not to be used.
    fn compared(&self, a: &Value, [sign, other]: [&str; 2], b: &Value) -> String {
        let is_turned = Self::HAS_LESS && matches!(a, Value::Number(_));
        let [a, b] = [a, b].map(|value| self.value(value).text);
        if is_turned { format!("{b} {other} {a}") } else { format!("{a} {sign} {b}") }
    }

    fn condition(&self, condition: &Condition) -> String {
        let [and, or, is] = self.operators();
        // Every operand of `and` and `or` has parentheses, as MISRA wants.
        let operand = |condition: &Condition| match condition {
            Condition::Flag(name) => self.flag(name),
            other => format!("({})", self.condition(other)),
        };
        let both = |sign: &str, [a, b]: &[Condition; 2]| format!("{} {sign} {}", operand(a), operand(b));
        match condition {
            Condition::Greater(a, b) => self.compared(a, [">", "<"], b),
            Condition::AtLeast(a, b) => self.compared(a, [">=", "<="], b),
            Condition::Is(name, counter) => format!("{name} {is} {}", counter.name()),
            Condition::Flag(name) => self.flag(name),
            Condition::And(operands) => both(and, operands),
            Condition::Or(operands) => both(or, operands),
        }
    }
}

/// Returns the arguments of a generated function that is called at joint variables `q`, and its
/// results with the variables that take them: without empty arrays if `skips_empty`.
pub(super) fn evaluated<'a>(
    routines: &'a Routines,
    function: &str,
    q: &'static str,
    results: &'a [&'static str],
    skips_empty: bool,
) -> (Vec<&'static str>, Vec<(&'a Array, &'static str)>) {
    let arrays = routines.named(function).arrays.iter();
    let arrays = arrays.filter(|array| !(skips_empty && array.is_empty(&routines.description)));
    let of_role = |role| arrays.clone().filter(move |array| array.role == role);
    let given = of_role(Role::Argument).map(|array| if array.name == "q" { q } else { array.name });
    (given.collect(), of_role(Role::Result).zip(results.iter().copied()).collect())
}

/// Returns the arrays of some variables, with their sizes.
pub(super) fn arrays(variables: &[Variable]) -> impl Iterator<Item = (&'static str, usize)> {
    variables.iter().filter_map(|Variable { name, kind }| match kind {
        Kind::Array(len) => Some((*name, *len)),
        _ => None,
    })
}

/// Splits the procedures of the corrected command into those that it calls, and itself.
pub(super) fn split(mut procedures: Vec<Procedure>) -> (Vec<Procedure>, Procedure) {
    let last = procedures.pop().expect("the corrected command is the last one");
    (procedures, last)
}
