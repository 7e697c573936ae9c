//! Prints procedures: what is the same in every language.
//!
//! A language implements [`Printer`]: its assignments, loops, branches and calls, by which
//! `routine` prints the statements of routines as well.
//!
//! Calls of the functions of a file.

use abbe_core::function::{COMMANDS, Signature};
use abbe_spec::Spec;

use super::{Binding, Expression, Results, Writer, expression::Value as Entry, filled, infix};
use crate::procedure::{
    Binary, Condition, Counter, Index, Kind, Precision, Procedure, Statement, Unary, Value, Variable, Whole,
    compensated,
};
use crate::program::{Array, Role, Routine, Routines};

/// A function of real numbers that a language spells in its own way.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Called {
    Absolute,
    Root,
    Arctangent,
    Clamped,
    Sine,
    Cosine,
}

/// A language. Expressions have no branches.
pub(super) trait Printer {
    /// Names of the functions, in the order of [`Called`].
    const FUNCTIONS: [&'static str; 6];
    /// `if (`, `) {` and `}`.
    const BRANCH: [&'static str; 3];
    /// The end of a loop.
    const LOOP_END: &'static str = "}";
    /// `false` if compilers skip a loop from a number to itself.
    const LOOPS_ONCE: bool = true;
    /// `false` if comparisons with NaN are right by `>` and `>=` only.
    const HAS_LESS: bool = true;
    /// The statement that ends a loop before its time.
    const LEAVE: &'static str = "break;";
    /// The sign of negations.
    const NOT: &'static str = "!";
    /// The operators "and", "or" and "is".
    const OPERATORS: [&'static str; 3] = ["&&", "||", "=="];
    /// The truth values.
    const TRUTH: [&'static str; 2] = ["false", "true"];
    /// The sign of assignments, and the end of a statement.
    const ASSIGN: [&'static str; 2] = ["=", ";"];
    /// `true` if the language has `+=`.
    const ADDS_IN_PLACE: bool = false;
    /// `true` if arrays without elements are no arguments.
    const SKIPS_EMPTY: bool = false;
    /// `true` if many configurations are computed together: those that do not take a branch keep
    /// what it assigns, which has to have a value before.
    const IS_MASKED: bool = false;
    /// Memory of the results of functions.
    const RESULTS: Results = Results::Created;

    fn writer(&mut self) -> &mut Writer;

    /// Returns a number as an operand.
    fn number(&self, value: f64) -> Expression;

    /// Returns the name of a function.
    fn function(&self, called: Called) -> String {
        Self::FUNCTIONS[called as usize].to_owned()
    }

    /// Returns the negation of a condition.
    fn negated(&self, condition: &str) -> String {
        format!("{}({condition})", Self::NOT)
    }

    /// Returns an element of an array.
    fn at(&self, array: &str, index: &str) -> String {
        format!("{array}[{index}]")
    }

    /// Returns the name of a table of the file.
    fn constant(&self, name: &str) -> String {
        name.to_owned()
    }

    /// Returns the name of an array of a routine.
    fn array(&self, _: &Routine, name: &'static str) -> String {
        name.to_owned()
    }

    /// Returns an element of an array as the value of a name.
    fn read(&self, place: String, _: Role) -> String {
        place
    }

    /// Returns a variable as a condition.
    fn flag(&self, name: &str) -> String {
        name.to_owned()
    }

    /// Returns a status.
    fn status(&self, status: abbe_core::compensator::Status) -> String {
        status.code().to_string()
    }

    /// Returns a whole number as a real one.
    fn real(&self, whole: &Index) -> Expression {
        let text = whole.to_string();
        let binding = if text.contains(' ') { Binding::Choice } else { Binding::Atom };
        Expression::new(text, binding)
    }

    /// Returns the nearest whole number: adding 1.5 · 2⁵² rounds.
    fn nearest(&self, value: &Expression) -> String {
        let round = self.number(6_755_399_441_055_744.0);
        infix(&infix(value, "+", &round), "-", &round).text
    }

    /// Returns a sum of products over a range; languages without sums of arrays have loops instead.
    fn dot(&self, _: Counter, _: &[Index; 2], _: &[(&'static str, Index); 2]) -> Expression {
        unreachable!("sums have been replaced by loops")
    }

    /// Prints a comment on one or more lines.
    fn comment(&mut self, text: &str);

    /// Prints an assignment. `sum` is the other term if the value is the place plus a term.
    fn assign(&mut self, place: &str, value: &str, sum: Option<&str>) {
        let [sign, end] = Self::ASSIGN;
        self.writer().lines(&match sum.filter(|_| Self::ADDS_IN_PLACE) {
            Some(sum) => format!("{place} += {sum}{end}"),
            None => format!("{place} {sign} {value}{end}"),
        });
    }

    /// Prints assignments of entries.
    fn assign_all(&mut self, entries: &[(String, &Entry)]) {
        let sign = Self::ASSIGN[0];
        let entries = entries.iter().map(|(place, value)| format!("{place} {sign} {}", value.text));
        filled(self.writer(), "", &entries.collect::<Vec<_>>(), "; ");
    }

    /// Binds names to values.
    fn bind(&mut self, bindings: &[(String, String)]) {
        bindings.iter().for_each(|(name, value)| self.assign(name, value, None));
    }

    /// Binds names to sines and cosines.
    fn sines(&mut self, pairs: &[([String; 2], Expression)]) {
        for ([sine, cosine], angle) in pairs {
            let [s, c] = [Called::Sine, Called::Cosine]
                .map(|called| Expression::call(&self.function(called), std::slice::from_ref(angle)).text);
            self.bind(&[(sine.clone(), s), (cosine.clone(), c)]);
        }
    }

    /// Declares a local array of zeros.
    fn zeros(&mut self, name: &str, len: usize) {
        self.clear(name, len);
    }

    /// Declares a local array without values, where the language has such declarations.
    fn declare(&mut self, _name: &str, _len: usize) {}

    /// Fills an array with zeros.
    fn clear(&mut self, name: &str, len: usize) {
        let (place, zero) = (self.at(name, "k"), self.number(0.0).text);
        self.repeat("k", &[0.into(), len.into()], false, |printer| printer.assign(&place, &zero, None));
    }

    /// Declares a local array with values, given as its entries.
    fn create(&mut self, name: &str, entries: &[(String, &Entry)]) {
        self.zeros(name, entries.len());
        self.assign_all(&entries.iter().filter(|(_, value)| !value.is_zero).cloned().collect::<Vec<_>>());
    }

    /// Prints a copy of an array.
    fn copy(&mut self, to: &str, from: &str, len: usize) {
        self.copy_rows(to, from, [0, len], len, false);
    }

    /// Prints a copy of a range of an array that has `len` elements; a `fresh` array is declared.
    fn copy_rows(&mut self, to: &str, from: &str, [first, behind]: [usize; 2], _len: usize, fresh: bool) {
        if fresh {
            self.declare(to, behind - first);
        }
        let at = if first == 0 { "k".to_owned() } else { format!("k + {first}") };
        let [to, from] = [self.at(to, "k"), self.at(from, &at)];
        let range = [0.into(), (behind - first).into()];
        self.repeat("k", &range, false, |printer| printer.assign(&to, &from, None));
    }

    /// Returns the head of a loop over a range.
    fn loop_head(&self, counter: &str, range: &[Index; 2], is_descending: bool) -> String;

    /// Prints the head of a procedure that another one calls.
    fn head(&mut self, procedure: &Procedure, name: &str);

    /// Prints the end of a procedure that another one calls.
    fn tail(&mut self, procedure: &Procedure);

    /// Prints a procedure that another one calls. `list` has its constants, if given.
    fn helper(&mut self, procedure: &Procedure, name: &str, list: Option<&str>) {
        self.head(procedure, name);
        self.declarations(procedure, list);
        self.statements(&procedure.body);
        self.tail(procedure);
    }

    /// Prints the declaration of constants that a list of the file has.
    fn unpack(&mut self, _names: &str, _list: &str) {}

    /// Prints the declaration of an array of constants.
    fn numbers(&mut self, _name: &str, _values: &[String]) {}

    /// Prints constants, which `list` has if given, and arrays that are filled element by element.
    fn declarations(&mut self, procedure: &Procedure, list: Option<&str>) {
        self.constants(procedure, list);
        for Variable { name, kind } in procedure.results.iter().chain(&procedure.locals) {
            match kind {
                Kind::Array(len) if Self::IS_MASKED || procedure.begins_by_elements(name) => {
                    self.zeros(name, *len);
                }
                Kind::Real | Kind::Whole if Self::IS_MASKED => self.assign(name, "0", None),
                _ => {}
            }
        }
    }

    /// Prints the constants of a procedure.
    fn constants(&mut self, procedure: &Procedure, list: Option<&str>) {
        if let Some(list) = list {
            let names: Vec<&str> = procedure.constants.iter().map(|(name, _)| *name).collect();
            return self.unpack(&names.join(", "), list);
        }
        for (name, values) in &procedure.constants {
            let entries: Vec<String> = values.iter().map(|value| self.number(*value).text).collect();
            self.numbers(name, &entries);
        }
    }

    /// Prints statements that are executed if a condition holds.
    fn branch(&mut self, condition: &Condition, body: &[Statement]) {
        let [begin, then, end] = Self::BRANCH;
        let head = format!("{begin}{}{then}", self.condition(condition));
        self.writer().begin(&head);
        self.statements(body);
        self.writer().close(end);
    }

    /// Prints lines that are executed if a condition holds.
    fn guard(&mut self, condition: &str, lines: &str) {
        let [begin, then, end] = Self::BRANCH;
        self.writer().begin(&format!("{begin}{condition}{then}"));
        self.writer().lines(lines);
        self.writer().close(end);
    }

    /// Prints the call of a procedure.
    fn call(&mut self, procedure: &'static str, arguments: &[&'static str], result: &Variable);

    /// Prints the call of a generated function, which ends the caller where it has no value.
    fn invoke(&mut self, call: &Invocation);

    /// Returns the routines of the file.
    fn routines(&self) -> &Routines;

    /// Prints a loop over a range.
    fn repeat(
        &mut self,
        counter: &str,
        range: &[Index; 2],
        is_descending: bool,
        body: impl FnOnce(&mut Self),
    ) {
        if let [Some(first), Some(behind)] = range.each_ref().map(Index::number)
            && behind == first + 1
            && !Self::LOOPS_ONCE
        {
            self.assign(counter, &first.to_string(), None);
            return body(self);
        }
        let head = self.loop_head(counter, range, is_descending);
        self.writer().begin(&head);
        body(self);
        self.writer().close(Self::LOOP_END);
    }

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
                self.assign(name, Self::TRUTH[usize::from(*value)], None);
            }
            Statement::SetWhole(name, value) => {
                let value = match value {
                    Whole::Index(index) => index.to_string(),
                    Whole::Nearest(value) => self.nearest(&self.value(value)),
                    Whole::Status(status) => self.status(*status),
                };
                self.assign(name, &value, None);
            }
            Statement::Copy { to, from, len } => self.copy(to, from, *len),
            Statement::For { counter, range, is_descending, body } => {
                let print = |printer: &mut Self| printer.statements(body);
                self.repeat(counter.name(), range, *is_descending, print);
            }
            Statement::If { condition, body } => self.branch(condition, body),
            Statement::Leave(condition) => {
                let condition = self.condition(condition);
                self.guard(&condition, Self::LEAVE);
            }
            Statement::Call { procedure, arguments, result } => self.call(procedure, arguments, result),
            Statement::Evaluate { function, q, results } => {
                let call = evaluated(self.routines(), function, q, results, Self::SKIPS_EMPTY);
                self.invoke(&call);
            }
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
            Value::Whole(index) => self.real(index),
            Value::Element(array, index) => Expression::name(self.at(array, &index.to_string())),
            Value::Unary(Unary::Negative, operand) => {
                // `-` binds less than `*` in some languages.
                Expression::new(format!("-{}", self.value(operand).at_least(Binding::Atom)), Binding::Choice)
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
        let [and, or, is] = Self::OPERATORS;
        // Every operand of `and` and `or` has parentheses, as MISRA wants.
        let operand = |condition: &Condition| match condition {
            Condition::Flag(name) => self.flag(name),
            other => format!("({})", self.condition(other)),
        };
        let both = |sign: &str, [a, b]: &[Condition; 2]| format!("{} {sign} {}", operand(a), operand(b));
        match condition {
            Condition::Greater(a, b) => self.compared(a, [">", "<"], b),
            Condition::AtLeast(a, b) => self.compared(a, [">=", "<="], b),
            Condition::Is(name, index) => format!("{name} {is} {index}"),
            Condition::Flag(name) => self.flag(name),
            Condition::And(operands) => both(and, operands),
            Condition::Or(operands) => both(or, operands),
        }
    }
}

/// Returns the arrays of some variables, with their sizes.
pub(super) fn arrays(variables: &[Variable]) -> impl Iterator<Item = (&'static str, usize)> {
    variables.iter().filter_map(|Variable { name, kind }| match kind {
        Kind::Array(len) => Some((*name, *len)),
        _ => None,
    })
}

/// Returns the procedures that corrected commands call, and the exported functions.
pub(super) fn commands(
    spec: &Spec,
    routines: &Routines,
    precision: Precision,
) -> (Vec<Procedure>, Vec<(&'static Signature, Procedure)>) {
    let mut helpers = compensated(spec, precision);
    let commands = helpers.split_off(helpers.len() - COMMANDS.len());
    let commands = COMMANDS.into_iter().zip(commands);
    (helpers, commands.filter(|(signature, _)| routines.exported.contains(&signature.name)).collect())
}

/// A call of a generated function, or of a helper of several functions.
pub(super) struct Invocation {
    pub(super) routine: &'static str,
    pub(super) is_function: bool,
    /// Names of the arguments: those of the routine, and those of the caller.
    pub(super) given: Vec<(&'static str, String)>,
    /// Names and sizes of the results, and the variables of the caller that take them.
    pub(super) filled: Vec<(&'static str, usize, String)>,
    /// `true` if variables of a procedure take the results.
    pub(super) in_procedure: bool,
}

/// Returns the call of a generated function at joint variables `q`: without empty arrays if
/// `skips_empty`.
pub(super) fn evaluated(
    Routines { description, list, .. }: &Routines,
    function: &'static str,
    q: &'static str,
    results: &[&'static str],
    skips_empty: bool,
) -> Invocation {
    let arrays = list.iter().filter(|routine| routine.name == function).flat_map(|routine| &routine.arrays);
    let arrays = arrays.filter(|array| !(skips_empty && array.is_empty(description)));
    let of_role = |role| arrays.clone().filter(move |array| array.role == role);
    let given = of_role(Role::Argument).map(|Array { name, .. }| {
        let own = if *name == "q" { q } else { name };
        (*name, own.to_owned())
    });
    let filled = of_role(Role::Result).zip(results);
    let filled = filled.map(|(array, own)| (array.name, array.len(description), str::to_owned(own)));
    let (given, filled) = (given.collect(), filled.collect());
    Invocation { routine: function, is_function: true, given, filled, in_procedure: true }
}
