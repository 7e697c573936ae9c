//! Expressions and conditions.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::{Counter, Index};

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
