//! How a function is computed, in no particular language: arrays, and stages that read and write their rows.
//!
//! A stage is a straight-line [`Program`], once or for every frame, the call of another routine, or a table of sums. Most
//! functions are one program that reads the arguments as symbols and writes whole results.

use abbe_core::function::Count;
use abbe_core::{Description, Function};

use super::{Operations, Program};

/// A function, or a part that several functions call.
#[derive(Clone, Debug, PartialEq)]
pub struct Routine {
    /// Which function it is; none if it only helps others.
    pub function: Option<Function>,
    /// What it is called.
    pub name: &'static str,
    /// What it computes.
    pub documentation: &'static str,
    /// What it takes and fills, in the order of the function's signature, then the margin, then what it needs itself.
    pub arrays: Vec<Array>,
    /// One after the other.
    pub stages: Vec<Stage>,
    /// What one call takes.
    pub operations: Operations,
}

/// An array of numbers that a routine uses.
#[derive(Clone, Debug, PartialEq)]
pub struct Array {
    /// Its name.
    pub name: &'static str,
    /// Its dimensions, the outermost first.
    pub shape: Vec<Count>,
    /// Where it comes from.
    pub role: Role,
}

/// Where an array comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// It is given.
    Argument,
    /// It is filled.
    Result,
    /// It is one number, returned: `cos ρ`.
    Margin,
    /// It begins as zeros, and is not seen from outside.
    Zeros,
}

/// A part of a routine.
#[derive(Clone, Debug, PartialEq)]
pub enum Stage {
    /// A program, once or many times.
    Block(Block),
    /// Another routine, and what it takes and fills, in the order of its arrays.
    Call {
        /// Its name.
        routine: &'static str,
        /// Arguments, results, margin: indices of this routine's arrays.
        arrays: Vec<usize>,
    },
    /// Entries of an array as sums of few terms.
    Sums {
        /// Index of the sums.
        sums: usize,
        /// Index of the array that holds the terms.
        terms: usize,
        /// Index of the array that is filled.
        entries: usize,
    },
    /// Zeros for an array.
    Clear(usize),
    /// An array becomes what rows of another one are.
    Copy {
        /// What stays as it is.
        from: Place,
        /// Index of the array that is filled.
        to: usize,
    },
}

/// A program that reads rows of arrays and writes rows of arrays: all is read before anything is written.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// What the program's local symbols are, row after row.
    pub reads: Vec<Place>,
    /// What is computed.
    pub program: Program,
    /// Where its outputs go, row after row.
    pub writes: Vec<Place>,
    /// How often, and in which order; once if there is nothing.
    pub repeated: Option<Repeated>,
}

/// For every row from the first to the last, or from the last to the first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Repeated {
    /// How many rows there are.
    pub count: Count,
    /// Whether the last comes first.
    pub backwards: bool,
}

/// Rows of an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// Index of the array.
    pub array: usize,
    /// Which of its rows.
    pub row: Row,
}

/// Which row: a pose is one row, else the innermost dimension is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Row {
    /// All of them.
    All,
    /// The first one.
    First,
    /// The last one.
    Last,
    /// All that come after the first one.
    AllButFirst,
    /// Of the loop's counter i, row `stride · i + offset`.
    Each {
        /// How many rows belong to one i.
        stride: usize,
        /// Which of them.
        offset: usize,
    },
    /// The one that a table has in row i.
    Listed {
        /// Index of the table.
        table: usize,
        /// Its first or second number.
        column: usize,
    },
}

impl Routine {
    /// How many of its stages write an array.
    pub fn writes(&self, array: usize) -> usize {
        let writes = |stage: &&Stage| match stage {
            Stage::Block(block) => block.writes.iter().any(|place| place.array == array),
            Stage::Call { arrays, .. } => arrays.contains(&array),
            Stage::Sums { entries: filled, .. } | Stage::Copy { to: filled, .. } | Stage::Clear(filled) => {
                *filled == array
            }
        };
        self.stages.iter().filter(writes).count()
    }
}

impl Block {
    /// Whether a place that is read holds the same in every turn of the loop.
    pub fn is_constant(&self, place: &Place) -> bool {
        let is_written = self.writes.iter().any(|written| written.array == place.array);
        self.repeated.is_some() && matches!(place.row, Row::All | Row::First | Row::Last) && !is_written
    }
}

impl Place {
    /// The whole array.
    pub const fn all(array: usize) -> Self {
        Self { array, row: Row::All }
    }
}

impl Row {
    /// Row i.
    pub const EACH: Self = Self::Each { stride: 1, offset: 0 };
    /// Row i + 1.
    pub const NEXT: Self = Self::Each { stride: 1, offset: 1 };
}

impl Array {
    /// How many of its dimensions make up a row.
    pub fn row_rank(&self) -> usize {
        let pose = [Count::Exactly(4), Count::Exactly(3)];
        if self.shape.ends_with(&pose) { 2 } else { 1 }
    }

    /// How many numbers it holds.
    pub fn len(&self, description: &Description) -> usize {
        product(&self.shape, description)
    }

    /// Whether it holds none.
    pub fn is_empty(&self, description: &Description) -> bool {
        self.len(description) == 0
    }

    /// How many numbers a row of it holds.
    pub fn row_len(&self, description: &Description) -> usize {
        product(&self.shape[self.shape.len() - self.row_rank()..], description)
    }

    /// How many numbers a place in it holds: a row of numbers by themselves is one.
    pub fn place_len(&self, row: Row, description: &Description) -> usize {
        match row {
            Row::All => self.len(description),
            Row::AllButFirst => self.len(description) - self.row_len(description),
            _ if self.shape.len() == 1 => 1,
            _ => self.row_len(description),
        }
    }
}

fn product(shape: &[Count], description: &Description) -> usize {
    shape.iter().map(|count| count.value(description)).product()
}

/// Constants, and to each of them its factors times terms.
#[derive(Clone, Debug, PartialEq)]
pub struct Sums {
    /// What is summed.
    pub name: &'static str,
    /// The constant of each entry.
    pub constants: Vec<f64>,
    /// Entry, term, and the factor with which the term is added.
    pub factors: Vec<(usize, usize, f64)>,
}

/// Pairs of rows that a loop goes over.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table {
    /// What they are of.
    pub name: &'static str,
    /// What the two numbers are.
    pub documentation: &'static str,
    /// The pairs.
    pub rows: Vec<[usize; 2]>,
}
