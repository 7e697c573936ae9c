//! Types and variables of program organization units.

use std::collections::HashMap;

/// Type of a variable or an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Type {
    Bool,
    Int,
    Dint,
    Lreal,
    /// Whole number without a type, which takes the one that it needs.
    Whole,
    Array(Element, usize),
    /// Instance of the unit with this index.
    Block(usize),
}

/// Type of an array's elements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Element {
    Dint,
    Lreal,
}

impl Element {
    pub(super) const fn as_type(self) -> Type {
        match self {
            Self::Dint => Type::Dint,
            Self::Lreal => Type::Lreal,
        }
    }
}

impl Type {
    /// Returns `true` if a value of `other` may be assigned without a conversion.
    pub(super) fn takes(self, other: Self) -> bool {
        self == other || other == Self::Whole && matches!(self, Self::Int | Self::Dint)
    }

    /// Returns the common type of two operands.
    pub(super) fn joined(self, other: Self) -> Option<Self> {
        if self.takes(other) { Some(self) } else { other.takes(self).then_some(other) }
    }
}

/// Section that declares a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Section {
    Input,
    Output,
    InOut,
    Local,
    Constant,
}

/// Variable of a unit.
#[derive(Clone, Debug)]
pub(super) struct Variable {
    pub(super) section: Section,
    pub(super) kind: Type,
    /// Offset from the start of the unit's memory.
    pub(super) offset: usize,
}

/// Function, function block or program.
#[derive(Clone, Debug, Default)]
pub(super) struct Unit {
    pub(super) name: String,
    /// Type of the result; `None` for blocks and programs.
    pub(super) result: Option<Type>,
    pub(super) variables: HashMap<String, Variable>,
    /// Arguments of a function in order.
    pub(super) parameters: Vec<String>,
    /// Initial values of the memory. The result of a function has the offset 0.
    pub(super) initial: Vec<f64>,
    pub(super) body: Vec<Statement>,
}

/// Memory of a variable or of an element.
#[derive(Clone, Debug)]
pub(super) struct Place {
    pub(super) offset: usize,
    /// `true` if the memory holds the address of the value.
    pub(super) is_indirect: bool,
    /// Index, and number of elements.
    pub(super) index: Option<(Box<Expression>, usize)>,
}

#[derive(Clone, Debug)]
pub(super) enum Expression {
    Number(f64),
    Load(Place),
    Negative(Box<Expression>),
    Not(Box<Expression>),
    Binary(&'static str, bool, Box<[Expression; 2]>),
    Standard(&'static str, Vec<Expression>),
    /// Function, and its arguments; those by reference are `Load`.
    Call(usize, Vec<Expression>),
}

#[derive(Clone, Debug)]
pub(super) enum Statement {
    Assign(Place, Expression),
    /// Copies as many numbers from one place to the other.
    Copy(Place, Place, usize),
    If(Vec<(Expression, Vec<Statement>)>),
    While(Expression, Vec<Statement>),
    For {
        counter: Place,
        range: [Expression; 2],
        by: i64,
        body: Vec<Statement>,
    },
    /// Unit, offset of the instance, and assignments of its inputs.
    Call(usize, usize, Vec<Statement>),
    Exit,
    Return,
}
