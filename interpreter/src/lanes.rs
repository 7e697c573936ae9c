//! Evaluates a tape over a block of lanes: each operation for all lanes before the next one, so that choosing
//! the operation costs next to nothing.

use abbe::Scalar;
use abbe_codegen::expr::Function;
use abbe_codegen::program::Action;

use crate::tape::{Instruction, Slot, Tape};

/// How many configurations of a batch are evaluated together: enough to hide the choice of an operation, few
/// enough for all slots to stay in the cache.
pub(crate) const LANES: usize = 32;

/// The values of a block: a row of lanes for every slot.
#[derive(Clone, Debug)]
pub(crate) struct Block<const N: usize> {
    rows: Vec<[f64; N]>,
}

impl<const N: usize> Block<N> {
    /// Room for a tape, with its constants in place.
    pub(crate) fn new(tape: &Tape) -> Self {
        let mut rows = vec![[0.0; N]; tape.slots];
        for (row, constant) in rows[tape.symbol_slots()..].iter_mut().zip(&tape.constants) {
            *row = [*constant; N];
        }
        Self { rows }
    }

    /// Sets the symbol of that slot in one lane.
    pub(crate) fn set(&mut self, slot: usize, lane: usize, value: f64) {
        self.rows[slot][lane] = value;
    }

    /// Runs the tape over all lanes; those that nobody set hold what they held.
    pub(crate) fn run(&mut self, tape: &Tape) {
        for instruction in &tape.instructions {
            self.step(instruction);
        }
    }

    /// The value of a slot in one lane.
    pub(crate) fn value(&self, slot: Slot, lane: usize) -> f64 {
        self.rows[slot][lane]
    }

    fn step(&mut self, instruction: &Instruction) {
        let Instruction { action, .. } = *instruction;
        match action {
            Action::Neg(_) => self.map(instruction, |a, _| -a),
            Action::Add(..) => self.map(instruction, |a, b| a + b),
            Action::Sub(..) => self.map(instruction, |a, b| a - b),
            Action::Mul(..) => self.map(instruction, |a, b| a * b),
            Action::MulAdd(..) => self.map3(instruction, Scalar::mul_add),
            Action::MulSub(..) => self.map3(instruction, Scalar::mul_sub),
            Action::NegMulAdd(..) => self.map3(instruction, Scalar::neg_mul_add),
            Action::Div(..) => self.map(instruction, |a, b| a / b),
            Action::Pow(..) => self.map(instruction, Scalar::powf),
            Action::Atan2(..) => self.map(instruction, Scalar::atan2),
            Action::SinCos(_) => self.sin_cos(instruction),
            Action::Call(function, _) => match function {
                Function::Sin => self.map(instruction, |a, _| Scalar::sin(a)),
                Function::Cos => self.map(instruction, |a, _| Scalar::cos(a)),
                Function::Tan => self.map(instruction, |a, _| Scalar::tan(a)),
                Function::Asin => self.map(instruction, |a, _| Scalar::asin(a)),
                Function::Acos => self.map(instruction, |a, _| Scalar::acos(a)),
                Function::Atan => self.map(instruction, |a, _| Scalar::atan(a)),
                Function::Sqrt => self.map(instruction, |a, _| Scalar::sqrt(a)),
                Function::Abs => self.map(instruction, |a, _| Scalar::abs(a)),
                Function::Sign => self.map(instruction, |a, _| Scalar::sign(a)),
            },
        }
    }

    #[inline(always)]
    fn map(&mut self, instruction: &Instruction, f: impl Fn(f64, f64) -> f64) {
        // The result may take the place of an operand: it is put there when it is complete.
        let (a, b) = (&self.rows[instruction.a], &self.rows[instruction.b]);
        let result = std::array::from_fn(|lane| f(a[lane], b[lane]));
        self.rows[instruction.result] = result;
    }

    #[inline(always)]
    fn map3(&mut self, instruction: &Instruction, f: impl Fn(f64, f64, f64) -> f64) {
        let (a, b, c) = (&self.rows[instruction.a], &self.rows[instruction.b], &self.rows[instruction.c]);
        let result = std::array::from_fn(|lane| f(a[lane], b[lane], c[lane]));
        self.rows[instruction.result] = result;
    }

    fn sin_cos(&mut self, instruction: &Instruction) {
        let pairs = self.rows[instruction.a].map(Scalar::sin_cos);
        self.rows[instruction.result] = pairs.map(|(sine, _)| sine);
        self.rows[instruction.second] = pairs.map(|(_, cosine)| cosine);
    }
}
