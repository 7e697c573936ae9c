//! Procedures: algorithms with loops and branches, described once for every target language.
//!
//! A [`Procedure`] reads arrays and numbers and returns one array or number. Its [`Statement`]s
//! count loops by fixed ranges and index arrays by sums of loop counters, so that a language whose
//! numbers are arrays of configurations can print every branch as a choice by a mask. `value` has
//! expressions, `build` the builder that descriptions are written with, `lower` replaces sums by
//! loops, `look_up` describes functions of numbers and lookups of tables, and `compensated` the
//! corrected command.

mod build;
mod compensated;
mod look_up;
mod lower;
mod value;

pub use build::Body;
pub use compensated::{Precision, compensated};
pub use look_up::{clamped, least_and_greatest, look_up, side, sign};
pub use value::{Binary, Condition, Counter, Index, Unary, Value};

use abbe_core::compensator::Status;

/// Kind of a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Array of this many real numbers.
    Array(usize),
    /// Real number.
    Real,
    /// Whole number.
    Whole,
    /// Truth value.
    Flag,
}

/// A variable of a procedure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Variable {
    /// Name of the variable.
    pub name: &'static str,
    /// Kind of the variable.
    pub kind: Kind,
}

/// A procedure with arguments, one result and local variables. Every call assigns the result and
/// each local variable before it reads them.
#[derive(Clone, Debug, PartialEq)]
pub struct Procedure {
    /// Name of the procedure.
    pub name: &'static str,
    /// Documentation of the procedure.
    pub documentation: String,
    /// Arguments in order. No statement assigns them.
    pub arguments: Vec<Variable>,
    /// Results: one, except for the corrected command.
    pub results: Vec<Variable>,
    /// Arrays of fixed numbers.
    pub constants: Vec<(&'static str, Vec<f64>)>,
    /// Local variables without the counters of loops.
    pub locals: Vec<Variable>,
    /// Statements in order.
    pub body: Vec<Statement>,
}

/// A statement of a procedure.
#[derive(Clone, Debug, PartialEq)]
pub enum Statement {
    /// A comment on the following statements.
    Comment(&'static str),
    /// Assigns a real number to a variable or an element.
    Set(Value, Value),
    /// Assigns a truth value.
    SetFlag(&'static str, bool),
    /// Assigns a whole number.
    SetWhole(&'static str, Whole),
    /// Copies the array `from` to `to`.
    Copy {
        /// Name of the array that is filled.
        to: &'static str,
        /// Name of the array to copy.
        from: &'static str,
        /// Number of elements.
        len: usize,
    },
    /// A loop over a range.
    For {
        /// The counter.
        counter: Counter,
        /// First value, and the value behind the last one.
        range: [Index; 2],
        /// `true` to start with the last value.
        is_descending: bool,
        /// Statements in order.
        body: Vec<Statement>,
    },
    /// Statements that are executed if a condition holds. What they assign has a value before.
    If {
        /// The condition.
        condition: Condition,
        /// Statements in order.
        body: Vec<Statement>,
    },
    /// Ends the loop if the condition holds. Further iterations would change nothing, so that many
    /// configurations at once may go on until it holds for all of them.
    Leave(Condition),
    /// Calls another procedure, which fills an array or a number.
    Call {
        /// Name of the procedure.
        procedure: &'static str,
        /// Names of the arguments.
        arguments: Vec<&'static str>,
        /// Variable that takes the result.
        result: Variable,
    },
    /// Calls a generated function at joint variables. Without a value the procedure ends with the
    /// function's status, and assigns no result.
    Evaluate {
        /// Name of the function.
        function: &'static str,
        /// Name of the array of joint variables.
        q: &'static str,
        /// Names of the arrays that take its results.
        results: Vec<&'static str>,
    },
}

/// A whole number to be assigned.
#[derive(Clone, Debug, PartialEq)]
pub enum Whole {
    /// A sum of counters, whole variables and a number.
    Index(Index),
    /// The nearest whole number.
    Nearest(Value),
    /// The number of a status.
    Status(Status),
}

impl Procedure {
    /// Iterates over all statements, each before those that it contains.
    pub fn statements(&self) -> impl Iterator<Item = &Statement> {
        let mut rest: Vec<&Statement> = self.body.iter().rev().collect();
        std::iter::from_fn(move || {
            let statement = rest.pop()?;
            rest.extend(statement.inner().iter().rev());
            Some(statement)
        })
    }

    /// Iterates over all names: its own, and those of its variables.
    pub fn names(&self) -> impl Iterator<Item = &'static str> {
        let variables = self.arguments.iter().chain(&self.results).chain(&self.locals);
        let names =
            variables.map(|variable| variable.name).chain(self.constants.iter().map(|(name, _)| *name));
        [self.name].into_iter().chain(names.collect::<Vec<_>>()).chain(self.counters())
    }

    /// Returns the names of all loop counters.
    pub fn counters(&self) -> Vec<&'static str> {
        let mut names: Vec<&'static str> = self.statements().filter_map(Statement::counter).collect();
        names.sort_unstable();
        names.dedup();
        names
    }

    /// Returns the names of the procedures and functions that it calls, each once.
    pub fn called(&self) -> Vec<&'static str> {
        let mut names = Vec::new();
        for statement in self.statements() {
            match statement {
                Statement::Call { procedure: name, .. } | Statement::Evaluate { function: name, .. }
                    if !names.contains(name) =>
                {
                    names.push(*name);
                }
                _ => {}
            }
        }
        names
    }

    /// Returns `true` if the first statement that assigns an array assigns an element: the array
    /// has to exist before.
    pub fn begins_by_elements(&self, array: &str) -> bool {
        let mut assigned = self.statements().filter_map(|statement| statement.assigned(array));
        assigned.next() == Some(Assigned::Element)
    }

    /// Returns `true` if a statement assigns an array as a whole.
    pub fn is_assigned_whole(&self, array: &str) -> bool {
        self.statements().any(|statement| statement.assigned(array) == Some(Assigned::Whole))
    }
}

/// Part of an array that a statement assigns.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Assigned {
    Element,
    Whole,
}

impl Statement {
    fn inner(&self) -> &[Self] {
        match self {
            Self::For { body, .. } | Self::If { body, .. } => body,
            _ => &[],
        }
    }

    fn assigned(&self, array: &str) -> Option<Assigned> {
        match self {
            Self::Set(Value::Element(name, _), _) if *name == array => Some(Assigned::Element),
            Self::Copy { to, .. } if *to == array => Some(Assigned::Whole),
            Self::Call { result, .. } if result.name == array => Some(Assigned::Whole),
            Self::Evaluate { results, .. } if results.contains(&array) => Some(Assigned::Whole),
            _ => None,
        }
    }

    fn counter(&self) -> Option<&'static str> {
        match self {
            Self::For { counter, .. } => Some(counter.0),
            _ => None,
        }
    }
}
