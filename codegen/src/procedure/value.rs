//! Expressions, conditions, and indices of elements: sums of loop counters.

use std::fmt;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A real expression.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// A variable.
    Name(&'static str),
    /// A whole number as a real one.
    Whole(Index),
    /// An element of an array.
    Element(&'static str, Index),
    /// An operation on one operand.
    Unary(Unary, Box<Value>),
    /// An operation on two operands.
    Binary(Binary, Box<[Value; 2]>),
    /// Nearest number of an interval, and its lower end for NaN: value, lower and upper end.
    Clamped(Box<[Value; 3]>),
    /// Sum of products, added one by one from 0.
    Dot {
        /// The counter of the products.
        counter: Counter,
        /// First value of the counter, and the value behind the last one.
        range: [Index; 2],
        /// Arrays and indices of both factors.
        factors: [(&'static str, Index); 2],
    },
}

/// An operation on one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unary {
    /// Negation.
    Negative,
    /// Absolute value.
    Absolute,
    /// Square root.
    Root,
}

/// An operation on two numbers.
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
    /// Angle of the point (second, first).
    Arctangent,
}

/// A condition. Comparisons are false for NaN, and only by `>` and `>=`: compilers that ignore that
/// NaN has no order get these right.
#[derive(Clone, Debug, PartialEq)]
pub enum Condition {
    /// The first number is greater.
    Greater(Value, Value),
    /// The first number is greater or equal.
    AtLeast(Value, Value),
    /// A whole number is another one. An argument that is compared with a number has the same value
    /// in all configurations.
    Is(&'static str, Index),
    /// A truth value.
    Flag(&'static str),
    /// Both conditions hold.
    And(Box<[Condition; 2]>),
    /// One of the conditions holds.
    Or(Box<[Condition; 2]>),
}

impl Value {
    /// Returns the nearest number of an interval.
    pub fn clamped(self, lower: impl Into<Self>, upper: impl Into<Self>) -> Self {
        Self::Clamped(Box::new([self, lower.into(), upper.into()]))
    }

    /// Returns the absolute value.
    #[must_use]
    pub fn abs(self) -> Self {
        Self::Unary(Unary::Absolute, Box::new(self))
    }

    /// Returns the square root.
    #[must_use]
    pub fn sqrt(self) -> Self {
        Self::Unary(Unary::Root, Box::new(self))
    }

    /// Returns the angle of the point (x, self).
    #[must_use]
    pub fn atan2(self, x: impl Into<Self>) -> Self {
        Self::binary(Binary::Arctangent, self, x.into())
    }

    /// Returns `self > other`.
    pub fn exceeds(self, other: impl Into<Self>) -> Condition {
        Condition::Greater(self, other.into())
    }

    /// Returns `self >= other`.
    pub fn is_at_least(self, other: impl Into<Self>) -> Condition {
        Condition::AtLeast(self, other.into())
    }

    /// Returns the condition that two finite numbers differ.
    pub fn differs(self, other: impl Into<Self>) -> Condition {
        let other = other.into();
        self.clone().exceeds(other.clone()).or(other.exceeds(self))
    }

    fn binary(operator: Binary, a: Self, b: Self) -> Self {
        Self::Binary(operator, Box::new([a, b]))
    }

    /// Iterates over the operands.
    pub(super) fn operands_mut(&mut self) -> impl Iterator<Item = &mut Self> {
        match self {
            Self::Unary(_, operand) => std::slice::from_mut(&mut **operand),
            Self::Binary(_, operands) => &mut operands[..],
            Self::Clamped(operands) => &mut operands[..],
            _ => &mut [],
        }
        .iter_mut()
    }
}

impl Condition {
    /// Returns the condition that both hold.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self::And(Box::new([self, other]))
    }

    /// Returns the condition that one of them holds.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self::Or(Box::new([self, other]))
    }
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl Neg for Value {
    type Output = Self;

    fn neg(self) -> Self {
        Self::Unary(Unary::Negative, Box::new(self))
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident),+) => {$(
        impl<T: Into<Value>> $operator<T> for Value {
            type Output = Self;

            fn $method(self, other: T) -> Self {
                Self::binary(Binary::$operator, self, other.into())
            }
        }
    )+};
}

operators!(Add add, Sub sub, Mul mul, Div div);

/// Counter of a loop, or another whole variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counter(pub(super) &'static str);

/// A sum of multiples of counters and a number.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Index {
    /// Factor and counter of each term.
    terms: Vec<(usize, Counter)>,
    offset: i64,
}

