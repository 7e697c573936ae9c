//! Expressions constructed from other expressions instead of text.
//!
//! ```
//! # use abbe_spec::expr::{Dimension, Expression, Function, Symbol};
//! let angle = Expression::from_symbol(Symbol::Variable(0), Dimension::NONE);
//! let length = Expression::from_number(2.0, Dimension::LENGTH);
//! let shift = length * angle.call(Function::Sin);
//! assert_eq!(shift.whole().dimension, Some(Dimension::LENGTH));
//! ```

use std::ops::{Add, Div, Mul};

use super::{Binary, Dimension, Expression, Function, Kind, Lookup, Symbol, Table, Term};

impl Expression {
    /// Creates a number in coherent units.
    pub fn from_number(value: f64, dimension: Dimension) -> Self {
        Self::number(value, dimension, 0..0)
    }

    /// Creates a variable, parameter or input with its dimension.
    pub fn from_symbol(symbol: Symbol, dimension: Dimension) -> Self {
        Self::symbol(symbol, Some(dimension), 0..0)
    }

    /// Applies a function whose result is a pure number.
    pub fn call(self, function: Function) -> Self {
        let value = self.constant().map(|value| function.evaluate(value));
        let operand = self.terms().len() - 1;
        self.with(Kind::Call(function, operand), Some(Dimension::NONE), value)
    }

    /// Looks up a table, given by its index in the spec, at this argument.
    pub fn looked_up(self, index: u16, table: &Table) -> Self {
        let value = self.constant().map(|value| table.derivative(0, value));
        let operand = self.terms().len() - 1;
        let kind = Kind::Lookup(Lookup { table: index, order: 0 }, operand);
        self.with(kind, Some(table.dimensions[1]), value)
    }

    /// Raises to a power.
    pub fn power(self, exponent: f64) -> Self {
        let dimension = self.whole().dimension.and_then(|dimension| dimension.power(exponent));
        self.combined(Binary::Pow, Self::from_number(exponent, Dimension::NONE), dimension)
    }

    /// Holds the value at the ends of a range outside of it.
    pub fn clamped(self, [least, most]: [f64; 2]) -> Self {
        let dimension = self.whole().dimension;
        let end = |end| Self::from_number(end, dimension.unwrap_or(Dimension::NONE));
        self.combined(Binary::Max, end(least), dimension).combined(Binary::Min, end(most), dimension)
    }

    fn combined(self, binary: Binary, right: Self, dimension: Option<Dimension>) -> Self {
        let value = self.constant().zip(right.constant()).map(|(l, r)| binary.evaluate(l, r));
        let left = self.terms().len();
        let place = left + right.terms().len();
        let mut terms = self.terms;
        let moved = |term: Term| Term { kind: term.kind.map(|operand| operand + left), ..term };
        terms.extend(right.terms.into_iter().map(moved));
        Self::new(terms).with(Kind::Binary(binary, left - 1, place - 1), dimension, value)
    }

    fn with(self, kind: Kind, dimension: Option<Dimension>, value: Option<f64>) -> Self {
        let mut terms = self.terms;
        terms.push(Term { kind, dimension, value, span: 0..0, bare: false });
        Self::new(terms)
    }
}

impl Add for Expression {
    type Output = Self;

    /// Adds an expression of the same dimension.
    fn add(self, right: Self) -> Self {
        let dimension = self.whole().dimension;
        self.combined(Binary::Add, right, dimension)
    }
}

impl Mul for Expression {
    type Output = Self;

    fn mul(self, right: Self) -> Self {
        let dimension = self.whole().dimension.zip(right.whole().dimension).and_then(|(l, r)| l.times(r));
        self.combined(Binary::Mul, right, dimension)
    }
}

impl Div for Expression {
    type Output = Self;

    fn div(self, right: Self) -> Self {
        let dimension = self.whole().dimension.zip(right.whole().dimension).and_then(|(l, r)| l.over(r));
        self.combined(Binary::Div, right, dimension)
    }
}
