//! Frames, and the rigid motions whose product is their transform.
//!
//! Numbers of the nominal chain: joint variables, structural parameters and Denavit-Hartenberg
//! numbers.

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
                    let [x, y, z] = [0, 1, 2].map(|j| rows[j][i].clone() * rows[j][3].clone());
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

/// A number of the nominal chain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ChainNumber {
    /// A joint variable, in every transform that depends on it.
    Joint(usize),
    /// A structural parameter, in every transform that depends on it.
    Parameter(usize),
    /// One of the four Denavit-Hartenberg numbers of a frame.
    DenavitHartenberg {
        /// Index of the frame, from 0.
        frame: usize,
        /// The number.
        number: DhNumber,
    },
}

/// One of the four Denavit-Hartenberg numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DhNumber {
    /// Rotation about z.
    Theta,
    /// Translation along z.
    D,
    /// Translation along x.
    A,
    /// Rotation about x.
    Alpha,
}

impl DhNumber {
    /// The four numbers.
    pub const ALL: [Self; 4] = [Self::Theta, Self::D, Self::A, Self::Alpha];

    /// Returns its key in a spec.
    pub const fn name(self) -> &'static str {
        ["theta", "d", "a", "alpha"][self as usize]
    }

    /// Returns its motion and axis: 0 = x, 1 = y, 2 = z.
    pub const fn motion(self) -> (Motion, usize) {
        match self {
            Self::Theta => (Motion::Rotation, 2),
            Self::D => (Motion::Translation, 2),
            Self::A => (Motion::Translation, 0),
            Self::Alpha => (Motion::Rotation, 0),
        }
    }
}

/// Convention of a Denavit-Hartenberg frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DhConvention {
    /// `Rz(theta) Tz(d) Tx(a) Rx(alpha)`.
    Standard,
    /// Craig's: `Rx(alpha) Tx(a) Rz(theta) Tz(d)`.
    Modified,
}

impl DhConvention {
    /// Returns its name in options and tables.
    pub const fn name(self) -> &'static str {
        ["standard", "modified"][self as usize]
    }

    /// Returns the numbers in the order of the frame's factors.
    pub const fn order(self) -> [DhNumber; 4] {
        match self {
            Self::Standard => [DhNumber::Theta, DhNumber::D, DhNumber::A, DhNumber::Alpha],
            Self::Modified => [DhNumber::Alpha, DhNumber::A, DhNumber::Theta, DhNumber::D],
        }
    }
}
