//! What is done at once with values in slots: an operation, or a chain of them.

use abbe_codegen::program::{Action, Operand, Step};

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

/// Operations of which each reads what the one before it makes: that stays in registers.
#[derive(Clone, Debug)]
pub(crate) struct Chain {
    /// The value that it begins with.
    pub(crate) start: Slot,
    pub(crate) links: Vec<Link>,
    pub(crate) result: Slot,
}

/// What becomes of a value v, with what is in two slots a and b.
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

/// What is done at once.
#[derive(Clone, Debug)]
pub(crate) enum Operation {
    One(Instruction),
    Chain(Chain),
}

impl Operation {
    /// That of some steps, of which each reads what the one before it makes; where its result goes is not known yet.
    pub(crate) fn new(steps: &[&Step], slot: impl Fn(Operand) -> Slot) -> Self {
        match steps {
            [step] => Self::One(one(step.action, slot)),
            steps => Self::Chain(linked(steps, slot)),
        }
    }
}

/// An operation by itself; where its result goes is not known yet.
fn one(action: Action, slot: impl Fn(Operand) -> Slot) -> Instruction {
    let mut operands = action.operands();
    let a = operands.next().map_or(0, &slot);
    let b = operands.next().map_or(a, &slot);
    let c = operands.next().map_or(b, &slot);
    Instruction { action, a, b, c, result: 0, second: 0 }
}

/// Several, of which each reads the register of the one before it; the first one goes on from one of its operands.
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

/// From which of its operands an action goes on at the beginning of a chain.
fn start(action: Action) -> Operand {
    match action {
        Action::MulAdd(.., c) | Action::MulSub(.., c) | Action::NegMulAdd(.., c) => c,
        _ => action.operands().next().unwrap_or(Operand::Constant(0.0)),
    }
}

/// What an action does to one of its operands, and which the others are.
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
