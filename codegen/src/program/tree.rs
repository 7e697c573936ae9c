//! The functions of a tree of frames: they find the passive variables first.

use abbe_core::Function;
use abbe_core::function::Count;
use abbe_spec::expr::{Function as Call, Symbol};

use super::Program;
use super::routine::{Array, ArrayRows, Block, Repeated, Role, Row, Stage};
use crate::chain::{CLOSED, Loops, Model, REFINEMENTS, RealNodes};
use crate::graph::{Graph, Node};

/// Builder of the stages of a function.
pub(super) struct Draft<'d> {
    model: &'d Model,
    loops: &'d Loops,
    arrays: &'d mut Vec<Array>,
    stages: Vec<Stage>,
}

impl<'d> Draft<'d> {
    /// Creates a draft without stages of a function with these arguments and results.
    pub(super) fn new(model: &'d Model, loops: &'d Loops, arrays: &'d mut Vec<Array>) -> Self {
        Self { model, loops, arrays, stages: Vec::new() }
    }

    /// Returns the stages of a function that needs more than a program at the nominal passive
    /// variables; `None` for the others.
    pub(super) fn own_stages(mut self, function: Function) -> Option<Vec<Stage>> {
        let loops = self.loops;
        if loops.passive_home.is_empty() {
            return None;
        }
        let is_pose = |real: &RealNodes| real.pose == self.model.tool && !real.moves_passive(loops);
        match function {
            Function::Passive => self.passive(),
            Function::RealPose if !is_pose(&loops.real) => self.real_pose(&loops.real),
            Function::DrawnPose if !is_pose(&loops.drawn) => self.real_pose(&loops.drawn),
            Function::DisplacedPose => self.real_pose(&loops.displaced),
            _ => return None,
        }
        Some(self.stages)
    }

    /// Returns the stages that fill all results, or these, by a program at the nominal passive
    /// variables.
    pub(super) fn at_once(mut self, program: Program, results: Option<Vec<usize>>) -> Vec<Stage> {
        let results = results.unwrap_or_else(|| {
            (0..self.arrays.len()).filter(|array| self.arrays[*array].role != Role::Argument).collect()
        });
        let writes = results.into_iter().map(ArrayRows::all).collect();
        let reads = if reads_passive(&program) { vec![ArrayRows::all(self.nominal())] } else { Vec::new() };
        self.stages.push(Stage::Block(Block { reads, program, writes, repeated: None }));
        self.stages
    }

    /// Computes the passive variables of the nominal machine, and returns their array.
    fn nominal(&mut self) -> usize {
        let passive = self.local("passive", Count::Passive);
        let arrays = vec![self.array("q"), self.array("s"), passive];
        self.stages.push(Stage::Call { routine: Function::Passive.name(), arrays });
        passive
    }

    fn array(&self, name: &str) -> usize {
        self.arrays.iter().position(|array| array.name == name).expect("the signature has it")
    }

    fn local(&mut self, name: &'static str, count: Count) -> usize {
        self.arrays.push(Array { name, shape: vec![count], role: Role::Zeros });
        self.arrays.len() - 1
    }

    fn block(&mut self, reads: &[usize], writes: &[usize], program: Program, times: Option<usize>) {
        let rows = |arrays: &[usize]| arrays.iter().copied().map(ArrayRows::all).collect();
        let repeated = times.map(|times| Repeated { count: Count::Exactly(times), backwards: false });
        let (reads, writes) = (rows(reads), rows(writes));
        self.stages.push(Stage::Block(Block { reads, program, writes, repeated }));
    }

