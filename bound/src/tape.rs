//! A tape: the operations of an expression graph in order of evaluation, with affine arithmetic.

use std::{collections::HashMap, sync::Arc};

use abbe_codegen::graph::{Graph, Node, Op};
use abbe_spec::expr::{Extrapolation, Function, Interpolation, Lookup, Symbol, Table};

use crate::affine::Affine;

pub(crate) type Register = usize;

/// An operation on registers. Constants are evaluated when the tape is built.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Step {
    Known(Affine<0>),
    Neg(Register),
    Add(Register, Register),
    Sub(Register, Register),
    Shift(Register, Affine<0>),
    Mul(Register, Register),
    Scale(Register, Affine<0>),
    Div(Register, Register),
    Power(Register, f64),
    Angle(Register, Register),
    Smaller(Register, Register),
    Larger(Register, Register),
    Call(Function, Register),
    Lookup(Lookup, Register),
    /// Sine, and in the next register cosine.
    SinCos(Register),
}

/// Operations that compute outputs from the values of names.
#[derive(Clone, Debug)]
pub(crate) struct Tape {
    pub(crate) steps: Vec<Step>,
    pub(crate) outputs: Vec<Register>,
    pub(crate) tables: Vec<Arc<Table>>,
    /// `true` if derivatives that jump, of absolute values and of tables with corners, are part of
    /// a value and not only of its slopes.
    pub(crate) slopes_jump: bool,
}

/// Value of a node while the tape is built.
#[derive(Clone, Copy)]
enum Value {
    Known(Affine<0>),
    At(Register),
}

/// A tape under construction.
struct Draft {
    tape: Tape,
    registers: usize,
    turns: HashMap<Register, Register>,
}

impl Tape {
    /// Builds the tape of nodes as functions of names; `fixed` gives the values of all other
    /// symbols.
    pub(crate) fn new(
        graph: &Graph,
        nodes: &[Node],
        names: &[Symbol],
        fixed: impl Fn(Symbol) -> f64,
    ) -> Self {
        let count = nodes.iter().map(|node| node.index() + 1).max().unwrap_or(0);
        let ops: Vec<Op> = graph.ops().take(count).collect();
        let mut needed = vec![false; count];
        nodes.iter().for_each(|node| needed[node.index()] = true);
        for (index, op) in ops.iter().enumerate().rev() {
            if needed[index] {
                op.operands().for_each(|operand| needed[operand.index()] = true);
            }
        }
        let tape = Self {
            steps: Vec::new(),
            outputs: Vec::new(),
            tables: graph.tables().to_vec(),
            slopes_jump: false,
        };
        let mut draft = Draft { tape, registers: names.len(), turns: HashMap::new() };
        let mut values: Vec<Value> = Vec::with_capacity(count);
        for (op, needed) in ops.iter().zip(needed) {
            values.push(match op {
                _ if !needed => Value::Known(Affine::known(f64::NAN, 0.0)),
                Op::Constant(bits) => Value::Known(Affine::known(f64::from_bits(*bits), 0.0)),
                Op::Symbol(symbol) => match names.iter().position(|name| name == symbol) {
                    Some(name) => Value::At(name),
                    None => Value::Known(Affine::known(fixed(*symbol), 0.0)),
                },
                _ => draft.operation(*op, |node| values[node.index()]),
            });
        }
        draft.tape.outputs = nodes.iter().map(|node| draft.register(values[node.index()])).collect();
        draft.tape
    }

    /// Returns `true` for the derivative of an absolute value, or of a table with corners: of first
    /// order unless it is cubic and ends, of higher order always.
    pub(crate) fn is_jumping_slope(&self, step: &Step) -> bool {
        match *step {
            Step::Call(function, _) => function == Function::Side,
            Step::Lookup(Lookup { table, order }, _) => {
                let table = &self.tables[usize::from(table)];
                let is_smooth =
                    table.interpolation == Interpolation::Cubic && table.outside != Extrapolation::Hold;
                order > 1 || order == 1 && !is_smooth
            }
            _ => false,
        }
    }

