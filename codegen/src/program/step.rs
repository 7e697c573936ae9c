//! Straight-line programs: steps, each after its operands.

use abbe_spec::{Function, Lookup, Symbol};

/// Source of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Operand {
    /// A constant.
    Constant(f64),
    /// A variable, parameter or input.
    Symbol(Symbol),
    /// The result of the step that defines this register.
    Register(usize),
}

/// Operation of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action {
    /// `-a`.
    Neg(Operand),
    /// `a + b`.
    Add(Operand, Operand),
    /// `a - b`.
    Sub(Operand, Operand),
    /// `a · b`.
    Mul(Operand, Operand),
    /// `a · b + c`.
    MulAdd(Operand, Operand, Operand),
    /// `a · b - c`.
    MulSub(Operand, Operand, Operand),
    /// `c - a · b`.
    NegMulAdd(Operand, Operand, Operand),
    /// `a / b`.
    Div(Operand, Operand),
    /// `a ^ b`.
    Pow(Operand, Operand),
    /// The angle of the point (x, y); the operands are y, x.
    Atan2(Operand, Operand),
    /// The smaller operand.
    Min(Operand, Operand),
    /// The larger operand.
    Max(Operand, Operand),
    /// A function of one operand.
    Call(Function, Operand),
    /// A table lookup.
    Lookup(Lookup, Operand),
    /// Sine, and in the next register cosine.
    SinCos(Operand),
}

impl Action {
    /// Returns the operands, one to three.
    pub fn operands(self) -> impl Iterator<Item = Operand> {
        let (first, second, third) = match self {
            Self::Neg(a) | Self::Call(_, a) | Self::Lookup(_, a) | Self::SinCos(a) => (a, None, None),
            Self::Add(a, b)
            | Self::Sub(a, b)
            | Self::Mul(a, b)
            | Self::Div(a, b)
            | Self::Pow(a, b)
            | Self::Atan2(a, b)
            | Self::Min(a, b)
            | Self::Max(a, b) => (a, Some(b), None),
            Self::MulAdd(a, b, c) | Self::MulSub(a, b, c) | Self::NegMulAdd(a, b, c) => (a, Some(b), Some(c)),
        };
        [Some(first), second, third].into_iter().flatten()
    }
}

/// One operation of a program.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// Register that the step defines. [`Action::SinCos`] defines the next one as well.
    pub register: usize,
    /// The operation.
    pub action: Action,
    /// Name that generated code should give to the result.
    pub name: Option<String>,
}

/// A straight-line program.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Program {
    /// Steps, each after its operands; none is unused.
    pub steps: Vec<Step>,
    /// Values that the program returns.
    pub outputs: Vec<Operand>,
    /// Recurring numbers and the names that generated code should give to them.
    pub numbers: Vec<(f64, String)>,
    /// Number of registers that the steps define.
    pub registers: usize,
    /// Number of uses of each register, as an operand or output.
    pub uses: Vec<usize>,
}

impl Program {
    /// Iterates over the operands of all steps, and the outputs.
    pub(crate) fn operands(&self) -> impl Iterator<Item = Operand> {
        self.steps.iter().flat_map(|step| step.action.operands()).chain(self.outputs.iter().copied())
    }

    pub(super) fn count_uses(&mut self) {
        let mut uses = vec![0; self.registers];
        self.operands().filter_map(Operand::register).for_each(|register| uses[register] += 1);
        self.uses = uses;
    }
}
