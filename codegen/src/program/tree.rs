//! The functions of a tree of frames: they find the passive variables first.

use abbe_core::Function;
use abbe_core::function::Count;
use abbe_spec::expr::{Function as Call, Symbol};

use super::routine::{Array, ArrayRows, Block, Repeated, Role, Row, Stage};
use super::{Program, Rounded};
use crate::chain::{CLOSED, ClosedLoops, Model, REFINEMENTS, RealNodes};
use crate::graph::{Graph, Node};

/// Builder of the stages of a function.
pub(super) struct LoopRoutineBuilder<'d> {
    model: &'d Model,
    loops: &'d ClosedLoops,
    arrays: &'d mut Vec<Array>,
    stages: Vec<Stage>,
}

impl<'d> LoopRoutineBuilder<'d> {
    /// Creates a draft without stages of a function with these arguments and results.
    pub(super) fn new(model: &'d Model, loops: &'d ClosedLoops, arrays: &'d mut Vec<Array>) -> Self {
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
        let ClosedLoops { passive_home, home, continuation, step, .. } = self.loops;
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
        let pose = real.pose.entries();
        let read = graph.symbols(&[&real.step[..], &pose].concat());
        let passive = self.loops.passive_home.len();
        let reads_errors = read.iter().any(|symbol| matches!(symbol, Symbol::Local(i) if *i >= passive));
        let errors = reads_errors.then(|| {
            let errors = self.local("source_errors", Count::Exactly(real.errors.len()));
            self.block(&[nominal], &[errors], Program::new(graph, &real.errors), None);
            errors
        });
        let passive = self.local("real_passive", Count::Passive);
        self.stages.push(Stage::Copy { from: ArrayRows { array: nominal, row: Row::All }, to: passive });
        self.refine(graph.clone(), passive, errors, &real.step);
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

        let values: Vec<Node> = (0..step.len()).map(|i| graph.symbol(Symbol::Local(i))).collect();
        let [change, size] = [step, &values].map(|of| squares(&mut graph, of));
        let (one, relative) = (graph.constant(1.0), graph.constant(CLOSED));
        let scale = graph.add(one, size);
        let largest = graph.mul(relative, scale);
        let margin = graph.sub(largest, change);
        let sign = graph.call(Call::Sign, margin);
        // 1, or the root of a negative number.
        let one = graph.sqrt(sign);
        let checked: Vec<Node> = step.iter().map(|step| graph.div(*step, one)).collect();
        let outputs = stepped(&mut graph, &checked);
        self.block(&reads, &[passive], Program::new(&graph, &outputs), None);
    }
}

fn squares(graph: &mut Graph, values: &[Node]) -> Node {
    let squares: Vec<Node> = values.iter().map(|value| graph.mul(*value, *value)).collect();
    squares.into_iter().fold(graph.zero(), |sum, square| graph.add(sum, square))
}

/// Returns the local symbols that the outputs of a function read, with bounds of their rounding
/// errors: the passive variables, nominal or with errors, and the errors. Empty for a chain.
pub(super) fn locals(
    model: &Model,
    function: Function,
    symbol: impl Fn(Symbol) -> f64,
    unit: f64,
) -> Vec<Rounded> {
    let Some(tree) = model.loops.as_ref().filter(|tree| !tree.passive_home.is_empty()) else {
        return Vec::new();
    };
    let ClosedLoops { passive_home, home, continuation, .. } = tree;
    let mut p = passive_home.clone();
    for k in 1..=continuation + REFINEMENTS {
        let share = (k as f64 / *continuation as f64).min(1.0);
        let moved = |given: Symbol| match given {
            Symbol::Variable(i) => home[i] + share * (symbol(given) - home[i]),
            _ => symbol(given),
        };
        newton(&model.graph, &tree.step, &mut p, &[], &moved);
    }
    let nominal = rounded_step(&model.graph, &tree.step, &p, &[], &symbol, unit);
    let real = match function {
        Function::RealPose => &tree.real,
        Function::DrawnPose => &tree.drawn,
        Function::DisplacedPose => &tree.displaced,
        _ => return nominal,
    };
    let graph = &model.graph;
    let errors = Program::new(graph, &real.errors).rounded(
        graph.tables(),
        |given| rounded_symbol(given, &nominal, &symbol, unit),
        unit,
    );
    let values: Vec<f64> = errors.iter().map(|error| error.value).collect();
    for _ in 0..=REFINEMENTS {
        newton(graph, &real.step, &mut p, &values, &symbol);
    }
    let passive = rounded_step(graph, &real.step, &p, &errors, &symbol, unit);
    passive.into_iter().chain(errors).collect()
}

/// Subtracts Newton's step from passive variables.
fn newton(graph: &Graph, step: &[Node], p: &mut [f64], errors: &[f64], symbol: &dyn Fn(Symbol) -> f64) {
    let step = graph.evaluate(step, |given| match given {
        // Other nodes may read more of them.
        Symbol::Local(i) => p.iter().chain(errors).nth(i).copied().unwrap_or(f64::NAN),
        given => symbol(given),
    });
    p.iter_mut().zip(step).for_each(|(value, step)| *value -= step);
}

/// Returns passive variables after Newton's step from exact values, with the bound of its rounding
/// errors: what earlier steps leave does not matter.
fn rounded_step(
    graph: &Graph,
    step: &[Node],
    p: &[f64],
    errors: &[Rounded],
    symbol: &dyn Fn(Symbol) -> f64,
    unit: f64,
) -> Vec<Rounded> {
    let exact: Vec<Rounded> = p.iter().map(|value| Rounded::exact(*value, unit)).collect();
    let locals: Vec<Rounded> = exact.iter().chain(errors).copied().collect();
    let mut graph = graph.clone();
    let outputs = stepped(&mut graph, step);
    let program = Program::new(&graph, &outputs);
    program.rounded(graph.tables(), |given| rounded_symbol(given, &locals, symbol, unit), unit)
}

fn rounded_symbol(given: Symbol, locals: &[Rounded], symbol: &dyn Fn(Symbol) -> f64, unit: f64) -> Rounded {
    match given {
        Symbol::Local(i) => locals.get(i).copied().unwrap_or(Rounded::exact(f64::NAN, unit)),
        given => Rounded::exact(symbol(given), unit),
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
