//! Frames, and the rigid motions whose product is their transform.

use super::chain_number::DhConvention;
use crate::diagnostic::Span;
use crate::expr::{Dimension, Elementary, Expression, Motion, Symbol};

/// A frame `F_i` and its transform from the frame that it hangs on: `F_{i-1}`, unless it begins a
/// branch.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Name of the frame.
    pub name: String,
    /// Description.
    pub description: String,
    /// Index of the frame that it hangs on, before its own; `None` for `F_0`.
    pub parent: Option<usize>,
    /// Index of the variable that it declares, unless that is passive.
    pub variable: Option<usize>,
    /// Index of the passive variable that it declares.
    pub passive: Option<usize>,
    /// Factors of `A_i`, in order.
    pub factors: Vec<Factor>,
    /// Denavit-Hartenberg convention, if the frame is given that way.
    pub convention: Option<DhConvention>,
}

/// A factor of an `A_i`.
#[derive(Clone, Debug, PartialEq)]
pub enum Factor {
    /// A motion along or about x, y or z.
    Elementary(Elementary),
    /// A motion along or about any other axis.
    About {
        /// Translation or rotation.
        motion: Motion,
        /// Unit vector of the axis.
        axis: [f64; 3],
        /// Distance or angle.
        amount: Expression,
    },
    /// Any rigid motion.
    Matrix(Box<Matrix>),
}

/// The upper three rows of a homogeneous matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix {
    /// Three rows of four.
    pub rows: [[Expression; 4]; 3],
    /// Location in the file.
    pub span: Span,
}

impl Frame {
    /// Returns the symbols on which the transform depends.
    pub fn symbols(&self) -> impl Iterator<Item = Symbol> {
        self.factors.iter().flat_map(Factor::expressions).flat_map(Expression::symbols)
    }
}

impl Factor {
    /// Returns the factors of the inverse of a product.
    pub fn inverse(factors: &[Self]) -> Vec<Self> {
        let minus = |amount: &Expression| Expression::from_number(-1.0, Dimension::NONE) * amount.clone();
        let inverse = |factor: &Self| match factor {
            Self::Elementary(one) => {
                Self::Elementary(Elementary { amount: minus(&one.amount), ..one.clone() })
            }
            Self::About { motion, axis, amount } => {
                Self::About { motion: *motion, axis: *axis, amount: minus(amount) }
            }
            Self::Matrix(matrix) => {
                let Matrix { rows, span } = &**matrix;
                let row = |i: usize| {
                    let [a, b, c] = [0, 1, 2].map(|j| rows[j][i].clone());
                    let moved = [0, 1, 2].map(|j| rows[j][i].clone() * rows[j][3].clone());
                    let [x, y, z] = moved;
                    [a, b, c, minus(&(x + y + z))]
                };
                Self::Matrix(Box::new(Matrix { rows: [0, 1, 2].map(row), span: span.clone() }))
            }
        };
        factors.iter().rev().map(inverse).collect()
    }

    /// Returns all expressions of the factor.
    pub fn expressions(&self) -> Vec<&Expression> {
        match self {
            Self::Elementary(factor) => vec![&factor.amount],
            Self::About { amount, .. } => vec![amount],
            Self::Matrix(matrix) => matrix.rows.iter().flatten().collect(),
        }
    }
}
