//! Operation counts, a simple measure of the quality of a program.

use std::{fmt, ops::AddAssign};

use abbe_spec::Function;

use super::{Action, Program};

/// Operations of a program, by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Operations {
    /// Multiplications.
    pub mul: usize,
    /// Additions and subtractions.
    pub add: usize,
    /// Negations.
    pub neg: usize,
    /// Divisions.
    pub div: usize,
    /// Sines, cosines, or both of one angle together.
    pub sincos: usize,
    /// Square roots.
    pub sqrt: usize,
    /// Other functions.
    pub other: usize,
}

impl Program {
    /// Returns the operation counts of the program.
    pub fn operations(&self) -> Operations {
        let mut count = Operations::default();
        for step in &self.steps {
            let kind = match step.action {
                Action::Neg(_) => &mut count.neg,
                Action::Add(..) | Action::Sub(..) => &mut count.add,
                Action::Mul(..) => &mut count.mul,
                Action::MulAdd(..) | Action::MulSub(..) | Action::NegMulAdd(..) => {
                    count.add += 1;
                    &mut count.mul
                }
                Action::Div(..) => &mut count.div,
                Action::SinCos(_) | Action::Call(Function::Sin | Function::Cos, _) => &mut count.sincos,
                Action::Call(Function::Sqrt, _) => &mut count.sqrt,
                Action::Call(..)
                | Action::Lookup(..)
                | Action::Pow(..)
                | Action::Atan2(..)
                | Action::Min(..)
                | Action::Max(..) => &mut count.other,
            };
            kind.add_assign(1);
        }
        count
    }
}

impl Operations {
    /// Returns the number by which alternative programs are compared: the operations that take
    /// significant time.
    pub fn weight(self) -> usize {
        self.mul + self.add + self.div + self.sincos
    }

    /// Returns the counts multiplied by `count`.
    pub fn times(self, count: usize) -> Self {
        self.each(Self::default(), |a, _| a * count)
    }

    /// Returns the sum of both counts.
    pub fn plus(self, other: Self) -> Self {
        self.each(other, |a, b| a + b)
    }

    fn each(self, other: Self, f: impl Fn(usize, usize) -> usize) -> Self {
        Self {
            mul: f(self.mul, other.mul),
            add: f(self.add, other.add),
            neg: f(self.neg, other.neg),
            div: f(self.div, other.div),
            sincos: f(self.sincos, other.sincos),
            sqrt: f(self.sqrt, other.sqrt),
            other: f(self.other, other.other),
        }
    }
}

/// Prints as `138 mul, 79 add, 6 sincos`. Multiplications and additions always appear, other
/// operations only if there are any.
impl fmt::Display for Operations {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} mul, {} add", self.mul, self.add)?;
        let rest = [
            (self.div, "div"),
            (self.sincos, "sincos"),
            (self.sqrt, "sqrt"),
            (self.other, "other"),
            (self.neg, "neg"),
        ];
        for (count, name) in rest.into_iter().filter(|(count, _)| *count > 0) {
            write!(f, ", {count} {name}")?;
        }
        Ok(())
    }
}
