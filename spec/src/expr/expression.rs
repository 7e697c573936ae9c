//! A checked expression.

use std::sync::Arc;

use abbe_core::Scalar;

use super::{Dimension, Function, Symbol, Table};
use crate::diagnostic::Span;

/// An operator with two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Binary {
    /// Sum.
    Add,
    /// Difference.
    Sub,
    /// Product.
    Mul,
    /// Quotient.
    Div,
    /// Power; the exponent is a constant.
    Pow,
    /// `atan2(y, x)`.
    Atan2,
    /// The smaller operand.
    Min,
    /// The larger operand.
    Max,
}

impl Binary {
    /// Returns the value for two operands.
    pub fn evaluate(self, left: f64, right: f64) -> f64 {
        match self {
            Self::Add => left + right,
            Self::Sub => left - right,
            Self::Mul => left * right,
            Self::Div => left / right,
            Self::Pow => left.powf(right),
            Self::Atan2 => left.atan2(right),
            Self::Min => Scalar::min(left, right),
            Self::Max => Scalar::max(left, right),
        }
    }
}

/// A table or one of its derivatives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Lookup {
    /// Index of the table in the spec.
    pub table: u16,
    /// Order of the derivative; 0 for the table itself.
    pub order: u16,
}

/// Operation of a term. Operands are indices of earlier terms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A number in coherent units.
    Number(f64),
    /// A name.
    Symbol(Symbol),
    /// A negation.
    Neg(usize),
    /// An operator with two operands.
    Binary(Binary, usize, usize),
    /// A function of one argument.
    Call(Function, usize),
    /// A table lookup.
    Lookup(Lookup, usize),
}

impl Kind {
    /// Applies `f` to every operand.
    pub(super) fn map(self, f: impl Fn(usize) -> usize) -> Self {
        match self {
            Self::Number(_) | Self::Symbol(_) => self,
            Self::Neg(a) => Self::Neg(f(a)),
            Self::Binary(operator, a, b) => Self::Binary(operator, f(a), f(b)),
            Self::Call(function, a) => Self::Call(function, f(a)),
            Self::Lookup(lookup, a) => Self::Lookup(lookup, f(a)),
        }
    }
}

/// A term of an expression.
#[derive(Clone, Debug, PartialEq)]
pub struct Term {
    /// Operation of the term.
    pub kind: Kind,
    /// Dimension; `None` after a mistake, so that it is not reported twice.
    pub dimension: Option<Dimension>,
    /// Value if the term is constant.
    pub value: Option<f64>,
    /// Location in the file.
    pub span: Span,
    /// `true` for a number, with or without a sign, that has no unit.
    pub bare: bool,
}

/// A checked expression: terms in an order in which each comes after its operands; the last one is
/// the whole expression.
///
/// It is a list instead of a tree, so that deep nesting cannot overflow the stack.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    pub(super) terms: Vec<Term>,
}

impl Expression {
    /// Creates an expression from terms whose last one is the whole.
    pub(crate) fn new(terms: Vec<Term>) -> Self {
        debug_assert!(!terms.is_empty());
        Self { terms }
    }

    /// Creates a constant.
    pub(crate) fn number(value: f64, dimension: Dimension, span: Span) -> Self {
        let kind = Kind::Number(value);
        Self::new(vec![Term { kind, dimension: Some(dimension), value: Some(value), span, bare: false }])
    }

    /// Creates a variable, parameter or input.
    pub(crate) fn symbol(symbol: Symbol, dimension: Option<Dimension>, span: Span) -> Self {
        Self::new(vec![Term { kind: Kind::Symbol(symbol), dimension, value: None, span, bare: false }])
    }

    /// Negates the expression.
    pub(crate) fn negated(mut self) -> Self {
        let whole = self.whole().clone();
        let kind = Kind::Neg(self.terms.len() - 1);
        self.terms.push(Term { kind, value: whole.value.map(|value| -value), ..whole });
        self
    }

    /// Returns the terms, operands first, the whole last.
    pub fn terms(&self) -> &[Term] {
        &self.terms
    }

    /// Returns the last term, which is the whole expression.
    pub fn whole(&self) -> &Term {
        &self.terms[self.terms.len() - 1]
    }

    /// Returns the value if the expression is constant.
    pub fn constant(&self) -> Option<f64> {
        self.whole().value
    }

    /// Returns the location in the file.
    pub fn span(&self) -> Span {
        self.whole().span.clone()
    }

    /// Returns the value for given values of the symbols.
    pub fn value(&self, tables: &[Arc<Table>], symbol: impl Fn(Symbol) -> f64) -> f64 {
        values(&self.terms, tables, symbol)[self.terms.len() - 1]
    }

    /// Iterates over the symbols, with repetitions.
    pub fn symbols(&self) -> impl Iterator<Item = Symbol> {
        self.terms.iter().filter_map(|term| match term.kind {
            Kind::Symbol(symbol) => Some(symbol),
            _ => None,
        })
    }
}

/// Returns the value of each term.
pub(super) fn values(terms: &[Term], tables: &[Arc<Table>], symbol: impl Fn(Symbol) -> f64) -> Vec<f64> {
    let mut values: Vec<f64> = Vec::with_capacity(terms.len());
    for term in terms {
        values.push(match term.kind {
            Kind::Number(value) => value,
            Kind::Symbol(name) => symbol(name),
            Kind::Neg(a) => -values[a],
            Kind::Binary(operator, a, b) => operator.evaluate(values[a], values[b]),
            Kind::Call(function, a) => function.evaluate(values[a]),
            Kind::Lookup(lookup, a) => {
                tables[usize::from(lookup.table)].derivative(u32::from(lookup.order), values[a])
            }
        });
    }
    values
}
