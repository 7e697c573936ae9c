//! Tapes: functions whose operands are all slots of one array.

use std::sync::Arc;

use abbe_spec::expr::Table;

use crate::operation::{Operation, Slot};

/// A part of a tape.
#[derive(Clone, Debug)]
pub(crate) enum Part {
    /// Copies values between slots.
    Move(Vec<[Slot; 2]>),
    /// Computes sums: constants first, then slot, term and factor.
    Sum { constants: Vec<(Slot, f64)>, factors: Vec<(Slot, Slot, f64)> },
    /// In every iteration, copies the reads, runs the operations, and copies the writes. A program
    /// outside of loops has one iteration.
    Program {
        turns: Vec<Turn>,
        body: Vec<Operation>,
        /// Slot that ends the loop where no position of it is positive.
        while_positive: Option<Slot>,
    },
}

/// One iteration of a loop.
#[derive(Clone, Debug, Default)]
pub(crate) struct Turn {
    pub(crate) reads: Vec<[Slot; 2]>,
    pub(crate) writes: Vec<[Slot; 2]>,
}

/// A function ready to run.
///
/// The slots are the arguments, then the constants, and then arrays and temporary values.
#[derive(Clone, Debug)]
pub(crate) struct Tape {
    pub(crate) parts: Vec<Part>,
    pub(crate) constants: Vec<f64>,
    pub(crate) tables: Vec<Arc<Table>>,
    pub(crate) outputs: Vec<Slot>,
    pub(crate) slots: usize,
    /// Number of slots of the arguments.
    pub(crate) arguments: usize,
}
