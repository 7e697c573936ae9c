//! Converts the nodes of a result to steps that compute it.
//!
//! Products are fused into sums: one operation on machines with fused multiply-add, and one
//! rounding less. Sines and cosines come first: computed together they take half the time.

use std::rc::Rc;

use abbe_spec::Function;
use indexmap::IndexMap;

use super::select::{Selection, Selections};
use super::write::Writer;
use super::{Action, Operand, Program, Step};
use crate::graph::{Graph, Node};

impl Program {
    /// Returns the steps that compute the nodes, in the order in which the nodes were made. Among
    /// equal nodes those that take the fewest operations are computed.
    pub fn new(graph: &Graph, outputs: &[Node]) -> Self {
        Self::with(graph, outputs, &mut Selections::default())
    }

    /// Returns the steps that compute the nodes, reusing earlier selections.
    pub(super) fn with(graph: &Graph, outputs: &[Node], selections: &mut Selections) -> Self {
        Self::from_selection(graph, outputs, selections.select(graph, outputs))
    }

    /// Returns the steps that compute the nodes as they are selected.
    pub(super) fn from_selection(graph: &Graph, outputs: &[Node], selection: Rc<Selection>) -> Self {
        let mut program = Self::default();
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

    /// Moves all sine and cosine pairs whose angles use no function next to each other at the
    /// beginning, after the operands of their angles.
    fn sines_first(&mut self) {
        let mut plain = vec![false; self.registers];
        let mut pairs = vec![false; self.registers];
        for Step { register, action, .. } in &self.steps {
            let known = |operand: Operand| match operand {
                Operand::Register(register) => plain[register],
                Operand::Symbol(_) | Operand::Constant(_) => true,
            };
            let operands = action.operands().all(known);
            match action {
                Action::SinCos(_) => pairs[*register] = operands,
                Action::Call(Function::Sin | Function::Cos, _) => {}
                _ => plain[*register] = operands,
            }
        }
        // Exactly the operands of the angles.
        let mut needed = vec![false; self.registers];
        for step in self.steps.iter().rev() {
            if pairs[step.register] || needed[step.register] {
                let operands = step.action.operands().filter_map(Operand::register);
                operands.for_each(|register| needed[register] = true);
            }
        }
        self.steps.sort_by_key(|step| match (needed[step.register], pairs[step.register]) {
            (true, _) if plain[step.register] => 0,
            (_, true) => 1,
            _ => 2,
        });
    }

    /// Makes `a · b ± c` one step wherever nothing else uses the product. Of two products the first
    /// stays separate: `a · b + c · d` becomes `a.mul_add(b, c · d)`.
    fn fuse(&mut self) {
        let mut product: Vec<Option<(Operand, Operand)>> = vec![None; self.registers];
        let mut fused = vec![false; self.registers];
        let returned = self.returned();
        for step in &mut self.steps {
            let single =
                |operand: Operand| operand.register().and_then(|r| product[r].map(|factors| (r, factors)));
            let found = match step.action {
                Action::Mul(a, b) => {
                    if self.uses[step.register] == 1 && !returned[step.register] && step.name.is_none() {
                        product[step.register] = Some((a, b));
                    }
                    None
                }
                Action::Add(x, y) => single(x)
                    .map(|(r, (a, b))| (r, Action::MulAdd(a, b, y)))
                    .or_else(|| single(y).map(|(r, (a, b))| (r, Action::MulAdd(a, b, x)))),
                Action::Sub(x, y) => single(x)
                    .map(|(r, (a, b))| (r, Action::MulSub(a, b, y)))
                    .or_else(|| single(y).map(|(r, (a, b))| (r, Action::NegMulAdd(a, b, x)))),
                _ => None,
            };
            if let Some((register, action)) = found {
                fused[register] = true;
                step.action = action;
            }
        }
        if fused.contains(&true) {
            self.steps.retain(|step| !fused[step.register]);
            self.renumber();
            self.count_uses();
        }
    }

    /// Returns which registers are results.
    pub(crate) fn returned(&self) -> Vec<bool> {
        let mut returned = vec![false; self.registers];
        let outputs = self.outputs.iter().filter_map(|output| output.register());
        outputs.for_each(|register| returned[register] = true);
        returned
    }

    /// Renumbers the registers of the remaining steps without gaps.
    fn renumber(&mut self) {
        let mut numbers = vec![usize::MAX; self.registers];
        let mut next = 0;
        for step in &mut self.steps {
            let Step { register, action, .. } = step;
            for half in 0..=usize::from(matches!(action, Action::SinCos(_))) {
                numbers[*register + half] = next + half;
            }
            *action = action.map(|operand| operand.renumbered(&numbers));
            *register = numbers[*register];
            next += 1 + usize::from(matches!(action, Action::SinCos(_)));
        }
        for output in &mut self.outputs {
            *output = output.renumbered(&numbers);
        }
        self.registers = next;
    }
}

impl Operand {
    /// Returns its register; none for symbols and constants.
    pub fn register(self) -> Option<usize> {
        match self {
            Self::Register(register) => Some(register),
            _ => None,
        }
    }

    fn renumbered(self, numbers: &[usize]) -> Self {
        match self {
            Self::Register(register) => Self::Register(numbers[register]),
            other => other,
        }
    }
}

impl Action {
    /// Applies `f` to every operand.
    fn map(self, f: impl Fn(Operand) -> Operand) -> Self {
        match self {
            Self::Neg(a) => Self::Neg(f(a)),
            Self::Call(function, a) => Self::Call(function, f(a)),
            Self::SinCos(a) => Self::SinCos(f(a)),
            Self::Add(a, b) => Self::Add(f(a), f(b)),
            Self::Sub(a, b) => Self::Sub(f(a), f(b)),
            Self::Mul(a, b) => Self::Mul(f(a), f(b)),
            Self::Div(a, b) => Self::Div(f(a), f(b)),
            Self::Pow(a, b) => Self::Pow(f(a), f(b)),
            Self::Atan2(a, b) => Self::Atan2(f(a), f(b)),
            Self::Min(a, b) => Self::Min(f(a), f(b)),
            Self::Max(a, b) => Self::Max(f(a), f(b)),
            Self::Lookup(lookup, a) => Self::Lookup(lookup, f(a)),
            Self::MulAdd(a, b, c) => Self::MulAdd(f(a), f(b), f(c)),
            Self::MulSub(a, b, c) => Self::MulSub(f(a), f(b), f(c)),
            Self::NegMulAdd(a, b, c) => Self::NegMulAdd(f(a), f(b), f(c)),
        }
    }
}
