//! Writes nodes as steps, each after its operands.

use std::rc::Rc;

use abbe_spec::Function;

use super::{Action, Operand, Program, Step, select::Selection};
use crate::graph::{Graph, Node, Op, Signed};

/// A value or its negative; sums and products absorb signs.
#[derive(Clone, Copy)]
struct Value {
    operand: Operand,
    negative: bool,
}

pub(super) struct Writer<'w> {
    graph: &'w Graph,
    selection: Rc<Selection>,
    /// Representatives that are needed.
    needed: Vec<bool>,
    /// Sign of a representative's results: `Some(true)` if all are its negative; `None` if there
    /// are both signs or no results.
    wanted: Vec<Option<bool>>,
    values: Vec<Option<Value>>,
    negatives: Vec<Option<Operand>>,
    program: &'w mut Program,
}

impl<'w> Writer<'w> {
    /// Writes the steps for the given outputs.
    pub(super) fn new(
        graph: &'w Graph,
        outputs: &[Node],
        selection: Rc<Selection>,
        program: &'w mut Program,
    ) -> Self {
        let mut needed = vec![false; graph.len()];
        let mut stack: Vec<Node> = outputs.iter().map(|node| graph.class(*node).node).collect();
        while let Some(first) = stack.pop() {
            if !std::mem::replace(&mut needed[first.index()], true) {
                stack.extend(
                    graph.op(selection.member(first).node).operands().map(|node| graph.class(node).node),
                );
            }
        }
        // Write results as soon as they are known.
        let mut order: Vec<(Node, bool)> =
            graph.nodes().filter(|node| needed[node.index()]).map(|node| (node, false)).collect();
        order.extend(outputs.iter().map(|node| (*node, true)));
        order.sort_unstable();
        let mut wanted = vec![None; graph.len()];
        for output in outputs.iter().map(|node| graph.class(*node)) {
            wanted[output.node.index()] = Some(output.negative);
        }
        for output in outputs.iter().map(|node| graph.class(*node)) {
            if wanted[output.node.index()] == Some(!output.negative) {
                wanted[output.node.index()] = None;
            }
        }
        let (values, operands) = (vec![None; graph.len()], vec![None; graph.len()]);
        let mut writer = Self { graph, selection, needed, wanted, values, negatives: operands, program };
        for (node, is_output) in order {
            if is_output {
                writer.whole(node);
            } else {
                writer.value(node);
            }
        }
        writer
    }

    /// Returns the values of the nodes.
    pub(super) fn outputs(mut self, outputs: &[Node]) -> Vec<Operand> {
        outputs.iter().map(|node| self.whole(*node)).collect()
    }

    /// Returns the value of a node, with its sign applied.
    fn whole(&mut self, node: Node) -> Operand {
        let Value { operand, negative } = self.value(node);
        match operand {
            _ if !negative => operand,
            Operand::Constant(value) => Operand::Constant(-value),
            operand => {
                let first = self.graph.class(node).node.index();
                if let Some(known) = self.negatives[first] {
                    return known;
                }
                let register = Operand::Register(self.program.registers);
                let name = self.graph.name_at(node.index()).map(str::to_owned);
                self.step(Action::Neg(operand), name, 1);
                self.negatives[first] = Some(register);
                register
            }
        }
    }

    fn value(&mut self, node: Node) -> Value {
        let class = self.graph.class(node);
        let value = match self.values[class.node.index()] {
            Some(value) => value,
            None => {
                let chosen = self.selection.member(class.node);
                let value = self.written(class.node, chosen.node).times(chosen.negative);
                self.values[class.node.index()] = Some(value);
                value
            }
        };
        value.times(class.negative)
    }

    fn step(&mut self, action: Action, name: Option<String>, registers: usize) -> Operand {
        let register = self.program.registers;
        self.program.registers += registers;
        self.program.steps.push(Step { register, action, name });
        Operand::Register(register)
    }

