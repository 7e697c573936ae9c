//! A program ready to run: every operand a slot of one array, slots used again once their value is done with.

use abbe_codegen::expr::Symbol;
use abbe_codegen::program::{Action, Operand, Program};

/// A place among the values of a block.
pub(crate) type Slot = usize;

/// One operation: what it does with which slots.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Instruction {
    pub(crate) action: Action,
    pub(crate) a: Slot,
    pub(crate) b: Slot,
    pub(crate) c: Slot,
    pub(crate) result: Slot,
    /// Where a cosine goes that is computed with its sine.
    pub(crate) second: Slot,
}

/// A program ready to run.
///
/// Slots hold, in this order: the variables, parameters, inputs and generalized errors, the constants, and then
/// working values.
#[derive(Clone, Debug)]
pub(crate) struct Tape {
    pub(crate) instructions: Vec<Instruction>,
    pub(crate) constants: Vec<f64>,
    pub(crate) outputs: Vec<Slot>,
    pub(crate) slots: usize,
    symbols: [usize; 4],
}

impl Tape {
    /// Packs a program of a manipulator with so many variables, parameters, inputs and generalized errors.
    pub(crate) fn new(program: &Program, symbols: [usize; 4]) -> Self {
        let mut packer = Packer::new(program, symbols);
        let mut instructions = Vec::with_capacity(program.steps.len());
        for (at, step) in program.steps.iter().enumerate() {
            let mut operands = step.action.operands();
            let a = operands.next().map_or(0, |operand| packer.slot(operand));
            let b = operands.next().map_or(a, |operand| packer.slot(operand));
            let c = operands.next().map_or(b, |operand| packer.slot(operand));
            // Operands that end here make room for the result: each lane reads before it writes.
            packer.release(step.action, at);
            let result = packer.define(step.register, at);
            let second = match step.action {
                Action::SinCos(_) => packer.define(step.register + 1, at),
                _ => result,
            };
            instructions.push(Instruction { action: step.action, a, b, c, result, second });
        }
        let outputs = program.outputs.iter().map(|output| packer.slot(*output)).collect();
        Self { instructions, constants: packer.constants, outputs, slots: packer.slots, symbols }
    }

    /// How many slots the symbols take.
    pub(crate) fn symbol_slots(&self) -> usize {
        self.symbols.iter().sum()
    }
}

struct Packer {
    symbols: [usize; 4],
    constants: Vec<f64>,
    registers: Vec<Slot>,
    /// The last step that uses each register; outputs are used for ever.
    last_use: Vec<usize>,
    free: Vec<Slot>,
    slots: usize,
}

impl Packer {
    fn new(program: &Program, symbols: [usize; 4]) -> Self {
        let mut last_use = vec![0; program.registers];
        let mut constants: Vec<f64> = Vec::new();
        for (at, step) in program.steps.iter().enumerate() {
            for operand in step.action.operands() {
                match operand {
                    Operand::Register(register) => last_use[register] = at,
                    Operand::Constant(value) => add_constant(&mut constants, value),
                    Operand::Symbol(_) => {}
                }
            }
        }
        for output in &program.outputs {
            match *output {
                Operand::Register(register) => last_use[register] = usize::MAX,
                Operand::Constant(value) => add_constant(&mut constants, value),
                Operand::Symbol(_) => {}
            }
        }
        let slots = symbols.iter().sum::<usize>() + constants.len();
        Self { symbols, constants, registers: vec![0; program.registers], last_use, free: Vec::new(), slots }
    }

    fn slot(&self, operand: Operand) -> Slot {
        let [variables, parameters, inputs, errors] = self.symbols;
        match operand {
            Operand::Register(register) => self.registers[register],
            Operand::Symbol(Symbol::Variable(i)) => i,
            Operand::Symbol(Symbol::Parameter(i)) => variables + i,
            Operand::Symbol(Symbol::Input(i)) => variables + parameters + i,
            Operand::Symbol(Symbol::Error(i)) => variables + parameters + inputs + i,
            Operand::Constant(value) => {
                let place = self.constants.iter().position(|known| known.to_bits() == value.to_bits());
                variables + parameters + inputs + errors + place.expect("constants were collected")
            }
        }
    }

    fn release(&mut self, action: Action, at: usize) {
        let ends = |operand: Operand| match operand {
            Operand::Register(register) => (self.last_use[register] == at).then_some(register),
            _ => None,
        };
        let mut released: Vec<usize> = action.operands().filter_map(ends).collect();
        released.sort_unstable();
        released.dedup();
        self.free.extend(released.into_iter().map(|register| self.registers[register]));
    }

    fn define(&mut self, register: usize, at: usize) -> Slot {
        let slot = self.free.pop().unwrap_or_else(|| {
            self.slots += 1;
            self.slots - 1
        });
        self.registers[register] = slot;
        if self.last_use[register] <= at {
            // Half of a sine and cosine pair that nobody reads.
            self.free.push(slot);
        }
        slot
    }
}

fn add_constant(constants: &mut Vec<f64>, value: f64) {
    if !constants.iter().any(|known| known.to_bits() == value.to_bits()) {
        constants.push(value);
    }
}
