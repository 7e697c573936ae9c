//! Packs a function into a tape; slots are reused after the last use of their value.

use std::collections::{HashMap, HashSet};

use abbe_codegen::program::{Action, Block, Operand, Program, Role, Routine, Routines, Row, Stage, Step};
use abbe_spec::expr::Symbol;

use crate::operation::{Operation, Part, Slot, Tape, Turn, chains};

impl Tape {
    /// Packs a routine, which may call those of `routines`. Arguments and results are concatenated,
    /// and the margin is last.
    pub(crate) fn new(routines: &Routines, routine: &Routine) -> Self {
        let given = routine.arrays.iter().filter(|array| array.role == Role::Argument);
        let arguments = given.map(|array| array.len(&routines.description)).sum();
        let mut constants = Constants::default();
        constants.add(0.0);
        constants.add(1.0);
        constants.collect(routines, routine);
        let slots = arguments + constants.values.len();
        let mut packer =
            Packer { routines, arguments, constants, free: Vec::new(), slots, parts: Vec::new() };
        let mut first = 0;
        let mut places: Vec<Vec<Slot>> = Vec::new();
        for array in routine.arrays.iter().filter(|array| array.role == Role::Argument) {
            let next = first + array.len(&routines.description);
            places.push((first..next).collect());
            first = next;
        }
        let outputs = packer.routine(routine, places).concat();
        let Packer { parts, constants, slots, .. } = packer;
        let tables = routines.lookup_tables.clone();
        Self { parts, constants: constants.values, tables, outputs, slots, arguments }
    }
}

/// Constants of programs without duplicates, indexed by their bits.
#[derive(Default)]
struct Constants {
    values: Vec<f64>,
    places: HashMap<u64, usize>,
}

impl Constants {
    fn add(&mut self, value: f64) {
        self.places.entry(value.to_bits()).or_insert_with(|| {
            self.values.push(value);
            self.values.len() - 1
        });
    }

    /// Collects all constants in the programs of a routine and of those that it calls.
    fn collect(&mut self, routines: &Routines, routine: &Routine) {
        let mut add = |operand: Operand| {
            if let Operand::Constant(value) = operand {
                self.add(value);
            }
        };
        for stage in &routine.stages {
            if let Stage::Block(Block { program, .. }) = stage {
                program.steps.iter().flat_map(|step| step.action.operands()).for_each(&mut add);
                program.outputs.iter().copied().for_each(&mut add);
            }
        }
        for stage in &routine.stages {
            if let Stage::Call { routine, .. } = stage {
                self.collect(routines, routines.named(routine));
            }
        }
    }
}

struct Packer<'r> {
    routines: &'r Routines,
    arguments: usize,
    constants: Constants,
    free: Vec<Slot>,
    slots: usize,
    parts: Vec<Part>,
}

/// Arrays of a routine and their slots.
struct Arrays<'r> {
    routine: &'r Routine,
    places: Vec<Vec<Slot>>,
}

impl<'r> Packer<'r> {
    /// Appends a routine with arguments in these slots, and returns the slots of its results, the
    /// margin last.
    fn routine(&mut self, routine: &'r Routine, arguments: Vec<Vec<Slot>>) -> Vec<Vec<Slot>> {
        let mut arrays = Arrays { routine, places: arguments };
        for array in &routine.arrays[arrays.places.len()..] {
            let count = array.len(&self.routines.description);
            let index = arrays.places.len();
            // An array that is filled once, completely, uses the slots of its values.
            let is_alias = self.is_filled_once(routine, index);
            let slots: Vec<Slot> = match is_alias {
                true => Vec::new(),
                false => (0..count).map(|_| self.new_slot()).collect(),
            };
            if array.role == Role::Zeros && !is_alias {
                self.set(slots.iter().map(|slot| (*slot, 0.0)).collect());
            }
            arrays.places.push(slots);
        }
        for stage in &routine.stages {
            self.stage(stage, &mut arrays);
        }
        let is_result = |(index, _): &(usize, &Vec<Slot>)| {
            matches!(routine.arrays[*index].role, Role::Result | Role::Margin)
        };
        arrays.places.iter().enumerate().filter(is_result).map(|(_, slots)| slots.clone()).collect()
    }

    fn is_filled_once(&self, routine: &Routine, array: usize) -> bool {
        let at_once = |stage: &Stage| match stage {
            Stage::Block(block) => {
                let place = |place: &&abbe_codegen::program::ArrayRows| place.array == array;
                block.repeated.is_none()
                    && block.writes.iter().find(place).is_some_and(|place| place.row == Row::All)
            }
            Stage::Call { arrays, .. } => arrays.contains(&array),
            _ => false,
        };
        routine.writes(array) == 1 && routine.stages.iter().any(at_once)
    }

    /// Sets slots to constants.
    fn set(&mut self, constants: Vec<(Slot, f64)>) {
        self.parts.push(Part::Sum { constants, factors: Vec::new() });
    }

