//! A function ready to run: every operand is a slot of one array.

use std::sync::Arc;

use abbe_spec::expr::Table;

use crate::operation::{Operation, Slot};

/// A part of a tape.
#[derive(Clone, Debug)]
pub(crate) enum Part {
    /// Values go to other slots.
    Move(Vec<[Slot; 2]>),
    /// Slots become sums: constants, and then slot, term and factor.
    Sum { constants: Vec<(Slot, f64)>, factors: Vec<(Slot, Slot, f64)> },
    /// For every turn, what is read comes to its slots, the instructions run, and what is written goes where it belongs;
    /// what is no loop has one turn.
    Program { turns: Vec<Turn>, body: Vec<Operation> },
}

/// One turn of a loop.
#[derive(Clone, Debug, Default)]
pub(crate) struct Turn {
    pub(crate) reads: Vec<[Slot; 2]>,
    pub(crate) writes: Vec<[Slot; 2]>,
}

/// A function ready to run.
///
/// Slots hold, in this order: the arguments, the constants, and then arrays and working values.
#[derive(Clone, Debug)]
pub(crate) struct Tape {
    pub(crate) parts: Vec<Part>,
    pub(crate) constants: Vec<f64>,
    pub(crate) tables: Vec<Arc<Table>>,
    pub(crate) outputs: Vec<Slot>,
    pub(crate) slots: usize,
    /// How many slots the arguments take.
    pub(crate) arguments: usize,
}