    /// Writes the operation of a node and returns its value.
    fn written(&mut self, first: Node, node: Node) -> Value {
        let op = self.graph.op(node);
        let mut negative = false;
        let action = match op {
            Op::Constant(bits) => return Value::plain(Operand::Constant(f64::from_bits(bits))),
            Op::Symbol(symbol) => return Value::plain(Operand::Symbol(symbol)),
            // Never selected: a representative is no negation.
            Op::Neg(a) => return self.value(a).times(true),
            Op::Add(a, b) => sum(self.value(a), self.value(b), &mut negative),
            Op::Sub(a, b) => sum(self.value(a), self.value(b).times(true), &mut negative),
            Op::Mul(a, b) | Op::Div(a, b) => {
                let (a, b) = (self.value(a), self.value(b));
                negative = a.negative != b.negative;
                let action = if matches!(op, Op::Mul(..)) { Action::Mul } else { Action::Div };
                action(a.operand, b.operand)
            }
            Op::Pow(a, b) => Action::Pow(self.whole(a), self.whole(b)),
            Op::Atan2(a, b) => Action::Atan2(self.whole(a), self.whole(b)),
            Op::Min(a, b) => Action::Min(self.whole(a), self.whole(b)),
            Op::Max(a, b) => Action::Max(self.whole(a), self.whole(b)),
            Op::Lookup(lookup, a) => Action::Lookup(lookup, self.whole(a)),
            Op::Call(function, a) => {
                let angle = self.whole(a);
                match self.partner(function, a) {
                    None => Action::Call(function, angle),
                    Some(partner) => return self.both(function, angle, [first, partner]),
                }
            }
        };
        let action = match action {
            // Only the negative is a result.
            Action::Sub(a, b)
                if self.wanted[first.index()] == Some(negative == self.selection.member(first).negative) =>
            {
                negative = !negative;
                Action::Sub(b, a)
            }
            action => action,
        };
        let name = self.name(first, node, negative);
        Value { operand: self.step(action, name, 1), negative }
    }

    /// Returns the name of the node, or of any node equal to it; with a negative sign, of their
    /// negatives.
    fn name(&self, first: Node, node: Node, negative: bool) -> Option<String> {
        let sign = self.selection.member(first).negative;
        let equal = std::iter::once(Signed { node, negative: sign }).chain(self.graph.equal(first));
        let mut nodes = equal.filter_map(|other| match (other.negative != sign) == negative {
            true => Some(other.node),
            false => self.graph.find(Op::Neg(other.node)),
        });
        nodes.find_map(|node| self.graph.name_at(node.index())).map(str::to_owned)
    }

    /// Writes the sine and cosine of an angle as one step.
    fn both(&mut self, function: Function, angle: Operand, [this, partner]: [Node; 2]) -> Value {
        let name = self.graph.name_at(this.index()).map(str::to_owned);
        let register = self.program.registers;
        self.step(Action::SinCos(angle), name, 2);
        let [sine, cosine] = [register, register + 1].map(|at| Value::plain(Operand::Register(at)));
        let [value, other] = if function == Function::Sin { [sine, cosine] } else { [cosine, sine] };
        self.values[partner.index()] = Some(other);
        value
    }

    /// Returns the cosine that belongs to a sine, or the reverse, if both are needed.
    fn partner(&self, function: Function, angle: Node) -> Option<Node> {
        let other = match function {
            Function::Sin => Function::Cos,
            Function::Cos => Function::Sin,
            _ => return None,
        };
        let partner = self.graph.find(Op::Call(other, angle))?;
        let alone = self.graph.class(partner).node == partner && self.selection.is(partner);
        (alone && self.needed[partner.index()]).then_some(partner)
    }
}

/// Returns `a + b`, or its negative with `negative` set.
fn sum(a: Value, b: Value, negative: &mut bool) -> Action {
    match (a.negative, b.negative) {
        (false, false) => Action::Add(a.operand, b.operand),
        (false, true) => Action::Sub(a.operand, b.operand),
        (true, false) => Action::Sub(b.operand, a.operand),
        (true, true) => {
            *negative = true;
            Action::Add(a.operand, b.operand)
        }
    }
}

impl Value {
    fn plain(operand: Operand) -> Self {
        Self { operand, negative: false }
    }

    fn times(self, negative: bool) -> Self {
        Self { negative: self.negative != negative, ..self }
    }
}
