//! Frames and the rigid motions that their transforms are products of.

use super::chain_number::DhConvention;
use crate::diagnostic::Span;
use crate::expr::{Elementary, Expression, Motion};

/// A frame `F_i` and the way to it from `F_{i-1}`.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Its name.
    pub name: String,
    /// What it is.
    pub description: String,
    /// The variable that it declares.
    pub variable: Option<usize>,
    /// `A_i` as a product.
    pub factors: Vec<Factor>,
    /// Which product, if it is given by Denavit-Hartenberg numbers.
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
        /// The axis, of length 1.
        axis: [f64; 3],
        /// How far.
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
    /// Where it stands.
    pub span: Span,
}

impl Factor {
    /// Every expression in it.
    pub fn expressions(&self) -> Vec<&Expression> {
        match self {
            Self::Elementary(factor) => vec![&factor.amount],
            Self::About { amount, .. } => vec![amount],
            Self::Matrix(matrix) => matrix.rows.iter().flatten().collect(),
        }
    }
}
