//! Builder that descriptions of procedures are written with.

use super::{Condition, Counter, Index, Kind, Procedure, Statement, Value, Variable, Whole};

/// Statements that are being written.
#[derive(Debug)]
pub struct Body<'p> {
    procedure: &'p mut Procedure,
    statements: Vec<Statement>,
}

/// A real number with a name.
#[derive(Clone, Copy, Debug)]
pub(super) struct Real(&'static str);

/// An array.
#[derive(Clone, Copy, Debug)]
pub(super) struct Array {
    name: &'static str,
    len: usize,
}

/// A truth value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flag(&'static str);

impl Procedure {
    /// Describes a procedure.
    pub(super) fn new(
        name: &'static str,
        documentation: impl Into<String>,
        write: impl FnOnce(&mut Body<'_>),
    ) -> Self {
        let (arguments, results, constants, locals) = (vec![], vec![], vec![], vec![]);
        let documentation = documentation.into();
        let mut procedure = Self { name, documentation, arguments, results, constants, locals, body: vec![] };
        let mut body = Body { procedure: &mut procedure, statements: vec![] };
        write(&mut body);
        procedure.body = body.statements;
        procedure
    }
}

impl Body<'_> {
    /// Declares an argument.
    pub(super) fn argument(&mut self, name: &'static str, len: usize) -> Array {
        self.procedure.arguments.push(Variable { name, kind: Kind::Array(len) });
        Array { name, len }
    }

    /// Declares a number as argument.
    pub(super) fn argument_real(&mut self, name: &'static str) -> Real {
        self.procedure.arguments.push(Variable { name, kind: Kind::Real });
        Real(name)
    }

    /// Declares a whole number as argument.
    pub(super) fn argument_whole(&mut self, name: &'static str) -> Counter {
        self.procedure.arguments.push(Variable { name, kind: Kind::Whole });
        Counter(name)
    }

    /// Declares an array as result.
    pub(super) fn result(&mut self, name: &'static str, len: usize) -> Array {
        self.procedure.results.push(Variable { name, kind: Kind::Array(len) });
        Array { name, len }
    }

    /// Declares a number as result.
    pub(super) fn result_real(&mut self, name: &'static str) -> Real {
        self.procedure.results.push(Variable { name, kind: Kind::Real });
        Real(name)
    }

    /// Declares a whole number as result.
    pub(super) fn result_whole(&mut self, name: &'static str) -> Counter {
        self.procedure.results.push(Variable { name, kind: Kind::Whole });
        Counter(name)
    }

    /// Declares an array of fixed numbers.
    pub(super) fn constant(&mut self, name: &'static str, values: &[f64]) -> Array {
        self.procedure.constants.push((name, values.to_vec()));
        Array { name, len: values.len() }
    }

    /// Declares a local array.
    pub(super) fn array(&mut self, name: &'static str, len: usize) -> Array {
        self.local(name, Kind::Array(len));
        Array { name, len }
    }

    /// Declares a local number.
    pub(super) fn real(&mut self, name: &'static str) -> Real {
        self.local(name, Kind::Real);
        Real(name)
    }

    /// Declares a local truth value and assigns it.
    pub(super) fn flag(&mut self, name: &'static str, value: bool) -> Flag {
        self.local(name, Kind::Flag);
        self.set_flag(Flag(name), value);
        Flag(name)
    }

    /// Declares a local whole number.
    pub(super) fn whole(&mut self, name: &'static str) -> Counter {
        self.local(name, Kind::Whole);
        Counter(name)
    }

    fn local(&mut self, name: &'static str, kind: Kind) {
        let variable = Variable { name, kind };
        if !self.procedure.locals.contains(&variable) {
            self.procedure.locals.push(variable);
        }
    }

    /// Comments on the following statements.
    pub(super) fn comment(&mut self, text: &'static str) {
        self.statements.push(Statement::Comment(text));
    }

    /// Assigns a value.
    pub(super) fn set(&mut self, place: impl Into<Value>, value: impl Into<Value>) {
        self.statements.push(Statement::Set(place.into(), value.into()));
    }

    /// Assigns a truth value.
    pub(super) fn set_flag(&mut self, Flag(name): Flag, value: bool) {
        self.statements.push(Statement::SetFlag(name, value));
    }

    /// Assigns a whole number.
    pub(super) fn set_whole(&mut self, Counter(name): Counter, value: Whole) {
        self.statements.push(Statement::SetWhole(name, value));
    }

    /// Copies an array.
    pub(super) fn copy(&mut self, to: Array, from: Array) {
        assert_eq!(to.len, from.len, "{} and {} have the same size", to.name, from.name);
        self.statements.push(Statement::Copy { to: to.name, from: from.name, len: to.len });
    }

    /// Repeats statements for each number of a range.
    pub(super) fn each(
        &mut self,
        counter: &'static str,
        [from, to]: [impl Into<Index>; 2],
        write: impl FnOnce(&mut Body<'_>, Counter),
    ) {
        self.repeat(counter, [from.into(), to.into()], false, write);
    }

    /// Repeats statements for each number of a range, the last one first.
    pub(super) fn each_down(
        &mut self,
        counter: &'static str,
        count: usize,
        write: impl FnOnce(&mut Body<'_>, Counter),
    ) {
        self.repeat(counter, [0.into(), count.into()], true, write);
    }

    fn repeat(
        &mut self,
        counter: &'static str,
        range: [Index; 2],
        is_descending: bool,
        write: impl FnOnce(&mut Body<'_>, Counter),
    ) {
        let counter = Counter(counter);
        let body = self.inner(|body| write(body, counter));
        self.statements.push(Statement::For { counter, range, is_descending, body });
    }

    /// Executes statements if a condition holds.
    pub(super) fn when(&mut self, condition: Condition, write: impl FnOnce(&mut Body<'_>)) {
        let body = self.inner(write);
        self.statements.push(Statement::If { condition, body });
    }

    /// Ends the loop if a condition holds; further iterations would change nothing.
    pub(super) fn leave(&mut self, condition: Condition) {
        self.statements.push(Statement::Leave(condition));
    }

    /// Calls a procedure that fills an array.
    pub(super) fn call<const N: usize>(
        &mut self,
        procedure: &'static str,
        arguments: [Array; N],
        result: Array,
    ) {
        let arguments = arguments.map(|array| array.name).to_vec();
        let result = Variable { name: result.name, kind: Kind::Array(result.len) };
        self.statements.push(Statement::Call { procedure, arguments, result });
    }

    /// Calls a procedure that returns a number.
    pub(super) fn call_real<const N: usize>(
        &mut self,
        procedure: &'static str,
        arguments: [Array; N],
        Real(result): Real,
    ) {
        let arguments = arguments.map(|array| array.name).to_vec();
        let result = Variable { name: result, kind: Kind::Real };
        self.statements.push(Statement::Call { procedure, arguments, result });
    }

    /// Calls a generated function at joint variables.
    pub(super) fn evaluate<const N: usize>(&mut self, function: &'static str, q: Array, results: [Array; N]) {
        let results = results.map(|array| array.name).to_vec();
        self.statements.push(Statement::Evaluate { function, q: q.name, results });
    }

    fn inner(&mut self, write: impl FnOnce(&mut Body<'_>)) -> Vec<Statement> {
        let mut body = Body { procedure: self.procedure, statements: vec![] };
        write(&mut body);
        body.statements
    }
}

impl Array {
    /// Returns an element.
    pub(super) fn at(self, index: impl Into<Index>) -> Value {
        Value::Element(self.name, index.into())
    }

    /// Returns the sum of the products of `self[index]` and `other[index]` over a range.
    pub(super) fn dot<T: Into<Index>>(
        self,
        other: Self,
        [from, to]: [impl Into<Index>; 2],
        indices: impl FnOnce(Counter) -> [T; 2],
    ) -> Value {
        let counter = Counter("k");
        let [a, b] = indices(counter).map(Into::into);
        let range = [from.into(), to.into()];
        Value::Dot { counter, range, factors: [(self.name, a), (other.name, b)] }
    }
}

impl Real {
    /// Returns the number.
    pub(super) fn get(self) -> Value {
        self.into()
    }
}

impl From<Real> for Value {
    fn from(Real(name): Real) -> Self {
        Self::Name(name)
    }
}

impl From<Flag> for Condition {
    fn from(Flag(name): Flag) -> Self {
        Self::Flag(name)
    }
}

impl Counter {
    /// Returns the condition that a whole number is another one.
    pub(super) fn is(self, other: impl Into<Index>) -> Condition {
        Condition::Is(self.0, other.into())
    }
}