    /// Returns the enclosures of the outputs while each name is within its half width of its
    /// centre, and whether one of them may jump there.
    pub(crate) fn evaluate<const N: usize>(
        &self,
        registers: &mut Vec<Affine<N>>,
        centres: &[f64],
        halves: &[f64],
    ) -> (Vec<Affine<N>>, bool) {
        match names(centres, halves) {
            Some(names) => self.evaluate_at(registers, &names),
            None => (vec![Affine::anything(); self.outputs.len()], true),
        }
    }

    /// Returns the enclosures of the outputs from those of the names, and whether one of them may
    /// jump there.
    pub(crate) fn evaluate_at<const N: usize>(
        &self,
        registers: &mut Vec<Affine<N>>,
        names: &[Affine<N>],
    ) -> (Vec<Affine<N>>, bool) {
        registers.clear();
        registers.extend_from_slice(names);
        let mut jumps = false;
        for step in &self.steps {
            let at = |register: Register| &registers[register];
            let form = match *step {
                Step::Known(number) => Affine::known(number.centre, number.rest),
                Step::Neg(a) => at(a).neg(),
                Step::Add(a, b) => at(a).add(at(b)),
                Step::Sub(a, b) => at(a).sub(at(b)),
                Step::Shift(a, number) => at(a).shifted(&number),
                Step::Mul(a, b) => at(a).mul(at(b)),
                Step::Scale(a, number) => at(a).scaled(&number),
                Step::Div(a, b) => at(a).mul(&at(b).reciprocal()),
                Step::Power(a, exponent) => at(a).power(exponent),
                Step::Smaller(a, b) => at(a).smaller(at(b)),
                Step::Larger(a, b) => at(a).larger(at(b)),
                Step::Angle(a, b) => {
                    let (form, may_jump) = at(a).angle(at(b));
                    jumps |= may_jump;
                    form
                }
                Step::Call(function, a) => {
                    let (form, may_jump) = at(a).call(function);
                    jumps |= may_jump;
                    form
                }
                Step::Lookup(Lookup { table, order }, a) => {
                    at(a).look_up(&self.tables[usize::from(table)], u32::from(order))
                }
                Step::SinCos(a) => {
                    let [sine, cosine] = at(a).sin_cos();
                    registers.push(sine);
                    cosine
                }
            };
            jumps |= self.slopes_jump && form.rest > 0.0 && self.is_jumping_slope(step);
            registers.push(form);
        }
        (self.outputs.iter().map(|output| registers[*output]).collect(), jumps)
    }
}

/// Returns the forms of names within their half widths of their centres; `None` for too many.
pub(crate) fn names<const N: usize>(centres: &[f64], halves: &[f64]) -> Option<Vec<Affine<N>>> {
    let name = |(i, (centre, half)): (usize, (&f64, &f64))| {
        let mut slopes = [0.0; N];
        match slopes.get_mut(i) {
            Some(slope) => *slope = *half,
            None if *half > 0.0 => return None,
            None => {}
        }
        Some(Affine { centre: *centre, slopes, spread: *half, rest: 0.0 })
    };
    centres.iter().zip(halves).enumerate().map(name).collect()
}

impl Draft {
    fn push(&mut self, step: Step) -> Register {
        self.tape.steps.push(step);
        self.registers += 1;
        self.registers - 1
    }

    /// Returns the register of a value.
    fn register(&mut self, value: Value) -> Register {
        match value {
            Value::Known(number) => self.push(Step::Known(number)),
            Value::At(register) => register,
        }
    }