    /// Copies values to an array, or makes the array an alias of their slots.
    fn fill(&mut self, arrays: &mut Arrays<'_>, array: usize, from: &[Slot]) {
        if arrays.places[array].is_empty() {
            arrays.places[array] = from.to_vec();
        } else {
            let to = arrays.places[array].clone();
            let mut from = from.to_vec();
            let written: HashSet<Slot> = to.iter().copied().collect();
            if from.iter().any(|slot| written.contains(slot)) {
                // Every read precedes every write.
                let between: Vec<Slot> = from.iter().map(|_| self.new_slot()).collect();
                self.parts.push(Part::Move(from.iter().zip(&between).map(|(a, b)| [*a, *b]).collect()));
                from = between;
            }
            self.parts.push(Part::Move(from.iter().zip(&to).map(|(from, to)| [*from, *to]).collect()));
        }
    }

    fn stage(&mut self, stage: &'r Stage, arrays: &mut Arrays<'r>) {
        match stage {
            Stage::Block(block) if block.repeated.is_none() => self.block(block, arrays),
            Stage::Block(block) => self.repeated(block, arrays),
            Stage::Call { routine, arrays: called } => {
                let callee = self.routines.named(routine);
                let is_given = |index: &usize| callee.arrays[*index].role == Role::Argument;
                let (given, filled): (Vec<usize>, Vec<usize>) = (0..called.len()).partition(is_given);
                let arguments = given.iter().map(|index| arrays.places[called[*index]].clone()).collect();
                for (index, slots) in filled.iter().zip(self.routine(callee, arguments)) {
                    self.fill(arrays, called[*index], &slots);
                }
            }
            Stage::Sums { sums, terms, entries } => {
                let sums = &self.routines.sums[*sums];
                let (terms, entries) = (&arrays.places[*terms], &arrays.places[*entries]);
                let constants = entries.iter().copied().zip(sums.constants.iter().copied()).collect();
                let factor =
                    |(entry, term, factor): &(usize, usize, f64)| (entries[*entry], terms[*term], *factor);
                let factors = sums.factors.iter().map(factor).collect();
                self.parts.push(Part::Sum { constants, factors });
            }
            Stage::Copy { from, to } => {
                let from = self.row(arrays, from.array, from.row, 0);
                let to = arrays.places[*to].iter().copied();
                self.parts.push(Part::Move(from.into_iter().zip(to).map(|(from, to)| [from, to]).collect()));
            }
            Stage::Clear(array) => {
                self.set(arrays.places[*array].iter().map(|slot| (*slot, 0.0)).collect());
            }
        }
    }

    /// Returns the slots of a row in iteration i.
    fn row(&self, arrays: &Arrays<'_>, array: usize, row: Row, i: usize) -> Vec<Slot> {
        let count = arrays.routine.arrays[array].place_len(row, &self.routines.description);
        let slots = &arrays.places[array];
        let first = match row {
            Row::All | Row::First => 0,
            Row::AllButFirst | Row::Last => slots.len() - count,
            Row::Each { stride, offset } => (stride * i + offset) * count,
            Row::Listed { table, column } => self.routines.tables[table].rows[i][column] * count,
        };
        slots[first..first + count].to_vec()
    }

    fn block(&mut self, block: &Block, arrays: &mut Arrays<'_>) {
        let locals: Vec<Slot> =
            block.reads.iter().flat_map(|place| self.row(arrays, place.array, place.row, 0)).collect();
        let (body, outputs) = self.program(&block.program, arrays, &locals);
        self.parts.push(Part::Program { turns: vec![Turn::default()], body, while_positive: None });
        let mut outputs = &outputs[..];
        for place in &block.writes {
            let count = arrays.routine.arrays[place.array].len(&self.routines.description);
            let (filled, rest) = outputs.split_at(count);
            self.fill(arrays, place.array, filled);
            outputs = rest;
        }
    }

    fn repeated(&mut self, block: &Block, arrays: &mut Arrays<'_>) {
        let repeated = block.repeated.expect("a loop");
        let count = repeated.count.value(&self.routines.description);
        let mut locals = Vec::new();
        let mut moving = Vec::new();
        for place in &block.reads {
            if block.is_constant(place) {
                locals.extend(self.row(arrays, place.array, place.row, 0));
            } else {
                let count =
                    arrays.routine.arrays[place.array].place_len(place.row, &self.routines.description);
                let slots: Vec<Slot> = (0..count).map(|_| self.new_slot()).collect();
                locals.extend(&slots);
                moving.push((*place, slots));
            }
        }
        let (body, outputs) = self.program(&block.program, arrays, &locals);
        let turn = |i: usize| {
            let pairs = |from: Vec<Slot>, to: Vec<Slot>| from.into_iter().zip(to).map(|(a, b)| [a, b]);
            let read = |(place, slots): &(abbe_codegen::program::ArrayRows, Vec<Slot>)| {
                pairs(self.row(arrays, place.array, place.row, i), slots.clone())
            };
            let reads = moving.iter().flat_map(read).collect();
            let to = block.writes.iter().flat_map(|place| self.row(arrays, place.array, place.row, i));
            Turn { reads, writes: pairs(outputs.clone(), to.collect()).collect() }
        };
        let mut turns: Vec<Turn> = (0..count).map(turn).collect();
        if repeated.backwards {
            turns.reverse();
        }
        let while_positive = repeated.while_positive.map(|array| arrays.places[array][0]);
        self.parts.push(Part::Program { turns, body, while_positive });
    }

