//! Routines: functions as arrays, and stages that read and write their rows, independent of a
//! language.
//!
//! A stage is a straight-line [`Program`], executed once or for every frame, a call of another
//! routine, or a table of sums. Most functions are one program that reads the arguments as symbols
//! and writes whole results.

use abbe_core::{Description, Function, function::Count};

use super::{Operations, Program};

/// A function, or a helper that several functions call.
#[derive(Clone, Debug, PartialEq)]
pub struct Routine {
    /// The function; `None` for a helper.
    pub function: Option<Function>,
    /// Name of the routine.
    pub name: &'static str,
    /// Documentation of the routine.
    pub documentation: &'static str,
    /// Arguments and results in the order of the function's signature, then the margin, then local
    /// arrays.
    pub arrays: Vec<Array>,
    /// Stages in order of execution.
    pub stages: Vec<Stage>,
    /// Operations of one call.
    pub operations: Operations,
}

/// An array of numbers of a routine.
#[derive(Clone, Debug, PartialEq)]
pub struct Array {
    /// Name of the array.
    pub name: &'static str,
    /// Dimensions, the outermost first.
    pub shape: Vec<Count>,
    /// Role of the array.
    pub role: Role,
}

/// Role of an array in a routine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Argument.
    Argument,
    /// Result.
    Result,
    /// One number, `cos ρ`, that is returned.
    Margin,
    /// Local array, initialized with zeros.
    Zeros,
}

/// A part of a routine.
#[derive(Clone, Debug, PartialEq)]
pub enum Stage {
    /// A program, executed once or in a loop.
    Block(Block),
    /// A call of another routine.
    Call {
        /// Name of the called routine.
        routine: &'static str,
        /// Arguments, results and margin of the call: indices of this routine's arrays.
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
    /// Fills an array with zeros.
    Clear(usize),
    /// Copies rows of an array to another one.
    Copy {
        /// The rows to copy.
        from: ArrayRows,
        /// Index of the array that is filled.
        to: usize,
    },
}

/// A program that reads rows of arrays and writes rows of arrays. All reads precede all writes.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// Rows that give the program's local symbols, in order.
    pub reads: Vec<ArrayRows>,
    /// The program.
    pub program: Program,
    /// Rows that take its outputs, in order.
    pub writes: Vec<ArrayRows>,
    /// The loop; `None` to execute once.
    pub repeated: Option<Repeated>,
}

/// A loop over rows, ascending or descending.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Repeated {
    /// Number of iterations.
    pub count: Count,
    /// `true` to start with the last row.
    pub backwards: bool,
    /// Index of a local array whose first number ends the loop after an iteration that leaves it
    /// zero, negative or NaN.
    pub while_positive: Option<usize>,
}

/// Rows of an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ArrayRows {
    /// Index of the array.
    pub array: usize,
    /// Selection of its rows.
    pub row: Row,
}

/// Selection of rows. A row of an array of poses is a pose; a row of any other array is its
/// innermost dimension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Row {
    /// Every row.
    All,
    /// The first row.
    First,
    /// The last row.
    Last,
    /// Every row except the first.
    AllButFirst,
    /// Row `stride · i + offset` for the loop counter i.
    Each {
        /// Number of rows per iteration.
        stride: usize,
        /// Index within the iteration.
        offset: usize,
    },
    /// The row listed in row i of a table.
    Listed {
        /// Index of the table.
        table: usize,
        /// Column of the table, 0 or 1.
        column: usize,
    },
}

impl Routine {
    /// Iterates over the programs of the routine.
    pub fn programs(&self) -> impl Iterator<Item = &Program> {
        self.stages.iter().filter_map(|stage| match stage {
            Stage::Block(block) => Some(&block.program),
            _ => None,
        })
    }

    /// Returns the number of stages that write an array.
    pub fn writes(&self, array: usize) -> usize {
        self.stages.iter().filter(|stage| stage.writes(array)).count()
    }
}

impl Stage {
    /// Returns `true` if the stage writes an array, or passes it to another routine.
    pub fn writes(&self, array: usize) -> bool {
        match self {
            Self::Block(block) => block.writes.iter().any(|place| place.array == array),
            Self::Call { arrays, .. } => arrays.contains(&array),
            Self::Sums { entries: filled, .. } | Self::Copy { to: filled, .. } | Self::Clear(filled) => {
                *filled == array
            }
        }
    }
}

impl Block {
    /// Returns `true` if the rows are the same in every iteration of the loop.
    pub fn is_constant(&self, place: &ArrayRows) -> bool {
        let is_written = self.writes.iter().any(|written| written.array == place.array);
        self.repeated.is_some() && matches!(place.row, Row::All | Row::First | Row::Last) && !is_written
    }
}

impl ArrayRows {
    /// Selects the whole array.
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
    /// Returns the number of dimensions that make up a row.
    pub fn row_rank(&self) -> usize {
        if self.shape.ends_with(&[Count::Exactly(4), Count::Exactly(3)]) { 2 } else { 1 }
    }

    /// Returns the number of elements.
    pub fn len(&self, description: &Description) -> usize {
        product(&self.shape, description)
    }

    /// Returns `true` if the array has no elements.
    pub fn is_empty(&self, description: &Description) -> bool {
        self.len(description) == 0
    }

    /// Returns the number of elements in a row.
    pub fn row_len(&self, description: &Description) -> usize {
        product(&self.shape[self.shape.len() - self.row_rank()..], description)
    }

    /// Returns the number of elements that a selection has. In a one-dimensional array a single row
    /// is one element.
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

/// Sums: a constant for each entry plus factors times terms.
#[derive(Clone, Debug, PartialEq)]
pub struct Sums {
    /// Name of the sums.
    pub name: &'static str,
    /// Constant of each entry.
    pub constants: Vec<f64>,
    /// Entry, term, and factor of the term.
    pub factors: Vec<(usize, usize, f64)>,
}

/// Pairs of row indices for a loop.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table {
    /// Name of the table.
    pub name: &'static str,
    /// Documentation of the two numbers.
    pub documentation: &'static str,
    /// The pairs.
    pub rows: Vec<[usize; 2]>,
}
