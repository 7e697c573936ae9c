//! One small statement of any language.

use super::expression::{Expression, Value};
use crate::program::{Place, Repeated};

/// One statement. Arrays are indices of the routine's.
pub(super) enum Statement {
    /// Names for the numbers of a place; those without use have none.
    Unpack { names: Vec<Option<String>>, from: Place },
    /// What comes next.
    Comment(String),
    /// A name for a value.
    Let { name: String, value: String },
    /// Names for sine and cosine of angles.
    SinCos(Vec<([String; 2], Expression)>),
    /// An array that is not given begins.
    Declare(usize),
    /// Zeros for an array.
    Clear(usize),
    /// An array becomes what rows of another one are.
    Copy { from: Place, to: usize },
    /// Row `index` of a place becomes these; a `fresh` array begins with them.
    Assign { to: Place, index: usize, values: Vec<Value>, fresh: bool },
    /// A part of column `index` of `J_e`, for what takes columns one by one.
    Column { index: usize, part: &'static str, values: Vec<Value> },
    /// Another routine; of the arrays that it fills, those that begin here.
    Call { routine: &'static str, arrays: Vec<usize>, fresh: Vec<usize> },
    /// Entries of an array as sums of terms.
    Sums { sums: usize, terms: usize, entries: usize },
    /// For every row.
    For { repeated: Repeated, body: Vec<Statement> },
    /// The margin is returned.
    Return(String),
}
