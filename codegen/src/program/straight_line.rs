//! From the nodes of a result to the steps that compute it.

use std::rc::Rc;

use abbe_spec::expr::{Function, Lookup, Symbol};
use indexmap::IndexMap;

use super::select::{Selection, Selections};
use super::write::Writer;
use crate::graph::{Graph, Node};

/// Where a value comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Operand {
    /// A number.
    Constant(f64),
    /// A variable, parameter or input.
    Symbol(Symbol),
    /// The result of the step that defines this register.
    Register(usize),
}

/// What a step does.
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
    /// The angle of the point (second, first).
    Atan2(Operand, Operand),
    /// The smaller.
    Min(Operand, Operand),
    /// The larger.
    Max(Operand, Operand),
    /// A function.
    Call(Function, Operand),
    /// A table.
    Lookup(Lookup, Operand),
    /// Sine, and in the next register cosine.
    SinCos(Operand),
}

impl Action {
    /// The operands, one to three.
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
    /// The register it defines; [`Action::SinCos`] defines the next one too.
    pub register: usize,
    /// What it does.
    pub action: Action,
    /// What generated code should call the result.
    pub name: Option<String>,
}

/// A straight-line program.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// Each after the steps it uses; every one is needed.
    pub steps: Vec<Step>,
    /// The values it returns.
    pub outputs: Vec<Operand>,
    /// Numbers that recur, and what generated code should call them.
    pub numbers: Vec<(f64, String)>,
    /// How many registers the steps define.
    pub registers: usize,
    /// How often each register is used, as an operand or output.
    pub uses: Vec<usize>,
}

impl Program {
    /// The steps that compute some nodes, and nothing else, in the order in which the nodes were made; of nodes that are
    /// equal those that take the fewest operations.
    pub fn new(graph: &Graph, outputs: &[Node]) -> Self {
        Self::with(graph, outputs, &mut Selections::default())
    }

    /// The same with what was selected for others.
    pub(super) fn with(graph: &Graph, outputs: &[Node], selections: &mut Selections) -> Self {
        Self::of(graph, outputs, selections.of(graph, outputs))
    }

    /// The same, where some of the outputs have the bits that they have alone.
    pub(super) fn after(
        graph: &Graph,
        others: &[Node],
        outputs: &[Node],
        selections: &mut Selections,
    ) -> Self {
        Self::of(graph, outputs, selections.after(graph, others, outputs))
    }

    fn of(graph: &Graph, outputs: &[Node], selection: Rc<Selection>) -> Self {
        let mut program = Self {
            steps: Vec::new(),
            outputs: Vec::new(),
            numbers: Vec::new(),
            registers: 0,
            uses: Vec::new(),
        };
        program.outputs = Writer::new(graph, outputs, selection, &mut program).outputs(outputs);
        program.count_uses();
        program.fuse();
        program.sines_first();
        program.name_numbers(graph);
        program
    }

    fn name_numbers(&mut self, graph: &Graph) {
        let mut uses: IndexMap<u64, usize> = IndexMap::new();
        for operand in self.steps.iter().flat_map(|step| step.action.operands()) {
            if let Operand::Constant(value) = operand {
                *uses.entry(value.to_bits()).or_default() += 1;
            }
        }
        let recurring = uses.into_iter().filter(|(_, uses)| *uses > 1).map(|(bits, _)| f64::from_bits(bits));
        let named = recurring.filter_map(|value| Some((value, graph.name_of_number(value)?.to_owned())));
        self.numbers = named.collect();
    }

    pub(super) fn count_uses(&mut self) {
        let mut uses = vec![0; self.registers];
        let operands = self.steps.iter().flat_map(|step| step.action.operands());
        for operand in operands.chain(self.outputs.iter().copied()) {
            if let Operand::Register(register) = operand {
                uses[register] += 1;
            }
        }
        self.uses = uses;
    }
}
