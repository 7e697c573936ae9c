//! Evaluates a tape over a block of lanes. Each operation runs for all lanes before the next one,
//! so that dispatch costs almost nothing.

use std::{cell::Cell, sync::Arc};

use abbe::Scalar;
use abbe::lanes::{Kernel, Lanes, Register, Tiles};
use abbe_codegen::program::Action;
use abbe_spec::expr::{Function, Lookup, Table};

use crate::operation::{Chain, Instruction, Link, LinkKind, Operation, Part, Slot, Tape};

/// Number of tiles of a batch that are evaluated together: enough to amortize dispatch, few enough
/// for all slots to fit in the cache.
const TILES: usize = 8;

/// Values of a block: for every slot a row of numbers, or of lanes of them.
#[derive(Debug)]
pub(crate) struct Block<'r, T, const N: usize> {
    rows: &'r mut [[T; N]],
}

impl<'r, T: Scalar, const N: usize> Block<'r, T, N> {
    /// Creates a block and sets the constants of a tape. `rows` must have a row for each slot;
    /// previous contents do not matter.
    #[inline(always)]
    pub(crate) fn new(tape: &Tape, rows: &'r mut [[T; N]]) -> Self {
        for (row, constant) in rows[tape.arguments..].iter_mut().zip(&tape.constants) {
            *row = [T::constant(*constant); N];
        }
        Self { rows }
    }

    /// Sets the value of a slot at one position of the row.
    #[inline(always)]
    pub(crate) fn set(&mut self, slot: usize, place: usize, value: T) {
        self.rows[slot][place] = value;
    }

    /// Returns the value of a slot at one position of the row.
    #[inline(always)]
    pub(crate) fn value(&self, slot: Slot, place: usize) -> T {
        self.rows[slot][place]
    }