    /// Computes the passive variables: Newton's method from home, while the joint variables move
    /// from home to their values in equal steps.
    ///
    /// ```text
    /// q_k = home + (k / n) (q − home)        p ← p − φ_p⁻¹ φ(q_k, p)
    /// ```
    fn passive(&mut self) {
        let Loops { passive_home, home, continuation, step, .. } = self.loops;
        let passive = self.array("passive");
        let mut graph = self.model.graph.clone();
        let start: Vec<Node> = passive_home.iter().map(|value| graph.constant(*value)).collect();
        self.block(&[], &[passive], Program::new(&graph, &start), None);

        let progress = self.local("progress", Count::Exactly(1));
        let share = graph.constant(1.0 / *continuation as f64);
        let before = graph.symbol(Symbol::Local(passive_home.len()));
        let after = graph.add(before, share);
        let moved: Vec<Node> = home
            .iter()
            .enumerate()
            .map(|(i, home)| {
                let (value, home) = (graph.symbol(Symbol::Variable(i)), graph.constant(*home));
                let way = graph.sub(value, home);
                let way = graph.mul(after, way);
                graph.add(home, way)
            })
            .collect();
        let on_the_way = graph.substitute(step, |symbol| match symbol {
            Symbol::Variable(i) => Some(moved[i]),
            _ => None,
        });
        let mut outputs = stepped(&mut graph, &on_the_way);
        outputs.push(after);
        let program = Program::new(&graph, &outputs);
        self.block(&[passive, progress], &[passive, progress], program, Some(*continuation));
        self.refine(graph, passive, None, step);
    }

    /// Computes a pose with errors: the passive variables by Newton's method from their nominal
    /// values.
    fn real_pose(&mut self, real: &RealNodes) {
        let graph = &self.model.graph;
        let nominal = self.nominal();
        let errors = (!real.errors.is_empty()).then(|| {
            let errors = self.local("source_errors", Count::Exactly(real.errors.len()));
            self.block(&[nominal], &[errors], Program::new(graph, &real.errors), None);
            errors
        });
        let passive = self.local("real_passive", Count::Passive);
        self.stages.push(Stage::Copy { from: ArrayRows { array: nominal, row: Row::All }, to: passive });
        self.refine(graph.clone(), passive, errors, &real.step);
        let pose: Vec<Node> = real.pose.axes.iter().flatten().chain(&real.pose.position).copied().collect();
        let reads: Vec<usize> = [passive].into_iter().chain(errors).collect();
        let results = [self.array("pose")];
        self.block(&reads, &results, Program::new(graph, &pose), None);
    }

    /// Refines passive variables by Newton's steps. They become NaN if the last step is not small.
    fn refine(&mut self, mut graph: Graph, passive: usize, errors: Option<usize>, step: &[Node]) {
        let reads: Vec<usize> = [passive].into_iter().chain(errors).collect();
        let outputs = stepped(&mut graph, step);
        let program = Program::new(&graph, &outputs);
        self.block(&reads, &[passive], program, Some(REFINEMENTS - 1));

        let squares: Vec<Node> = step.iter().map(|step| graph.mul(*step, *step)).collect();
        let zero = graph.zero();
        let sum = squares.into_iter().fold(zero, |sum, square| graph.add(sum, square));
        let largest = graph.constant(CLOSED);
        let room = graph.sub(largest, sum);
        let sign = graph.call(Call::Sign, room);
        // 1, or the root of a negative number.
        let one = graph.sqrt(sign);
        let checked: Vec<Node> = step.iter().map(|step| graph.div(*step, one)).collect();
        let outputs = stepped(&mut graph, &checked);
        self.block(&reads, &[passive], Program::new(&graph, &outputs), None);
    }
}

/// Returns the passive variables after a step.
fn stepped(graph: &mut Graph, step: &[Node]) -> Vec<Node> {
    let passive: Vec<Node> = (0..step.len()).map(|i| graph.symbol(Symbol::Local(i))).collect();
    passive.iter().zip(step).map(|(value, step)| graph.sub(*value, *step)).collect()
}

/// Returns `true` if a program reads passive variables.
fn reads_passive(program: &Program) -> bool {
    let operands = program.steps.iter().flat_map(|step| step.action.operands());
    operands
        .chain(program.outputs.iter().copied())
        .any(|operand| matches!(operand, super::Operand::Symbol(Symbol::Local(_))))
}