impl Counter {
    /// Returns the name of the counter.
    pub const fn name(self) -> &'static str {
        self.0
    }
}

impl Index {
    /// Returns the index if it is a number.
    pub fn number(&self) -> Option<i64> {
        self.terms.is_empty().then_some(self.offset)
    }

    /// Returns the index where counters have these values.
    pub fn value(&self, counter: impl Fn(Counter) -> i64) -> i64 {
        self.terms.iter().fold(self.offset, |sum, (factor, name)| sum + *factor as i64 * counter(*name))
    }

    /// Returns the factor of a counter.
    pub fn factor(&self, counter: Counter) -> usize {
        self.terms.iter().filter(|(_, other)| *other == counter).map(|(factor, _)| factor).sum()
    }

    /// Replaces a counter by an index.
    #[must_use]
    pub fn with(&self, counter: Counter, value: &Self) -> Self {
        let factor = self.factor(counter);
        let mut index = self.clone();
        index.terms.retain(|(_, other)| *other != counter);
        index.terms.extend(value.terms.iter().map(|(other, name)| (other * factor, *name)));
        index.terms.retain(|(factor, _)| *factor > 0);
        index.offset += value.offset * factor as i64;
        index.merged()
    }

    fn merged(mut self) -> Self {
        let mut terms: Vec<(usize, Counter)> = Vec::new();
        for (factor, counter) in self.terms {
            match terms.iter_mut().find(|(_, other)| *other == counter) {
                Some((sum, _)) => *sum += factor,
                None => terms.push((factor, counter)),
            }
        }
        self.terms = terms;
        self
    }
}

/// Returns the range from 0 to the number before `end`.
pub(super) fn below(end: impl Into<Index>) -> [Index; 2] {
    [0.into(), end.into()]
}

/// Prints as `6 * j + i + 9`, which every language reads.
impl fmt::Display for Index {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, (factor, Counter(name))) in self.terms.iter().enumerate() {
            let plus = if k > 0 { " + " } else { "" };
            match factor {
                1 => write!(f, "{plus}{name}")?,
                factor => write!(f, "{plus}{factor} * {name}")?,
            }
        }
        match self.offset {
            offset if self.terms.is_empty() => write!(f, "{offset}"),
            0 => Ok(()),
            offset if offset < 0 => write!(f, " - {}", -offset),
            offset => write!(f, " + {offset}"),
        }
    }
}

impl From<usize> for Index {
    fn from(offset: usize) -> Self {
        Self { terms: Vec::new(), offset: offset as i64 }
    }
}

impl From<i32> for Index {
    fn from(offset: i32) -> Self {
        Self { terms: Vec::new(), offset: i64::from(offset) }
    }
}

impl From<Counter> for Index {
    fn from(counter: Counter) -> Self {
        Self { terms: vec![(1, counter)], offset: 0 }
    }
}

impl Mul<Counter> for usize {
    type Output = Index;

    fn mul(self, counter: Counter) -> Index {
        Index { terms: vec![(self, counter)], offset: 0 }
    }
}

impl<T: Into<Index>> Add<T> for Index {
    type Output = Self;

    fn add(mut self, other: T) -> Self {
        let other = other.into();
        self.terms.extend(other.terms);
        self.offset += other.offset;
        self.merged()
    }
}

impl<T: Into<Index>> Add<T> for Counter {
    type Output = Index;

    fn add(self, other: T) -> Index {
        Index::from(self) + other
    }
}

impl Add<Counter> for usize {
    type Output = Index;

    fn add(self, counter: Counter) -> Index {
        Index::from(counter) + self
    }
}

impl Sub<usize> for Index {
    type Output = Self;

    fn sub(mut self, other: usize) -> Self {
        self.offset -= other as i64;
        self
    }
}