    /// Runs the tape over the whole row. Positions that have not been set keep their previous
    /// contents.
    #[inline(always)]
    pub(crate) fn run(&mut self, tape: &Tape) {
        for part in &tape.parts {
            match part {
                Part::Move(moves) => self.moves(moves),
                Part::Sum { constants, factors } => {
                    for (slot, constant) in constants {
                        self.rows[*slot] = [T::constant(*constant); N];
                    }
                    for (slot, term, factor) in factors {
                        for place in 0..N {
                            let (term, sum) = (self.rows[*term][place], self.rows[*slot][place]);
                            self.rows[*slot][place] = term.mul_add(T::constant(*factor), sum);
                        }
                    }
                }
                Part::Program { turns, body, while_positive } => {
                    for turn in turns {
                        self.moves(&turn.reads);
                        self.operations(body, &tape.tables);
                        self.moves(&turn.writes);
                        let goes_on = |slot: Slot| self.rows[slot].iter().any(|value| value.is_positive());
                        if !while_positive.is_none_or(goes_on) {
                            break;
                        }
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn moves(&mut self, moves: &[[Slot; 2]]) {
        for [from, to] in moves {
            self.rows[*to] = self.rows[*from];
        }
    }

    #[inline(always)]
    fn operations(&mut self, operations: &[Operation], tables: &[Arc<Table>]) {
        for operation in operations {
            let instruction = match operation {
                Operation::One(instruction) => instruction,
                Operation::Chain(chain) => {
                    self.chain(chain);
                    continue;
                }
            };
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
                Action::Call(function, _) => match function {
                    Function::Sin => self.map(instruction, |a, _, _| a.sin()),
                    Function::Cos => self.map(instruction, |a, _, _| a.cos()),
                    Function::Sqrt => self.map(instruction, |a, _, _| a.sqrt()),
                    Function::Abs => self.map(instruction, |a, _, _| a.abs()),
                    // Evaluated number by number anyway, so that a call costs nothing extra.
                    Function::Exp => self.by_call(instruction, |a, _, _| a.exp()),
                    Function::Log => self.by_call(instruction, |a, _, _| a.ln()),
                    Function::Side => self.by_call(instruction, |a, _, _| a.side()),
                    Function::Sign => self.by_call(instruction, |a, _, _| a.sign()),
                    Function::Tan => self.by_call(instruction, |a, _, _| a.tan()),
                    Function::Asin => self.by_call(instruction, |a, _, _| a.asin()),
                    Function::Acos => self.by_call(instruction, |a, _, _| a.acos()),
                    Function::Atan => self.by_call(instruction, |a, _, _| a.atan()),
                },
                Action::Min(..) => self.map(instruction, |a, b, _| a.min(b)),
                Action::Max(..) => self.map(instruction, |a, b, _| a.max(b)),
                Action::Lookup(Lookup { table, order }, _) => {
                    let table = tables[usize::from(table)].lookup();
                    match order {
                        0 => self.map(instruction, |x, _, _| table.value(x)),
                        order => self.map(instruction, |x, _, _| table.derivative(order.into(), x)),
                    }
                }
                Action::Pow(..) => self.by_call(instruction, |a, b, _| a.powf(b)),
                Action::Atan2(..) => self.by_call(instruction, |a, b, _| a.atan2(b)),
            }
        }
    }

    /// Runs a chain, with all intermediate values in registers.
    #[inline(always)]
    fn chain(&mut self, chain: &Chain) {
        let mut values = self.rows[chain.start];
        for link in &chain.links {
            match link.kind {
                LinkKind::Negated => self.link(link, &mut values, |v, _, _| -v),
                LinkKind::Plus => self.link(link, &mut values, |v, a, _| v + a),
                LinkKind::Minus => self.link(link, &mut values, |v, a, _| v - a),
                LinkKind::From => self.link(link, &mut values, |v, a, _| a - v),
                LinkKind::Times => self.link(link, &mut values, |v, a, _| v * a),
                LinkKind::PlusProduct => self.link(link, &mut values, |v, a, b| a.mul_add(b, v)),
                LinkKind::MinusProduct => self.link(link, &mut values, |v, a, b| a.neg_mul_add(b, v)),
                LinkKind::FromProduct => self.link(link, &mut values, |v, a, b| a.mul_sub(b, v)),
                LinkKind::TimesPlus => self.link(link, &mut values, |v, a, b| v.mul_add(a, b)),
                LinkKind::TimesMinus => self.link(link, &mut values, |v, a, b| v.mul_sub(a, b)),
                LinkKind::FromTimes => self.link(link, &mut values, |v, a, b| v.neg_mul_add(a, b)),
            }
        }
        self.rows[chain.result] = values;
    }

    #[inline(always)]
    fn link(&self, link: &Link, values: &mut [T; N], f: impl Fn(T, T, T) -> T) {
        let (a, b) = (&self.rows[link.a], &self.rows[link.b]);
        for place in 0..N {
            values[place] = f(values[place], a[place], b[place]);
        }
    }

    #[inline(never)]
    fn by_call(&mut self, instruction: &Instruction, f: impl Fn(T, T, T) -> T) {
        self.map(instruction, f);
    }

    // Loops instead of adapters, which might be compiled without the instruction set.
    #[inline(always)]
    fn map(&mut self, instruction: &Instruction, f: impl Fn(T, T, T) -> T) {
        // The result may overwrite an operand: each position is read before it is written.
        let Instruction { a, b, c, result, .. } = *instruction;
        for place in 0..N {
            self.rows[result][place] = f(self.rows[a][place], self.rows[b][place], self.rows[c][place]);
        }
    }

    #[inline(always)]
    fn sin_cos(&mut self, instruction: &Instruction) {
        let Instruction { a, result, second, .. } = *instruction;
        for place in 0..N {
            (self.rows[result][place], self.rows[second][place]) = self.rows[a][place].sin_cos();
        }
    }
}

thread_local! {
    /// Reused buffers: allocating new ones would take as long as a short batch.
    static ROWS: Cell<Tiles> = Cell::new(Tiles::default());
}

/// A tape, its arguments and its results.
pub(crate) struct Batch<'a> {
    pub(crate) tape: &'a Tape,
    pub(crate) arguments: &'a Tiles,
    pub(crate) results: &'a mut Tiles,
}

impl Kernel for Batch<'_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Register>(mut self) {
        let set = self.arguments.instruction_set();
        let mut rows = ROWS.take();
        rows.reshape(set, TILES * self.tape.slots, set.width());
        let lanes = rows.tile_mut::<R>(0);
        // The remainder is evaluated in smaller groups.
        let done = self.tiles::<R, TILES>(0, lanes);
        let done = self.tiles::<R, 2>(done, lanes);
        self.tiles::<R, 1>(done, lanes);
        ROWS.set(rows);
    }
}

impl Batch<'_> {
    /// Evaluates N tiles at a time, starting at `first`, and returns the first remaining tile.
    #[inline(always)]
    fn tiles<R: Register, const N: usize>(&mut self, first: usize, lanes: &mut [Lanes<R>]) -> usize {
        let Self { tape, arguments, results } = self;
        let end = first + (arguments.tiles() - first) / N * N;
        if end == first {
            return first;
        }
        let (rows, _) = lanes.as_chunks_mut();
        let mut block = Block::<Lanes<R>, N>::new(tape, rows);
        for first in (first..end).step_by(N) {
            for place in 0..N {
                for (slot, value) in arguments.tile::<R>(first + place).iter().enumerate() {
                    block.set(slot, place, *value);
                }
            }
            block.run(tape);
            for place in 0..N {
                for (result, slot) in results.tile_mut::<R>(first + place).iter_mut().zip(&tape.outputs) {
                    *result = block.value(*slot, place);
                }
            }
        }
        end
    }
}