    fn operation(&mut self, op: Op, of: impl Fn(Node) -> Value) -> Value {
        let is_known = |node: Node| matches!(of(node), Value::Known(_));
        if op.operands().all(is_known) {
            return Value::Known(self.number(op, of));
        }
        let step = match op {
            Op::Call(function @ (Function::Sin | Function::Cos), a) => {
                let angle = self.register(of(a));
                let sine = match self.turns.get(&angle) {
                    Some(sine) => *sine,
                    None => {
                        let sine = self.push(Step::SinCos(angle));
                        self.registers += 1;
                        self.turns.insert(angle, sine);
                        sine
                    }
                };
                return Value::At(sine + usize::from(function == Function::Cos));
            }
            Op::Add(a, b) => match (of(a), of(b)) {
                (Value::At(a), Value::Known(number)) | (Value::Known(number), Value::At(a)) => {
                    Step::Shift(a, number)
                }
                (a, b) => Step::Add(self.register(a), self.register(b)),
            },
            Op::Mul(a, b) => match (of(a), of(b)) {
                (Value::At(a), Value::Known(number)) | (Value::Known(number), Value::At(a)) => {
                    Step::Scale(a, number)
                }
                (a, b) => Step::Mul(self.register(a), self.register(b)),
            },
            Op::Sub(a, b) => match (of(a), of(b)) {
                (Value::At(a), Value::Known(number)) => Step::Shift(a, number.neg()),
                (a, b) => Step::Sub(self.register(a), self.register(b)),
            },
            Op::Div(a, b) => match (of(a), of(b)) {
                (Value::At(a), Value::Known(number)) => Step::Scale(a, number.reciprocal()),
                (a, b) => Step::Div(self.register(a), self.register(b)),
            },
            Op::Pow(a, b) => match of(b) {
                Value::Known(exponent) => Step::Power(self.register(of(a)), exponent.centre),
                // The exponents of a graph are always constant.
                Value::At(_) => Step::Known(Affine::anything()),
            },
            Op::Neg(a) => Step::Neg(self.register(of(a))),
            Op::Atan2(a, b) => Step::Angle(self.register(of(a)), self.register(of(b))),
            Op::Min(a, b) => Step::Smaller(self.register(of(a)), self.register(of(b))),
            Op::Max(a, b) => Step::Larger(self.register(of(a)), self.register(of(b))),
            Op::Call(function, a) => Step::Call(function, self.register(of(a))),
            Op::Lookup(lookup, a) => Step::Lookup(lookup, self.register(of(a))),
            Op::Constant(_) | Op::Symbol(_) => Step::Known(Affine::anything()),
        };
        Value::At(self.push(step))
    }

    /// Evaluates an operation on constants.
    fn number(&self, op: Op, of: impl Fn(Node) -> Value) -> Affine<0> {
        let known = |node: Node| match of(node) {
            Value::Known(number) => number,
            Value::At(_) => Affine::anything(),
        };
        match op {
            Op::Neg(a) => known(a).neg(),
            Op::Add(a, b) => known(a).add(&known(b)),
            Op::Sub(a, b) => known(a).sub(&known(b)),
            Op::Mul(a, b) => known(a).mul(&known(b)),
            Op::Div(a, b) => known(a).mul(&known(b).reciprocal()),
            Op::Pow(a, b) => known(a).power(known(b).centre),
            Op::Atan2(a, b) => known(a).angle(&known(b)).0,
            Op::Min(a, b) => known(a).smaller(&known(b)),
            Op::Max(a, b) => known(a).larger(&known(b)),
            Op::Call(function, a) => match (function, known(a)) {
                // The square root of a sum of zero squares is 0, without a slope.
                (Function::Sqrt, Affine { centre: 0.0, rest: 0.0, .. }) => Affine::known(0.0, 0.0),
                (function, a) => a.call(function).0,
            },
            Op::Lookup(Lookup { table, order }, a) => {
                known(a).look_up(&self.tape.tables[usize::from(table)], u32::from(order))
            }
            Op::Constant(bits) => Affine::known(f64::from_bits(bits), 0.0),
            Op::Symbol(_) => Affine::anything(),
        }
    }
}
