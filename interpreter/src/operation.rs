//! Operations on slots, single ones or chains of them, and tapes: functions whose operands are all
//! slots of one array.
//!
//! Each operation of a chain reads the result of the one before it. Nothing else reads that result,
//! so it never leaves the registers.

use std::sync::Arc;

use abbe_codegen::program::{Action, Operand, Program, Step};
use abbe_spec::expr::Table;

/// Index of a value of a block.
pub(crate) type Slot = usize;

/// One operation and its slots.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Instruction {
    pub(crate) action: Action,
    pub(crate) a: Slot,
    pub(crate) b: Slot,
    pub(crate) c: Slot,
    pub(crate) result: Slot,
    /// Slot of the cosine that is computed together with a sine.
    pub(crate) second: Slot,
}

/// Operations that each read the result of the one before, which stays in registers.
#[derive(Clone, Debug)]
pub(crate) struct Chain {
    /// Slot of the initial value.
    pub(crate) start: Slot,
    pub(crate) links: Vec<Link>,
    pub(crate) result: Slot,
}

/// One operation of a chain on its value v and the contents of two slots a and b.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Link {
    pub(crate) kind: LinkKind,
    pub(crate) a: Slot,
    pub(crate) b: Slot,
}

#[derive(Clone, Copy, Debug)]
pub(crate) enum LinkKind {
    /// `−v`.
    Negated,
    /// `v + a`.
    Plus,
    /// `v − a`.
    Minus,
    /// `a − v`.
    From,
    /// `v a`.
    Times,
    /// `a b + v`.
    PlusProduct,
    /// `v − a b`.
    MinusProduct,
    /// `a b − v`.
    FromProduct,
    /// `v a + b`.
    TimesPlus,
    /// `v a − b`.
    TimesMinus,
    /// `b − v a`.
    FromTimes,
}

/// A unit of execution.
#[derive(Clone, Debug)]
pub(crate) enum Operation {
    One(Instruction),
    Chain(Chain),
}

impl Operation {
    /// Creates the operation of some steps, each of which reads the result of the one before it.
    /// The slot of the result is set later.
    pub(crate) fn new(steps: &[&Step], slot: impl Fn(Operand) -> Slot) -> Self {
        match steps {
            [step] => Self::One(one(step.action, slot)),
            steps => Self::Chain(linked(steps, slot)),
        }
    }
}

/// Creates a single operation. The slot of the result is set later.
fn one(action: Action, slot: impl Fn(Operand) -> Slot) -> Instruction {
    let mut operands = action.operands();
    let a = operands.next().map_or(0, &slot);
    let b = operands.next().map_or(a, &slot);
    let c = operands.next().map_or(b, &slot);
    Instruction { action, a, b, c, result: 0, second: 0 }
}

/// Creates a chain of steps, each of which reads the register of the one before it. The first step
/// reads the initial value.
fn linked(steps: &[&Step], slot: impl Fn(Operand) -> Slot) -> Chain {
    let start = start(steps[0].action);
    let mut value = start;
    let mut links = Vec::with_capacity(steps.len());
    for step in steps {
        let (kind, a, b) = link(step.action, value);
        let [a, b] = [a, b].map(|operand| operand.map(&slot));
        links.push(Link { kind, a: a.unwrap_or(0), b: b.or(a).unwrap_or(0) });
        value = Operand::Register(step.register);
    }
    Chain { start: slot(start), links, result: 0 }
}

/// Returns the operand of the first action that is the initial value of a chain.
fn start(action: Action) -> Operand {
    match action {
        Action::MulAdd(.., c) | Action::MulSub(.., c) | Action::NegMulAdd(.., c) => c,
        _ => action.operands().next().unwrap_or(Operand::Constant(0.0)),
    }
}

/// Returns the kind of an action on one of its operands, and the other operands.
fn link(action: Action, value: Operand) -> (LinkKind, Option<Operand>, Option<Operand>) {
    let other = |a: Operand, b: Operand| if a == value { b } else { a };
    match action {
        Action::Neg(_) => (LinkKind::Negated, None, None),
        Action::Add(a, b) => (LinkKind::Plus, Some(other(a, b)), None),
        Action::Mul(a, b) => (LinkKind::Times, Some(other(a, b)), None),
        Action::Sub(a, b) if a == value => (LinkKind::Minus, Some(b), None),
        Action::Sub(a, _) => (LinkKind::From, Some(a), None),
        Action::MulAdd(a, b, c) if c == value => (LinkKind::PlusProduct, Some(a), Some(b)),
        Action::MulSub(a, b, c) if c == value => (LinkKind::FromProduct, Some(a), Some(b)),
        Action::NegMulAdd(a, b, c) if c == value => (LinkKind::MinusProduct, Some(a), Some(b)),
        Action::MulAdd(a, b, c) => (LinkKind::TimesPlus, Some(other(a, b)), Some(c)),
        Action::MulSub(a, b, c) => (LinkKind::TimesMinus, Some(other(a, b)), Some(c)),
        Action::NegMulAdd(a, b, c) => (LinkKind::FromTimes, Some(other(a, b)), Some(c)),
        _ => unreachable!("no link of a chain"),
    }
}

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

/// Returns the steps of a program in execution order, grouped in chains. Within a chain each step
/// reads the result of the step before it, and no other step does.
pub(crate) fn chains(program: &Program) -> Vec<Vec<usize>> {
    let mut maker = vec![None; program.registers];
    // The chain that ends at a step, until another step extends it.
    let mut ending: Vec<Vec<usize>> = Vec::with_capacity(program.steps.len());
    for (at, step) in program.steps.iter().enumerate() {
        let mut longest: Option<usize> = None;
        for operand in step.action.operands().filter(|_| is_link(step.action)) {
            let Operand::Register(register) = operand else { continue };
            let Some(before) = maker[register].filter(|_| program.uses[register] == 1) else { continue };
            let length = |step: usize| ending[step].len();
            if longest.is_none_or(|longest| length(before) > length(longest)) {
                longest = Some(before);
            }
        }
        let mut chain = longest.map_or_else(Vec::new, |before| std::mem::take(&mut ending[before]));
        chain.push(at);
        ending.push(chain);
        // A chain runs at the position of its last step, where all other operands are available.
        maker[step.register] = is_link(step.action).then_some(at);
    }
    ending.retain(|chain| !chain.is_empty());
    ending
}

/// Returns `true` if an action may be part of a chain: fast operations that leave registers free.
fn is_link(action: Action) -> bool {
    matches!(
        action,
        Action::Neg(_)
            | Action::Add(..)
            | Action::Sub(..)
            | Action::Mul(..)
            | Action::MulAdd(..)
            | Action::MulSub(..)
            | Action::NegMulAdd(..)
    )
}

#[cfg(test)]
mod tests;
