//! Evaluates a tape over a block of lanes: each operation for all lanes before the next one, so that choosing
//! the operation costs next to nothing.

use abbe::Scalar;
use abbe::lanes::{Kernel, Lanes, Register, Tiles};
use abbe_codegen::expr::Function;
use abbe_codegen::program::Action;

use crate::tape::{Instruction, Slot, Tape};

/// How many tiles of a batch are evaluated together: enough to hide the choice of an operation, few enough for
/// all slots to stay in the cache.
const TILES: usize = 8;

/// The values of a block: a row of numbers, or of lanes of them, for every slot.
#[derive(Clone, Debug)]
pub(crate) struct Block<T, const N: usize> {
    rows: Vec<[T; N]>,
}

impl<T: Scalar, const N: usize> Block<T, N> {
    /// Room for a tape, with its constants in place.
    #[inline(always)]
    pub(crate) fn new(tape: &Tape) -> Self {
        let mut rows = vec![[T::constant(0.0); N]; tape.slots];
        for (row, constant) in rows[tape.symbol_slots()..].iter_mut().zip(&tape.constants) {
            *row = [T::constant(*constant); N];
        }
        Self { rows }
    }

    /// Sets the symbol of that slot in one place of the row.
    #[inline(always)]
    pub(crate) fn set(&mut self, slot: usize, place: usize, value: T) {
        self.rows[slot][place] = value;
    }

    /// The value of a slot in one place of the row.
    #[inline(always)]
    pub(crate) fn value(&self, slot: Slot, place: usize) -> T {
        self.rows[slot][place]
    }

    /// Runs the tape over the whole row; places that nobody set hold what they held.
    #[inline(always)]
    pub(crate) fn run(&mut self, tape: &Tape) {
        for instruction in &tape.instructions {
            match instruction.action {
                Action::Neg(_) => self.map(instruction, |a, _, _| -a),
                Action::Add(..) => self.map(instruction, |a, b, _| a + b),
                Action::Sub(..) => self.map(instruction, |a, b, _| a - b),
                Action::Mul(..) => self.map(instruction, |a, b, _| a * b),
                Action::MulAdd(..) => self.map(instruction, Scalar::mul_add),
                Action::MulSub(..) => self.map(instruction, Scalar::mul_sub),
                Action::NegMulAdd(..) => self.map(instruction, Scalar::neg_mul_add),
                Action::Div(..) => self.map(instruction, |a, b, _| a / b),
                Action::SinCos(_) => self.sin_cos(instruction),
                Action::Call(Function::Sqrt, _) => self.map(instruction, |a, _, _| a.sqrt()),
                _ => self.rare(instruction),
            }
        }
    }

    /// What takes so long by itself that nothing is lost by a call.
    #[inline(never)]
    fn rare(&mut self, instruction: &Instruction) {
        match instruction.action {
            Action::Pow(..) => self.map(instruction, |a, b, _| a.powf(b)),
            Action::Atan2(..) => self.map(instruction, |a, b, _| a.atan2(b)),
            Action::Call(function, _) => match function {
                Function::Sin => self.map(instruction, |a, _, _| a.sin()),
                Function::Cos => self.map(instruction, |a, _, _| a.cos()),
                Function::Tan => self.map(instruction, |a, _, _| a.tan()),
                Function::Asin => self.map(instruction, |a, _, _| a.asin()),
                Function::Acos => self.map(instruction, |a, _, _| a.acos()),
                Function::Atan => self.map(instruction, |a, _, _| a.atan()),
                Function::Sqrt => self.map(instruction, |a, _, _| a.sqrt()),
                Function::Abs => self.map(instruction, |a, _, _| a.abs()),
                Function::Sign => self.map(instruction, |a, _, _| a.sign()),
            },
            _ => unreachable!("`run` does the others"),
        }
    }

    #[inline(always)]
    fn map(&mut self, instruction: &Instruction, f: impl Fn(T, T, T) -> T) {
        // The result may take the place of an operand: it is put there when it is complete.
        let Instruction { a, b, c, .. } = *instruction;
        let (a, b, c) = (&self.rows[a], &self.rows[b], &self.rows[c]);
        let mut result = *a;
        for (place, result) in result.iter_mut().enumerate() {
            *result = f(a[place], b[place], c[place]);
        }
        self.rows[instruction.result] = result;
    }

    #[inline(always)]
    fn sin_cos(&mut self, instruction: &Instruction) {
        let angles = self.rows[instruction.a];
        let (mut sines, mut cosines) = (angles, angles);
        for (place, angle) in angles.into_iter().enumerate() {
            (sines[place], cosines[place]) = angle.sin_cos();
        }
        self.rows[instruction.result] = sines;
        self.rows[instruction.second] = cosines;
    }
}

/// A tape and what it is to be run over.
pub(crate) struct Batch<'a> {
    pub(crate) tape: &'a Tape,
    pub(crate) arguments: &'a Tiles,
    pub(crate) results: &'a mut Tiles,
}

impl Kernel for Batch<'_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Register>(self) {
        let Self { tape, arguments, results } = self;
        let mut block = Block::<Lanes<R>, TILES>::new(tape);
        let tiles = arguments.tiles();
        for first in (0..tiles).step_by(TILES) {
            let here = TILES.min(tiles - first);
            for place in 0..here {
                for (slot, value) in arguments.tile::<R>(first + place).iter().enumerate() {
                    block.set(slot, place, *value);
                }
            }
            block.run(tape);
            for place in 0..here {
                let rows = results.tile_mut::<R>(first + place);
                for (result, slot) in rows.iter_mut().zip(&tape.outputs) {
                    *result = block.value(*slot, place);
                }
            }
        }
    }
}
