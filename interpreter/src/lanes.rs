//! Evaluates a tape over a block of lanes: each operation for all lanes before the next one, so that choosing
//! the operation costs next to nothing.

use abbe::Scalar;
use abbe_codegen::expr::Function;
use abbe_codegen::program::Action;

use crate::tape::{Instruction, Tape};

/// How many configurations are evaluated together.
pub(crate) const LANES: usize = 64;

type Lanes = [f64; LANES];

/// The values of a block: a row of lanes for every slot.
#[derive(Clone, Debug)]
pub(crate) struct Block {
    rows: Vec<Lanes>,
}

impl Block {
    /// Room for a tape, with its constants in place.
    pub(crate) fn new(tape: &Tape) -> Self {
        let mut rows = vec![[0.0; LANES]; tape.slots];
        for (row, constant) in rows[tape.symbol_slots()..].iter_mut().zip(&tape.constants) {
            *row = [*constant; LANES];
        }
        Self { rows }
    }

    /// Sets the symbol of that slot in one lane.
    pub(crate) fn set(&mut self, slot: usize, lane: usize, value: f64) {
        self.rows[slot][lane] = value;
    }

    /// Runs the tape over the first `lanes` lanes.
    pub(crate) fn run(&mut self, tape: &Tape, lanes: usize) {
        for instruction in &tape.instructions {
            self.step(instruction, lanes);
        }
    }

    /// The values of one output of a tape, lane by lane.
    pub(crate) fn output(&self, tape: &Tape, output: usize) -> &Lanes {
        &self.rows[tape.outputs[output]]
    }

    fn step(&mut self, instruction: &Instruction, lanes: usize) {
        let Instruction { action, .. } = *instruction;
        match action {
            Action::Neg(_) => self.map(instruction, lanes, |a, _| -a),
            Action::Add(..) => self.map(instruction, lanes, |a, b| a + b),
            Action::Sub(..) => self.map(instruction, lanes, |a, b| a - b),
            Action::Mul(..) => self.map(instruction, lanes, |a, b| a * b),
            Action::Div(..) => self.map(instruction, lanes, |a, b| a / b),
            Action::Pow(..) => self.map(instruction, lanes, Scalar::powf),
            Action::Atan2(..) => self.map(instruction, lanes, Scalar::atan2),
            Action::SinCos(_) => self.sin_cos(instruction, lanes),
            Action::Call(function, _) => match function {
                Function::Sin => self.map(instruction, lanes, |a, _| Scalar::sin(a)),
                Function::Cos => self.map(instruction, lanes, |a, _| Scalar::cos(a)),
                Function::Tan => self.map(instruction, lanes, |a, _| Scalar::tan(a)),
                Function::Asin => self.map(instruction, lanes, |a, _| Scalar::asin(a)),
                Function::Acos => self.map(instruction, lanes, |a, _| Scalar::acos(a)),
                Function::Atan => self.map(instruction, lanes, |a, _| Scalar::atan(a)),
                Function::Sqrt => self.map(instruction, lanes, |a, _| Scalar::sqrt(a)),
                Function::Abs => self.map(instruction, lanes, |a, _| Scalar::abs(a)),
                Function::Sign => self.map(instruction, lanes, |a, _| Scalar::sign(a)),
            },
        }
    }

    #[inline(always)]
    fn map(&mut self, instruction: &Instruction, lanes: usize, f: impl Fn(f64, f64) -> f64) {
        // A copy of the operands, small beside the work, makes the loop free of overlaps.
        let (a, b) = (self.rows[instruction.a], self.rows[instruction.b]);
        let result = &mut self.rows[instruction.result];
        let pairs = a[..lanes].iter().zip(&b[..lanes]);
        for (result, (a, b)) in result[..lanes].iter_mut().zip(pairs) {
            *result = f(*a, *b);
        }
    }

    fn sin_cos(&mut self, instruction: &Instruction, lanes: usize) {
        let angles = self.rows[instruction.a];
        for (lane, angle) in angles[..lanes].iter().enumerate() {
            let (sine, cosine) = Scalar::sin_cos(*angle);
            self.rows[instruction.result][lane] = sine;
            self.rows[instruction.second][lane] = cosine;
        }
    }
}
