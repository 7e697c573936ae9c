//! A checked expression.

use std::sync::Arc;

use abbe_core::Scalar;

use super::{Dimension, Function, Symbol, Table};
use crate::diagnostic::Span;

/// An operator of two operands.
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
    /// The smaller.
    Min,
    /// The larger.
    Max,
}

impl Binary {
    /// Its value.
    pub fn of(self, left: f64, right: f64) -> f64 {
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

/// A table, or a derivative of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Lookup {
    /// Which of the spec's tables.
    pub table: u16,
    /// The order of the derivative, 0 for the table itself.
    pub order: u16,
}

/// What a term is. Operands are indices of earlier terms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A number in the coherent system.
    Number(f64),
    /// A name.
    Symbol(Symbol),
    /// A change of sign.
    Neg(usize),
    /// An operator.
    Binary(Binary, usize, usize),
    /// A function.
    Call(Function, usize),
    /// A table.
    Lookup(Lookup, usize),
}

impl Kind {
    /// The same with other operands.
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
    /// What it is.
    pub kind: Kind,
    /// Its dimension; none after a mistake, so that one mistake is told once.
    pub dimension: Option<Dimension>,
    /// Its value if it is constant.
    pub value: Option<f64>,
    /// Its place in the file.
    pub span: Span,
    /// Whether it is a number, with its sign, to which no unit was given.
    pub bare: bool,
}

/// A checked expression: its terms in an order in which each comes after its operands, the last being the whole.
///
/// A list and not a tree, so that no depth of nesting can exhaust the stack.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    terms: Vec<Term>,
}

impl Expression {
    /// Takes terms of which the last is the whole.
    pub(crate) fn new(terms: Vec<Term>) -> Self {
        debug_assert!(!terms.is_empty());
        Self { terms }
    }

    /// A constant that stands nowhere in the file.
    pub(crate) fn number(value: f64, dimension: Dimension, span: Span) -> Self {
        let kind = Kind::Number(value);
        Self::new(vec![Term { kind, dimension: Some(dimension), value: Some(value), span, bare: false }])
    }

    /// The variable, parameter or input itself.
    pub(crate) fn symbol(symbol: Symbol, dimension: Option<Dimension>, span: Span) -> Self {
        let kind = Kind::Symbol(symbol);
        Self::new(vec![Term { kind, dimension, value: None, span, bare: false }])
    }

    /// The same with the other sign.
    pub(crate) fn negated(mut self) -> Self {
        let whole = self.whole().clone();
        let kind = Kind::Neg(self.terms.len() - 1);
        self.terms.push(Term { kind, value: whole.value.map(|value| -value), ..whole });
        self
    }

    /// Operands first, the whole last.
    pub fn terms(&self) -> &[Term] {
        &self.terms
    }

    pub(super) fn into_terms(self) -> Vec<Term> {
        self.terms
    }

    /// The term that is the whole.
    pub fn whole(&self) -> &Term {
        &self.terms[self.terms.len() - 1]
    }

    /// Its value if it is constant.
    pub fn constant(&self) -> Option<f64> {
        self.whole().value
    }

    /// Its place in the file.
    pub fn span(&self) -> Span {
        self.whole().span.clone()
    }

    /// Its value at values of its names.
    pub fn value(&self, tables: &[Arc<Table>], symbol: impl Fn(Symbol) -> f64) -> f64 {
        values(&self.terms, tables, symbol)[self.terms.len() - 1]
    }

    /// Every name it uses.
    pub fn symbols(&self) -> impl Iterator<Item = Symbol> {
        self.terms.iter().filter_map(|term| match term.kind {
            Kind::Symbol(symbol) => Some(symbol),
            _ => None,
        })
    }
}

/// The value of each term.
pub(super) fn values(terms: &[Term], tables: &[Arc<Table>], symbol: impl Fn(Symbol) -> f64) -> Vec<f64> {
    let mut values: Vec<f64> = Vec::with_capacity(terms.len());
    for term in terms {
        values.push(match term.kind {
            Kind::Number(value) => value,
            Kind::Symbol(name) => symbol(name),
            Kind::Neg(a) => -values[a],
            Kind::Binary(operator, a, b) => operator.of(values[a], values[b]),
            Kind::Call(function, a) => function.of(values[a]),
            Kind::Lookup(lookup, a) => {
                tables[usize::from(lookup.table)].derivative(u32::from(lookup.order), values[a])
            }
        });
    }
    values
}
