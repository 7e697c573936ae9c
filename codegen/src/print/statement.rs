//! Language-independent statements.

use super::expression::{Expression, Value};
use crate::program::{ArrayRows, Repeated, Row};

/// A statement. Arrays are indices in the routine's list of arrays.
pub(super) enum Statement {
    /// Binds names to the numbers of a place; unused ones have none.
    Unpack { names: Vec<Option<String>>, from: ArrayRows },
    /// A comment on the following statements.
    Comment(String),
    /// Binds a name to a value.
    Let { name: String, value: String },
    /// Binds names to sines and cosines of angles.
    SinCos(Vec<([String; 2], Expression)>),
    /// Declares a local array.
    Declare(usize),
    /// Fills an array with zeros.
    Clear(usize),
    /// Copies rows of an array to another one; a `fresh` array is declared with these values.
    Copy { from: ArrayRows, to: usize, fresh: bool },
    /// Assigns row `index` of a place; a `fresh` array is declared with these values.
    Assign { to: ArrayRows, index: usize, values: Vec<Value>, fresh: bool },
    /// Part of column `index` of `J_e`, for consumers that take columns one by one.
    Column { index: usize, part: &'static str, values: Vec<Value> },
    /// Calls another routine, which initializes the `fresh` arrays.
    Call { routine: &'static str, arrays: Vec<usize>, fresh: Vec<usize> },
    /// Computes entries of an array as sums of terms.
    Sums { sums: usize, terms: usize, entries: usize },
    /// Loops over rows.
    For { repeated: Repeated, body: Vec<Statement> },
    /// Returns the margin.
    Return(String),
}

impl Statement {
    /// Returns `true` if the statement reads or writes a row that the counter of its loop selects.
    pub(super) fn is_counted(&self) -> bool {
        let counted = |place: &ArrayRows| matches!(place.row, Row::Each { .. } | Row::Listed { .. });
        match self {
            Self::Unpack { from: place, .. } | Self::Assign { to: place, .. } => counted(place),
            _ => false,
        }
    }
}