    /// Returns the operations of a program and the slots of its outputs.
    fn program(
        &mut self,
        program: &Program,
        arrays: &Arrays<'_>,
        locals: &[Slot],
    ) -> (Vec<Operation>, Vec<Slot>) {
        let chains = chains(program);
        let mut registers = Registers::new(program, &chains);
        let mut operations = Vec::with_capacity(chains.len());
        for (at, chain) in chains.iter().enumerate() {
            let steps: Vec<&Step> = chain.iter().map(|step| &program.steps[*step]).collect();
            let slot = |operand| self.slot(operand, &registers, arrays, locals);
            let mut operation = Operation::new(&steps, slot);
            // Operands used for the last time free their slots for the result: each lane reads
            // before it writes.
            registers.release(&steps, at, &mut self.free);
            let last = steps[steps.len() - 1];
            let result = self.define(&mut registers, last.register, at);
            match &mut operation {
                Operation::One(instruction) => {
                    instruction.result = result;
                    instruction.second = match last.action {
                        Action::SinCos(_) => self.define(&mut registers, last.register + 1, at),
                        _ => result,
                    };
                }
                Operation::Chain(chain) => chain.result = result,
            }
            operations.push(operation);
        }
        let outputs = program.outputs.iter();
        let outputs = outputs.map(|output| self.slot(*output, &registers, arrays, locals)).collect();
        (operations, outputs)
    }

    fn slot(&self, operand: Operand, registers: &Registers, arrays: &Arrays<'_>, locals: &[Slot]) -> Slot {
        let argument = |names: &[&str], i: usize| {
            let found = arrays.routine.arrays.iter().position(|array| names.contains(&array.name));
            arrays.places[found.expect("the signature has what the program reads")][i]
        };
        match operand {
            Operand::Register(register) => registers.slots[register],
            Operand::Symbol(Symbol::Variable(i)) => argument(&["q"], i),
            Operand::Symbol(Symbol::Parameter(i)) => argument(&["s"], i),
            Operand::Symbol(Symbol::Input(i)) => argument(&["u"], i),
            Operand::Symbol(Symbol::Error(i)) => argument(&["errors", "variances"], i),
            Operand::Symbol(Symbol::Magnitude(i)) => argument(&["magnitudes"], i),
            Operand::Symbol(Symbol::Target(i)) => argument(&["target"], i),
            Operand::Symbol(Symbol::Passive(i) | Symbol::Local(i)) => locals[i],
            Operand::Constant(value) => {
                let place = self.constants.places.get(&value.to_bits());
                self.arguments + place.expect("constants were collected")
            }
        }
    }

    fn new_slot(&mut self) -> Slot {
        self.slots += 1;
        self.slots - 1
    }

    fn define(&mut self, registers: &mut Registers, register: usize, at: usize) -> Slot {
        let slot = self.free.pop().unwrap_or_else(|| self.new_slot());
        registers.slots[register] = slot;
        if registers.last_use[register] <= at {
            // An unused half of a sine and cosine pair.
            self.free.push(slot);
        }
        slot
    }
}

/// Slots and last uses of the registers of a program.
struct Registers {
    slots: Vec<Slot>,
    /// Last chain that uses each register; outputs are never released.
    last_use: Vec<usize>,
}

impl Registers {
    fn new(program: &Program, chains: &[Vec<usize>]) -> Self {
        let mut last_use = vec![0; program.registers];
        for (at, chain) in chains.iter().enumerate() {
            let operands = chain.iter().flat_map(|step| program.steps[*step].action.operands());
            operands.filter_map(Operand::register).for_each(|register| last_use[register] = at);
        }
        let outputs = program.outputs.iter().filter_map(|output| output.register());
        outputs.for_each(|register| last_use[register] = usize::MAX);
        Self { slots: vec![0; program.registers], last_use }
    }

    /// Frees the slots of registers that a chain uses for the last time.
    fn release(&self, steps: &[&Step], at: usize, free: &mut Vec<Slot>) {
        let ends = |register: &usize| self.last_use[*register] == at;
        let made: Vec<usize> = steps[..steps.len() - 1].iter().map(|step| step.register).collect();
        let operands = steps.iter().flat_map(|step| step.action.operands());
        let mut released: Vec<usize> = operands.filter_map(Operand::register).filter(ends).collect();
        released.sort_unstable();
        released.dedup();
        let in_slots = released.into_iter().filter(|register| !made.contains(register));
        free.extend(in_slots.map(|register| self.slots[register]));
    }
}
